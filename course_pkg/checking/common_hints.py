"""Hints and conditions that the checks of several chapters use."""

from __future__ import annotations

from course_pkg.checking.assertions import Hints, matches

NO_RETURN = "The function ended without a return statement, so it returned None. Add a return statement."
# This pattern matches the message of a handler's ServiceException, but not rospy's message about a wrong
# return value.
REFUSED_BY_HANDLER = matches("cannot process request: (?!(service )?handler returned)")
# If a handler raises an exception other than ServiceException, rospy sends this error message to the client.
HANDLER_RAISED: Hints = [
    (
        matches(r"error processing request: .*takes 1 positional argument but 2 were given"),
        "The handler is a method without the parameter `self`. Write the handler with two "
        "parameters, `self` and `request`.",
    ),
    (
        matches(r"error processing request: .*takes 0 positional arguments but 1 was given"),
        "The handler has no parameter, but rospy calls the handler with one argument. Add the "
        "parameter `request`.",
    ),
    (
        matches(r"error processing request: '\w+' object is not callable"),
        "rospy.Service got the result of a call instead of a handler. Pass the name of the "
        "handler without parentheses.",
    ),
    (
        matches(r"error processing request: '\w+Request' object has no attribute"),
        "The request has no field with this name. Compare the name with the fields that `rossrv "
        "show` prints for the service type.",
    ),
    (
        matches(r"error processing request: (local variable .* referenced|cannot access local variable)"),
        "The handler assigns a value to a name, so Python treats this name as a local "
        "variable. Store the value in `self`, or declare the name as `global`.",
    ),
    (
        matches(r"error processing request: name '\w+' is not defined"),
        (
            "The handler uses a name that does not exist. Compare the spelling of the name with "
            "the line that defines this name."
        ),
    ),
]
