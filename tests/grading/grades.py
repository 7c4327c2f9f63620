"""Makes grades of an invented class; some grades contain harmful texts."""

from __future__ import annotations

import random

from course_pkg.checking.report import Assertion, Report, Verdict
from course_pkg.grading.grade import CellOutcome, Grade

GOALS = {
    "05.1": "Answer /getGeometry with the area and the volume of a box.",
    "05.2": "Count on /count and start again on /reset_count.",
    "05.3": "Answer /getGeometryChecked as before, but refuse a negative side, and name it.",
    "05.4": "Switch on and off with /switch, and say what changed.",
    "05.5": "Open a service under any name, and close it again.",
    "06.1": "Ask a service for area and volume, and return both.",
    "06.2": "Tell within the time whether a service is there.",
}
POINTS = {"05.5": 1}
HINTS = {
    "05.1": "That is width + length. An area is a product.",
    "05.2": "Even an empty response has to be returned: return EmptyResponse().",
    "05.3": "Only rospy.ServiceException carries words of your own to the caller: raise it.",
    "05.4": "The switch was on before and on after: keep its state in self.",
    "05.5": "After close_service the name is still there: call shutdown() on what rospy.Service returned.",
    "06.1": "The response has area first, then volume.",
    "06.2": "rospy.wait_for_service raises ROSException when the time is over: catch it.",
}
NASTY = "\x1b[31m<script>alert(1)</script>\x00\u202e=HYPERLINK(1)]]>&\ud800\ufffe\r\n"


def report(check: str, verdict: Verdict = Verdict.PASSED, **more: object) -> Report:
    """Return a report about one part."""
    possible = POINTS.get(check, 2)
    rules = [
        Assertion("the service is there", True),
        Assertion("it has the type that the exercise names", True),
    ]
    if verdict is Verdict.FAILED:
        asked = 'rosservice call /getGeometry "{length: 1.25, width: 4.0, height: 2.5}"'
        rules.append(Assertion("area is width times length", False, asked, "5", "5.25", HINTS[check]))
    notes = {
        Verdict.NOT_ATTEMPTED: "Replace the ... by your answer, and run the cell.",
        Verdict.UNDECIDED: "The kernel ended before the check did: it used more than 512 MB of memory.",
    }
    rules = [] if verdict in notes else rules
    earned = possible if verdict is Verdict.PASSED else 0
    made = Report(check, verdict, GOALS[check], earned, possible, tuple(rules), notes.get(verdict, ""))
    return Report(**{**vars(made), **more})  # type: ignore[arg-type]


def class_of(count: int, chapters: tuple[str, ...] = ("05",), seed: int = 5) -> list[Grade]:
    """Return the grades of a class; the students are called s01, s02 and so on."""
    draw = random.Random(seed)  # noqa: S311 -- the class is the same in each run
    made = []
    for number in range(1, count + 1):
        strength = draw.random()
        for chapter in chapters:
            checks = [check for check in GOALS if check.startswith(chapter)]
            reports = tuple(report(check, _verdict(draw, strength)) for check in checks)
            notes = (
                ("05.2: 2 cells answer this exercise. Only the last of these cells was used.",)
                if number % 9 == 0
                else ()
            )
            late, factor = (1.5, 0.8) if number % 11 == 0 else (0.0, 1.0)
            outcomes = [
                CellOutcome(
                    f"cell-{place}",
                    "failed" if place == 3 and strength < 0.5 else "passed",
                    "area: 5.25 in place of 5.0",
                )
                for place in range(9)
            ]
            made.append(
                Grade(
                    f"s{number:02}",
                    chapter,
                    reports,
                    notes,
                    tuple(outcomes),
                    late=late,
                    factor=factor,
                    origin=f"s{number:02}/{chapter}.ipynb",
                )
            )
    return made


def _verdict(draw: random.Random, strength: float) -> Verdict:
    chance = draw.random()
    if chance < 0.3 + 0.6 * strength:
        return Verdict.PASSED
    if chance > 0.97:
        return Verdict.UNDECIDED
    return Verdict.FAILED if draw.random() < 0.7 else Verdict.NOT_ATTEMPTED


def refused(
    student: str = "s31",
    chapter: str = "05",
    problem: str = "05_write_a_server.ipynb was not graded: the file is empty.",
) -> Grade:
    """Return the grade of an unusable submission."""
    checks = [check for check in GOALS if chapter and check.startswith(chapter)]
    reports = tuple(report(check, Verdict.UNDECIDED, note=problem) for check in checks)
    return Grade(student, chapter, reports, problem=problem, origin="x")


def nasty(student: str = "../" + NASTY, **more: object) -> Grade:
    """Return a grade in which each text contains harmful characters."""
    rule = Assertion(NASTY, False, NASTY, NASTY, NASTY, NASTY)
    bad = Report("05.1", Verdict.FAILED, NASTY, 0, 2, (rule,), NASTY, NASTY * 1000)
    cells = (CellOutcome(NASTY, NASTY, NASTY),)
    made = Grade(student, "05", (bad,), (NASTY,), cells, origin=NASTY, problem=NASTY)
    return Grade(**{**vars(made), **more})  # type: ignore[arg-type]
