"""The changes since the last run: the old and new points of each part."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from course_pkg.grading import clean
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.files import put_table
from course_pkg.grading.reports.gradebook import name_of, points

FILE = "changes.csv"
SHOWN = 40  # At most this many lines are printed; changes.csv contains all changes.


@dataclass(frozen=True)
class Change:
    """Points that have changed since the last run; `part` is "total" if only the lateness has changed."""

    student: str
    chapter: str
    part: str
    before: str
    after: str

    def __str__(self) -> str:
        where = f"chapter {self.chapter}" if self.part == "total" else self.part
        return f"{name_of(self.student)}, {where}: {self.before} before, {self.after} now"


def changes(before: Sequence[Grade], after: Sequence[Grade]) -> list[Change]:
    """Return the points that have changed between two runs, sorted by student and part.

    A grade that exists in only one of the runs is ignored.
    """
    known = {(grade.student, grade.chapter): grade for grade in before if grade.chapter}
    found = []
    for grade in sorted(after, key=lambda each: (each.student, each.chapter)):
        earlier = known.get((grade.student, grade.chapter))
        if earlier is not None:
            found += list(_between(earlier, grade))
    return found


def _between(before: Grade, after: Grade) -> Iterator[Change]:
    student, chapter = after.student, after.chapter
    old = {report.check: report for report in before.reports}
    new = {report.check: report for report in after.reports}
    changed = False
    for check in [*new, *(check for check in old if check not in new)]:
        values = [points(each[check].points) if check in each else "none" for each in (old, new)]
        if values[0] != values[1]:
            changed = True
            yield Change(student, chapter, check, values[0], values[1])
    if not changed and before.earned != after.earned:
        yield Change(student, chapter, "total", points(before.earned), points(after.earned))


def worth_changes(before: Sequence[Grade], after: Sequence[Grade]) -> list[str]:
    """Return a line for each part with changed possible points, or with changed points of its goals."""
    old, new = (
        {report.check: report for grade in grades for report in grade.reports} for grades in (before, after)
    )
    lines = []
    for check in sorted(old.keys() & new.keys()):
        values = [each[check].possible for each in (old, new)]
        shares = [{goal.text: goal.points for goal in each[check].goals} for each in (old, new)]
        if values[0] != values[1]:
            lines.append(f"  {check}: {points(values[0])} before, {points(values[1])} now")
        elif shares[0] != shares[1]:
            lines.append(f"  {check}: the points of this part are now divided differently among its goals")
    return ["Parts whose possible points have changed since the last run:", *lines] if lines else []


def write_changes(found: Sequence[Change], out: Path) -> None:
    """Write changes.csv, with a row for each change."""
    head = ["student", "chapter", "part", "points before", "points now"]
    rows = [[name_of(each.student), each.chapter, each.part, each.before, each.after] for each in found]
    put_table(out / FILE, [head, *([clean.cell(value) for value in row] for row in rows)], "utf-8-sig")


def described(found: Sequence[Change], out: Path) -> list[str]:
    """Return the lines for the terminal about the changes `found`."""
    if not found:
        return ["No points have changed since the last run."]
    lines = ["Points that have changed since the last run:", *(f"  {each}" for each in found[:SHOWN])]
    if len(found) > SHOWN:
        lines.append(f"  {len(found) - SHOWN} more changes are in {out / FILE}.")
    return lines
