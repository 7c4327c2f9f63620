"""A client of the student's, made from a class and asked for a box; no rule shows a name that was drawn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from course_pkg.examiner import Exam, Its
from course_pkg.examiner.outcome import Outcome

GEOMETRY = "course_pkg/geometry"
A_CLIENT = """
def begin(kind, service):
    global client
    client = kind(service)


def measured(kind, *sides):
    answer = client.measure(*sides)
    return getattr(answer, "volume", answer)
"""


class Client:
    """An object of the student's class `kind`, for the service `name`."""

    def __init__(self, exam: Exam, kind: str, name: str) -> None:
        self._exam, self._kind = exam, kind
        exam.prepare(A_CLIENT)
        made = exam.run("begin", Its(kind), name, worded=f"{kind}(service)")
        exam.hold("a client can be made", made.value is None)

    def measure(self, hints: Mapping[Any, str]) -> Outcome:
        """Have it measure a box; a whole response comes as its volume."""
        sides = self._exam.draw.numbers(3, 0.5, 9.0)
        worded = "measure(length, width, height)"
        return self._exam.run("measured", Its(self._kind), *sides, within=3.0, hints=hints, worded=worded)
