"""What turtle1 is told, as the checks of several drivers hear it."""

from __future__ import annotations

from course_pkg.examiner import Exam
from course_pkg.examiner.hearing import Arrival, Hearing

TOPIC = "/turtle1/cmd_vel"
STRAIGHT, TURNING, STANDING = "straight on", "turning", "standing"
SILENT = (
    "The topic is there and says nothing. Look at the drive: an error in velocity() or __init__() ends it. "
    "drive(...) as the last line of a cell shows it."
)


class Stream:
    """The velocities that one node publishes for turtle1."""

    def __init__(self, exam: Exam) -> None:
        self._exam = exam
        self._hearing: Hearing = exam.hear(TOPIC, "geometry_msgs/Twist")
        self._hearing.published(within=3.0)
        exam.expect(
            "one node alone drives turtle1",
            expected=1,
            seen=len(self._hearing.publishers()),
            hints="Two drivers contradict each other. Stop the other one: pubvel.stop().",
        )
        exam.hold(
            "velocities are published", bool(self.next(1)), expected="velocities", seen="none", hints=SILENT
        )

    def next(self, count: int, within: float = 4.0) -> list[Arrival]:
        """Return the next `count` messages; fewer where they do not come in time."""
        before = len(self._hearing.arrivals)
        self._hearing.wait(before + count, within)
        return list(self._hearing.arrivals[before:])

    def now(self) -> tuple[float, float]:
        """Return speed (m/s) and turn (rad/s) of the second message from now: the first may be under way."""
        arrivals = self.next(2)
        return velocity(arrivals[-1]) if arrivals else (0.0, 0.0)


def velocity(arrival: Arrival) -> tuple[float, float]:
    """Return the two numbers of a message that matter to a turtle."""
    linear, angular = arrival.fields["linear"], arrival.fields["angular"]
    assert isinstance(linear, dict)
    assert isinstance(angular, dict)
    return float(linear["x"]), float(angular["z"])


def kind(pair: tuple[float, float]) -> str:
    """Say what a turtle does that is told so."""
    forward, turn = pair
    if forward and turn:
        return "both at once"
    return STRAIGHT if forward else TURNING if turn else STANDING
