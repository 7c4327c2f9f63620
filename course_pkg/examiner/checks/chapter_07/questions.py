"""What a client is asked to send that does not know what it will be asked to send."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.examiner import Exam
from course_pkg.examiner.plain import Plain


@dataclass(frozen=True)
class Question:
    """Fields for a service of one type, and what the service answers."""

    what: str  # as rules call it
    kind: str
    fields: dict[str, Plain]
    answer: dict[str, Plain]

    def given(self, seen: Plain) -> Plain:
        """Return of a request that was seen only the fields that were given, at every depth."""
        return _given(self.fields, seen)

    def mixed_up(self, seen: dict[str, Plain]) -> bool:
        """Return whether the values are there, and in each other's fields."""
        return set(map(str, seen.values())) == set(map(str, self.fields.values()))


def questions(exam: Exam) -> list[Question]:
    """Return one after the other, each with something that the one before did not have."""
    return [_nothing(exam), _numbers(exam), _texts(exam)]


def _nothing(exam: Exam) -> Question:
    """Make a request without fields."""
    return Question("no fields", "std_srvs/Trigger", {}, {"success": True, "message": exam.draw.word()})


def _numbers(exam: Exam) -> Question:
    """Make two negative numbers, the second field first."""
    a, b, total = (-number for number in exam.draw.integers(3, 100, 999))
    return Question("negative numbers", "course_pkg/AddTwoInts", {"b": b, "a": a}, {"sum": total})


def _texts(exam: Exam) -> Question:
    """Make messages within the request, and texts in them: a quote to the shell, and off, False to YAML."""
    width, height, offset = exam.draw.integers(3, 100, 999)
    frame = f"{exam.draw.word()}'s own"
    info = {
        "width": width,
        "header": {"frame_id": frame},
        "distortion_model": "off",
        "roi": {"x_offset": offset},
        "height": height,
    }
    answer = {"success": True, "status_message": exam.draw.word()}
    return Question("messages within", "sensor_msgs/SetCameraInfo", {"camera_info": info}, answer)


def _given(fields: Plain, seen: Plain) -> Plain:
    if not isinstance(fields, dict) or not isinstance(seen, dict):
        return seen
    return {name: _given(fields[name], seen.get(name)) for name in fields}
