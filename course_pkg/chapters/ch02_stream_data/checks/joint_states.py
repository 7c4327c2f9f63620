"""02.2: the joint states that the check publishes for the student's mirror."""

from course_pkg.checking import CheckContext
from course_pkg.checking.plain_values import Fields

JOINTS = "sensor_msgs/JointState"


def joint_states(context: CheckContext, count: int) -> list[Fields]:
    """Return a list of `count` joint states.

    The joint states in the second half have fewer joints. If the student's node stores values of earlier
    joint states, its messages are then wrong. One joint state has no velocities.
    """
    names = [context.random.word() for _ in range(4)]
    counts = [4 if number < count / 2 else 3 for number in range(count)]
    states: list[Fields] = [
        {
            "header": {
                "stamp": {"secs": 1000 + number, "nsecs": context.random.integer(1, 999_999_999)},
                "frame_id": context.random.word(),
            },
            "name": names[:joints],
            "position": _of_both_signs(context, joints),
            "velocity": _of_both_signs(context, joints),
        }
        for number, joints in enumerate(counts)
    ]
    states[context.random.integer(2, count // 2)]["velocity"] = []
    return states


def _of_both_signs(context: CheckContext, count: int) -> list[float]:
    """Return `count` random numbers: two are positive, and the others are negative.

    The numbers have both signs, so that each wrong sign in a mirror image is visible. Some numbers are
    outside of the range from -π to π.
    """
    return context.random.shuffled(
        [*context.random.numbers(2, 0.1, 9.0), *context.random.numbers(count - 2, -9.0, -0.1)]
    )
