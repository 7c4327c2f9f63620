"""13.3: a parameter, read when it is needed, with something to go by where it is not there."""

from __future__ import annotations

from contextlib import suppress

import rospy

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.outcome import Outcome

NO_RETURN = "None was returned, as by a function that comes to its end without a return line."


@part(
    "13.3",
    points=2,
    goal="Return a robot's speed from its parameter, or the default where there is none that will do.",
    needs=["speed_of"],
    deadline=20.0,
)
def the_parameter(exam: Exam) -> None:
    """Set, change and delete the parameter of a robot whose name is drawn."""
    robot = exam.draw.word()
    first, second, default = exam.draw.numbers(3, 0.5, 9.0)
    try:
        _returns(exam, robot, default, "the default, where there is no such parameter", default)
        _set(robot, first)
        hint = "Its name is made of the robot's: f'/{robot}/speed'."
        _returns(exam, robot, default, "the parameter, where there is one", first, hint)
        _set(robot, second)
        hint = "It was changed meanwhile, and a parameter tells nobody: ask each time anew."
        _returns(exam, robot, default, "the new value, after it was changed", second, hint)
        _set(robot, 2)
        _returns(
            exam, robot, default, "a whole number is a speed, too", 2.0, "2 is an int, and a good speed."
        )
        _set(robot, "fast")
        hint = "Anything can be set as a parameter, also a text. Look whether it is a number."
        _returns(exam, robot, default, "the default, where it is no number", default, hint)
        _set(robot, [first, second])
        hint = (
            "A list, and even a dict, can be a parameter, too. Ask whether it is a number, not what it isn't."
        )
        _returns(exam, robot, default, "the default, where it is no number", default, hint)
        _set(robot, -first)
        hint = "A speed is above 0. What somebody else has set has to be looked at before it is used."
        _returns(exam, robot, default, "the default, where it is not above 0", default, hint)
        _set(robot, 0)
        hint = "0 is not above 0: a robot with this speed would stand still, and nobody knew why."
        _returns(exam, robot, default, "the default, where it is not above 0", default, hint)
    finally:
        with suppress(KeyError):
            rospy.delete_param(f"/{robot}")


def _set(robot: str, value: float | str | list[float]) -> None:
    rospy.set_param(f"/{robot}/speed", value)


def _returns(exam: Exam, robot: str, default: float, rule: str, expected: float, hint: str = "") -> None:
    exam.expect(
        rule,
        expected=expected,
        seen=_outcome(exam, robot, default).value,
        near=1e-6,
        hints=[(None, NO_RETURN), (says(""), hint or "Where nothing is set, return the default.")],
    )


def _outcome(exam: Exam, robot: str, default: float) -> Outcome:
    return exam.run(
        "speed_of",
        robot,
        default,
        hints=[
            (
                says("^KeyError"),
                "get_param raises a KeyError where nothing is set. Give it a second argument.",
            ),
            (
                says("^TypeError"),
                "A text cannot be compared with a number, nor can a list. Look first whether it is a number.",
            ),
            (says("^ValueError"), "A text is not always a number: float() raises a ValueError then."),
        ],
    )
