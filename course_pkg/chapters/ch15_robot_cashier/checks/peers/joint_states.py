"""The joint states that a check publishes for the student's mirror."""

from __future__ import annotations

import math
from dataclasses import dataclass

from course_pkg.checking import CheckContext
from course_pkg.checking.plain_values import Fields

JOINTS = "sensor_msgs/JointState"
FIRST = 1000  # The first joint state has this stamp in s; each following stamp is 1 s later.
COUNT = 28
EFFORT = 7  # The joint state with this index has an infinite effort.
FEW_EFFORTS = 9  # The joint state with this index has fewer efforts than names.
LARGE = 11  # In the joint state with this index, the sum of all positions is too large for a float.
MANY = 26  # The joint state with this index has nine joints.
EMPTY = 21  # The joint state with this index has no joints.


@dataclass
class JointState:
    """The fields of a joint state: positions in rad, velocities in rad/s, efforts in N m."""

    secs: int
    nsecs: int
    frame_id: str
    name: list[str]
    position: list[float]
    velocity: list[float]
    effort: list[float]

    @classmethod
    def of(cls, fields: Fields) -> JointState:
        """Return a joint state with the fields of a message."""
        stamp = fields["header"]["stamp"]
        arrays = (fields["name"], fields["position"], fields["velocity"], fields["effort"])
        return cls(stamp["secs"], stamp["nsecs"], fields["header"]["frame_id"], *arrays)

    def fields(self) -> Fields:
        """Return the fields for a message."""
        header = {"stamp": {"secs": self.secs, "nsecs": self.nsecs}, "frame_id": self.frame_id}
        arrays = {"position": self.position, "velocity": self.velocity, "effort": self.effort}
        return {"header": header, "name": self.name, **arrays}

    @property
    def misses_positions(self) -> bool:
        """Whether the number of positions differs from the number of names."""
        return len(self.position) != len(self.name)

    @property
    def misses_velocities(self) -> bool:
        """Whether the number of velocities is not 0 and differs from the number of names."""
        return len(self.velocity) not in (0, len(self.name))

    @property
    def is_valid(self) -> bool:
        """Whether the arrays have the right lengths and all positions and velocities are finite."""
        if self.misses_positions or self.misses_velocities:
            return False
        return all(map(math.isfinite, [*self.position, *self.velocity]))

    @property
    def header_text(self) -> str:
        """The header as text for a report."""
        return f"frame_id {self.frame_id or 'none'}, stamp {self.secs}.{self.nsecs:09d}"


def joint_states(context: CheckContext) -> list[JointState]:
    """Return joint states.

    Some of these joint states are invalid. The first and the last joint state are valid, and each invalid
    joint state is followed by a valid joint state.
    """
    states = [_joint_state(context, number) for number in range(COUNT)]
    states[3].position = states[3].position[:2]
    states[5].position = [*states[5].position, 0.5]  # This joint state has no velocities.
    states[8].position = []
    states[12].position = [math.nan, *states[12].position[1:]]
    states[14].velocity = states[14].velocity[:2]
    states[17].velocity = [*states[17].velocity[:-1], math.inf]
    states[19].velocity = [*states[19].velocity, 0.5]
    states[22].position = [*states[22].position[:-1], -math.inf]
    states[24].velocity = [math.nan, *states[24].velocity[1:]]
    # The joint states that are changed below are still valid.
    states[MANY].name = [f"joint {number}" for number in range(9)]
    states[MANY].position, states[MANY].velocity = (context.random.numbers(9, -3.0, 3.0) for _ in range(2))
    states[EFFORT].effort[0] = math.inf
    states[FEW_EFFORTS].effort = states[FEW_EFFORTS].effort[:2]
    states[LARGE].position[:2] = [1e308, 1e308]
    states[EMPTY].name, states[EMPTY].position, states[EMPTY].velocity, states[EMPTY].effort = [], [], [], []
    return states


def many_joint_states(context: CheckContext, count: int) -> list[JointState]:
    """Return `count` valid joint states; their stamps are later than those of joint_states()."""
    return [_joint_state(context, COUNT + number) for number in range(count)]


def _joint_state(context: CheckContext, number: int) -> JointState:
    return JointState(
        secs=FIRST + number,
        nsecs=context.random.integer(1, 999_999_999),
        frame_id="arm",
        name=["base", "shoulder", "elbow"],
        position=_numbers_of_both_signs(context),
        velocity=_numbers_of_both_signs(context) if number % 5 else [],
        effort=context.random.numbers(3, 1.0, 9.0) if number % 2 else [],
    )


def _numbers_of_both_signs(context: CheckContext) -> list[float]:
    """Return three numbers; if all were negative, -abs(value) and the value itself would be equal."""
    negative, *positive = context.random.numbers(3, 0.1, 3.0, digits=12)
    return context.random.shuffled([-negative, *positive])
