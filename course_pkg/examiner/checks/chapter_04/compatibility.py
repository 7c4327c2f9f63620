"""Which two definitions talk to each other: the function is held to the MD5s, with definitions drawn anew."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.examiner import Exam, part, says
from course_pkg.interfaces import compile_service

NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
NUMBERS = ("int8", "int16", "int32", "uint16", "float32", "float64")


@dataclass(frozen=True)
class Pair:
    """Two definitions, what is different in the second, and what to think of."""

    rule: str
    server: str
    client: str
    hint: str


@part(
    "04.2",
    points=2,
    goal="Say whether a server built from one text answers a client built from another.",
    needs=["will_talk"],
    deadline=40.0,
)
def who_talks_to_whom(exam: Exam) -> None:
    """Try pairs that differ in what counts, and in what does not."""
    for pair in _pairs(exam):
        for server, client in exam.draw.shuffled([(pair.server, pair.client), (pair.client, pair.server)]):
            expected = compile_service("drawn/Type", server).md5 == compile_service("drawn/Type", client).md5
            exam.expect(
                pair.rule,
                expected=expected,
                seen=exam.run("will_talk", server, client).value,
                hints=[
                    (None, NO_RETURN),
                    (lambda seen: not isinstance(seen, bool), "Return True or False: compare by ==."),
                    (says(""), pair.hint),
                ],
            )


def _pairs(exam: Exam) -> list[Pair]:
    names = [exam.draw.word() for _ in range(5)]
    kinds = exam.draw.shuffled(NUMBERS)[:5]
    value = exam.draw.integer(2, 90)
    top = [f"int32 {exam.draw.word().upper()}={value}"]
    above = [f"{kind} {name}" for kind, name in zip(kinds[:3], names[:3], strict=True)]
    below = [f"{kind} {name}" for kind, name in zip(kinds[3:], names[3:], strict=True)]
    text = _text(top, above, below)

    def differs(rule: str, other: str, hint: str) -> Pair:
        return Pair(f"they do not talk: {rule}", text, other, hint)

    def agrees(rule: str, other: str) -> Pair:
        hint = "Comments, blank lines and extra blanks are for people: the MD5 is made without them."
        return Pair(f"they talk: {rule}", text, other, hint)

    longer = "The name of every field is part of the MD5, letter by letter."
    return [
        agrees("the same text", text),
        agrees("one comment more", f"# Measured by {exam.draw.word()}.\n{text}"),
        agrees("a comment behind a field", text.replace(above[1], f"{above[1]}  # in metres")),
        agrees("blank lines", text.replace(below[0], f"\n{below[0]}\n")),
        agrees("more blanks in a line", text.replace(above[0], above[0].replace(" ", "   ") + "  ")),
        differs("another letter in a name", text.replace(names[1], _slip(names[1])), longer),
        differs(
            "another type",
            text.replace(above[2], f"uint64 {names[2]}"),
            "A type is part of the MD5, too.",
        ),
        differs(
            "two fields in another order",
            _text(top, [above[1], above[0], above[2]], below),
            "The order of the fields is the order of the bytes: it is part of the MD5.",
        ),
        differs(
            "a field moved from request to response",
            _text(top, above[:2], [above[2], *below]),
            "The line --- counts: request and response are two lists of fields.",
        ),
        differs(
            "another value of a constant",
            text.replace(f"={value}", f"={value + 1}"),
            "A constant is agreed on, too: its name and its value are part of the MD5.",
        ),
        differs(
            "an array for one value",
            text.replace(above[0], above[0].replace(" ", "[] ", 1)),
            "The brackets belong to the type.",
        ),
        differs("one field less", _text(top, above, below[:1]), "Every field counts, in both halves."),
    ]


def _text(top: list[str], above: list[str], below: list[str]) -> str:
    return "\n".join([*top, *above, "---", *below, ""])


def _slip(name: str) -> str:
    """Return the name with its last letter replaced."""
    return name[:-1] + ("a" if name[-1] != "a" else "b")
