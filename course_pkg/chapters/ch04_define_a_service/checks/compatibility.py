"""The check of a function that returns whether two service definitions are compatible.

The check compares the function's results with the MD5 sums of random definitions.
"""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.types import compile_service

TYPES = (
    "The MD5 sum depends on the types of the fields, too, and the brackets are part of a type. "
    "Compare the MD5 sums of both texts."
)
NUMBERS = ("int8", "int16", "int32", "uint16", "float32", "float64")
OTHERS = ("bool", "string", "time", "uint8[]", "float64[4]")


@dataclass(frozen=True)
class Pair:
    """Two definitions, the title of an assertion about their difference, and a hint."""

    assertion: str
    server: str
    client: str
    hint: str


@part(
    "04.2",
    points=2,
    goal=(
        "Return True if a client with the definition in one text can call a server with the "
        "definition in the other text. Otherwise, return False."
    ),
    needs=["will_talk"],
    deadline=40.0,
)
def who_talks_to_whom(context: CheckContext) -> None:
    """Call the student's function with pairs of definitions; only some pairs have equal MD5 sums."""
    again = context.random.shuffled(_pairs(context))[: context.random.integer(6, 9)]
    # The order of the pairs is random, so that a function with a fixed list of results fails.
    for pair in (*_pairs(context), *again):
        for server, client in context.random.shuffled(
            [(pair.server, pair.client), (pair.client, pair.server)]
        ):
            expected = compile_service("drawn/Type", server).md5 == compile_service("drawn/Type", client).md5
            context.expect(
                pair.assertion,
                expected=expected,
                actual=context.run("will_talk", server, client).returned(),
                hints=[
                    (None, NO_RETURN),
                    (
                        lambda actual: not isinstance(actual, bool),
                        "Return True or False. Compare the two MD5 sums with ==.",
                    ),
                    (ANYTHING, pair.hint),
                ],
            )


def _pairs(context: CheckContext) -> list[Pair]:
    names = [_name(context) for _ in range(5)]
    kinds = [*context.random.shuffled(NUMBERS)[:4], context.random.choice(OTHERS)]
    value = context.random.integer(2, 90)
    top = [f"int32 {_name(context).upper()}={value}"]
    top += [f"int16 {_name(context).upper()}={100 + each}" for each in range(context.random.integer(1, 2))]
    above = [f"{kind} {name}" for kind, name in zip(kinds[:3], names[:3], strict=True)]
    below = [f"{kind} {name}" for kind, name in zip(kinds[3:], names[3:], strict=True)]
    last = f"uint16 {_name(context).upper()}={value}"
    text = _text(top, above, [*below, last])

    def differs(assertion: str, other: str, hint: str) -> Pair:
        return Pair(f"the result is False for {assertion}", text, other, hint)

    note = f"string NOTE={context.random.word()} # {context.random.word()}\n"

    def agrees(assertion: str, other: str) -> Pair:
        hint = (
            "ROS ignores comments, blank lines and extra spaces, so these two texts are compatible. "
            "Compare the MD5 sums, not the texts."
        )
        return Pair(f"the result is True for {assertion}", text, other, hint)

    letter = (
        "One letter of a field's name is different, so the texts are not compatible. Compare "
        "the MD5 sums of both texts."
    )
    return [
        Pair(
            "the result is True for two equal texts",
            text,
            text,
            "The two texts are equal, but the result was False. Compare the MD5 sums with ==, "
            "not classes or other objects.",
        ),
        agrees("an additional comment", f"# measured by {context.random.word()}\n{text}"),
        agrees("a comment after a field", text.replace(above[1], f"{above[1]}  # in metres")),
        agrees("additional blank lines", text.replace(below[0], f"\n{below[0]}\n")),
        agrees("additional spaces in a line", text.replace(above[0], above[0].replace(" ", "   ") + "  ")),
        differs("a different letter in a name", text.replace(names[1], _slip(names[1])), letter),
        differs(
            "a different type",
            text.replace(above[2], f"uint64 {names[2]}"),
            TYPES,
        ),
        differs(
            "a different order of two fields",
            _text(top, [above[1], above[0], above[2]], [*below, last]),
            (
                "The order of the fields is different, so the texts are not compatible. The MD5 "
                "sum depends on the order, because ROS sends the fields in this order."
            ),
        ),
        differs(
            "a field that is moved from the request to the response",
            _text(top, above[:2], [above[2], *below, last]),
            "One field is in the request of one text, but in the response of the other text, so the "
            "texts are not compatible. The line --- separates the request from the response.",
        ),
        differs(
            "a different value of a constant",
            text.replace(top[0], f"{top[0]}1"),
            (
                "The value of a constant is different, so the texts are not compatible. The names "
                "and the values of constants are part of the MD5 sum."
            ),
        ),
        differs(
            "an array in place of a single value",
            text.replace(above[0], above[0].replace(" ", "[] ", 1)),
            TYPES,
        ),
        differs(
            "a missing field",
            _text(top, above, [below[0], last]),
            (
                "One field is missing in one of the texts, so the texts are not compatible. Each field "
                "of the request and of the response is part of the MD5 sum."
            ),
        ),
        agrees("additional spaces in a line", text.replace("=", " = ")),
        Pair(
            "the result is True for a constant below the fields",
            text,
            _text([], [*above, *top], [*below, last]),
            "Only the positions of the constants differ, and the MD5 sum does not depend on these "
            "positions. Compare the MD5 sums of both texts.",
        ),
        Pair(
            "the result is False for a different text after # in a string constant",
            note + text,
            f"{note.strip()}s\n{text}",
            "In a string constant, the value is the whole text after the =, even if this text "
            "contains a #. Do not remove comments yourself: compare the MD5 sums.",
        ),
        differs(
            "a different value of a constant in the response",
            text.replace(last, f"{last}1"),
            (
                "The value of a constant below the line --- is different, so the texts are not compatible. "
                "The constants of the response are part of the MD5 sum, too."
            ),
        ),
        differs(
            "a different order of two constants",
            _text([top[1], top[0], *top[2:]], above, [*below, last]),
            (
                "The order of two constants is different, so the texts are not compatible. The MD5 sum "
                "depends on the order of the constants, too."
            ),
        ),
    ]


def _name(context: CheckContext) -> str:
    """Return a random name for a field; the names have different lengths and different characters."""
    return context.random.word(context.random.integer(5, 9)) + context.random.choice(["", "", "_2", "_x"])


def _text(top: list[str], above: list[str], below: list[str]) -> str:
    return "\n".join([*top, *above, "---", *below, ""])


def _slip(name: str) -> str:
    """Return the name `name` with a different last letter."""
    return name[:-1] + ("a" if name[-1] != "a" else "b")
