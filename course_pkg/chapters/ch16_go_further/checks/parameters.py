"""16.3: a function that reads a parameter; if the value is missing or invalid, it returns a default."""

from __future__ import annotations

from contextlib import suppress

import rospy

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import same
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.result import Result
from course_pkg.waiting import wait_until

SETTLING = 1.0  # A node that reads parameters from a cache gets a new value within this time in s.
NAME = (
    "The function did not return the value of the parameter. In each call, read the parameter "
    "f'/{robot}/speed', whose name contains the name of the robot."
)
CHANGED = (
    "The parameter has changed, but the function returned the old value. Read the parameter in each call."
)
TEXT = "The value of the parameter was a string, not a number. Check the type of the value."
LIST = (
    "The value of the parameter was a list. Check that the value is a number, because a parameter "
    "can have many types."
)
GROUP = (
    "The value was a dict, because /ROBOT/speed is a group that contains the parameter /ROBOT/speed/max. "
    "Check that the value is an int or a float."
)
TRUTH = (
    "The value was True, which is an int with the value 1 in Python. Check for bool separately, and "
    "return the default."
)
NEGATIVE = "The value was negative, but a speed has to be above 0. Return the default in this case."
SET = (
    "The function has set the parameter. Do not set the parameter: return the default if the "
    "value cannot be used."
)
ZERO = "The value was 0, but a speed has to be above 0. Return the default in this case."


@part(
    "16.3",
    points=2,
    goal=(
        "Return a robot's speed from its parameter, or the default if the parameter is "
        "missing or is not a number above 0."
    ),
    needs=["speed_of"],
    deadline=20.0,
)
def speed_parameter(context: CheckContext) -> None:
    """Set the parameter of a robot with a random name to several valid and invalid values."""
    robot = context.random.word()
    first, default = context.random.numbers(2, 1.0, 9.0)
    (second,) = context.random.numbers(1, 0.1, 0.9)
    no_number, not_positive = (
        "speed_of() returns the default if the value is not a number",
        "speed_of() returns the default if the value is not above 0",
    )
    cases: list[tuple[float | str | bool | list[float] | dict[str, float], str, float, str]] = [
        (first, "speed_of() returns the value of the parameter", first, NAME),
        (second, "speed_of() returns the new value after a change of the parameter", second, CHANGED),
        (
            2,
            "speed_of() accepts a whole number",
            2.0,
            "The function did not return the int 2, which is a valid speed. Accept an int, too.",
        ),
        ("fast", no_number, default, TEXT),
        (str(second), no_number, default, TEXT),
        ([first, second], no_number, default, LIST),
        ({"max": first}, no_number, default, GROUP),
        (True, no_number, default, TRUTH),
        (-first, not_positive, default, NEGATIVE),
        (0, not_positive, default, ZERO),
    ]
    try:
        missing = "The parameter is not set. In this case, return the argument `default`."
        _returns(
            context,
            robot,
            default,
            "speed_of() returns the default if the parameter is not set",
            default,
            missing,
        )
        context.require(
            "speed_of() returns the default if the parameter is not set",
            holds=not rospy.has_param(f"/{robot}/speed"),
            expected="no parameter, as before the call",
            actual="a parameter that the function has set",
            hints=SET,
        )
        again = context.random.shuffled(cases)[: context.random.integer(3, 5)]
        for value, assertion, expected, hint in (*cases, *again):
            rospy.set_param(f"/{robot}/speed", value)
            _returns(context, robot, default, assertion, expected, hint)
            context.require(
                assertion,
                holds=str(rospy.get_param(f"/{robot}/speed", None)) == str(value),
                expected="the same parameter as before the call",
                actual="another value of the parameter",
                hints=SET,
            )
    finally:
        with suppress(KeyError):
            rospy.delete_param(f"/{robot}")


def _returns(
    context: CheckContext, robot: str, default: float, assertion: str, expected: float, hint: str
) -> None:
    def right() -> bool:
        return same(expected, _speed(context, robot, default).returned(), 1e-6)

    wait_until(right, SETTLING, 0.1)
    context.expect(
        assertion,
        expected=expected,
        actual=_speed(context, robot, default).returned(),
        near=1e-6,
        hints=[(None, NO_RETURN), (ANYTHING, hint)],
    )


def _speed(context: CheckContext, robot: str, default: float) -> Result:
    return context.run(
        "speed_of",
        robot,
        default,
        hints=[
            (
                matches("^KeyError"),
                (
                    "If the parameter is not set, get_param raises a KeyError. Pass the default as the "
                    "second argument of get_param."
                ),
            ),
            (
                matches("^TypeError"),
                (
                    "Python cannot compare a string, a list or a dict with a number. First check that the "
                    "value is an int or a float."
                ),
            ),
            (
                matches("^ValueError"),
                (
                    "float() raises a ValueError for a string that does not contain a number. "
                    "Catch this error, and "
                    "return the default."
                ),
            ),
        ],
    )
