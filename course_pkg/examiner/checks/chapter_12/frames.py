"""12.1: whether somebody is in a frame, and whether it is a frame at all."""

from __future__ import annotations

import re
from dataclasses import dataclass

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.outcome import Outcome

A_FRAME = """
from sensor_msgs.msg import Image


def shown(sees, width, height, step, encoding, data):
    return sees(Image(width=width, height=height, step=step, encoding=encoding, data=bytes(data)))
"""
DARK = 96
PADDING = (
    "A row has `step` bytes and only `width` points; the bytes behind them are filling and may be anything. "
    "Row r begins at r * frame.step."
)

KINDS = "The answer is True or False, and nothing else."
AVERAGE = "A fifth of the points is dark, and the rest is very light. Count points: an average hides them."
NOISE = "A dark point or two are noise. It takes a tenth of all points."
ROUNDED = "It was one point less than a tenth. Compare numbers that were not rounded."
FALSE = "False is an answer, and says that nobody is there. Raise a ValueError: nobody can tell."
TOO_FEW = "Bytes are missing. Compare len(frame.data) with frame.height * frame.step before you count."
ENCODING = "These are three bytes for each point. Look at frame.encoding: only mono8 has one."
SHORT = "A row of fewer bytes than points cannot be: step is at least width."
POINTLESS = (
    "The frame has bytes, and all of them are filling: 0 points in a row. Look at width and height, not only "
    "at the data."
)
ANOTHER = "That is an error of another type, and whoever calls expects one: raise ValueError(words)."
WORDLESS = "Nobody learns what is wrong with the frame: put it into words, ValueError(words)."


@part(
    "12.1",
    points=2,
    goal="Say whether a customer is in a frame, and refuse what is no frame.",
    needs=["sees_customer"],
    deadline=20.0,
)
def a_frame(exam: Exam) -> None:
    """Show frames of many sizes at the limit, with filling at the ends of their rows, and broken ones."""
    exam.prepare(A_FRAME)
    width, height = (10 * number for number in exam.draw.integers(2, 2, 5))
    tenth = width * height // 10
    for rule, dark, expected, look, hint in (
        ("an empty counter is no customer", 0, False, _Look(), "Nobody is there, and all is light."),
        ("dark points are a customer", 2 * tenth, True, _Look(), AVERAGE),
        ("a few dark points are no customer", tenth // 2, False, _Look(), NOISE),
        ("exactly a tenth is enough", tenth, True, _Look(), "At least a tenth: exactly a tenth counts, too."),
        ("and one point less is not", tenth - 1, False, _Look(), ROUNDED),
        (
            "a point of 96 is not dark",
            2 * tenth,
            False,
            _Look(dark=(DARK, DARK)),
            "Darker than 96 is below 96.",
        ),
        ("what fills up a row is no point of it", 0, False, _Look(extra=7, filling=0), PADDING),
        ("what fills up a row is no point of it", tenth, True, _Look(extra=9, filling=255), PADDING),
    ):
        frame = (width, height, width + look.extra, "mono8")
        outcome = _shown(exam, frame, _data(exam, width, height, dark, look), hint)
        hints = [((lambda seen: not isinstance(seen, bool)), KINDS), ((lambda _: True), hint)]
        exam.expect(rule, expected=expected, seen=outcome.value, hints=hints)
    _refuses(exam, width, height)


@dataclass(frozen=True)
class _Look:
    """How bright the dark points are, from and to, and how many bytes of what value fill up a row."""

    dark: tuple[int, int] = (0, DARK - 1)
    extra: int = 0
    filling: int = 0


def _data(exam: Exam, width: int, height: int, dark: int, look: _Look) -> list[int]:
    """Return a frame with so many dark points, at random places."""
    light = width * height - dark
    points = [exam.draw.integer(*look.dark) for _ in range(dark)]
    points = exam.draw.shuffled(points + [exam.draw.integer(230, 255) for _ in range(light)])
    rows = [points[start : start + width] for start in range(0, len(points), width)]
    return [byte for row in rows for byte in [*row, *[look.filling] * look.extra]]


def _refuses(exam: Exam, width: int, height: int) -> None:
    points = [0] * (width * height)
    size = (width, height, width, "mono8")
    for what, frame, data, hint in (
        ("too few bytes", size, points[:-3], TOO_FEW),
        (
            "too many bytes",
            size,
            [*points, 0],
            "There are more bytes than rows have place for. Compare with !=.",
        ),
        ("another encoding", (width, height, 3 * width, "rgb8"), points * 3, ENCODING),
        (
            "no points at all",
            (0, 0, 0, "mono8"),
            [],
            "A frame of 0 by 0 points has its 0 bytes, and shows nothing.",
        ),
        ("rows shorter than their points", (width, height, width - 1, "mono8"), points[height:], SHORT),
        ("no points at all", (0, height, 4, "mono8"), [0] * (4 * height), POINTLESS),
    ):
        rule = f"{what}: refused with a ValueError"
        said = _shown(exam, frame, data).raised(
            rule,
            "ValueError",
            hints=[
                ((lambda seen: seen is False), FALSE),
                (says(r"^(?!ZeroDivision|Index)\w*(Error|Exception|Interrupt|Exit)?: "), ANOTHER),
                ((lambda _: True), hint),
            ],
        )
        if not re.search(r"\w", said.partition(":")[2]):
            exam.fail(rule, expected="a ValueError that says what is wrong", seen=said, hint=WORDLESS)


def _shown(exam: Exam, frame: tuple[int, int, int, str], data: list[int], hint: str = "") -> Outcome:
    """Have a frame looked at; `hint` is for a good one that is refused."""
    refused = [(says("^ValueError"), hint)] if hint is PADDING else []
    return exam.run("shown", Its("sees_customer"), *frame, data, worded="sees_customer(frame)", hints=refused)
