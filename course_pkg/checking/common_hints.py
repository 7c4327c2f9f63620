"""Hints and conditions that the checks of several chapters use."""

from __future__ import annotations

from course_pkg.checking.assertions import Hints, matches

NO_RETURN = "The function returned None, because it ended without a return line."
# After a ServiceException, the error message is from the handler. After a wrong return value, the error
# message is from rospy.
REFUSED_BY_HANDLER = matches("cannot process request: (?!(service )?handler returned)")
# rospy sends this error message to the client if a handler raises another exception than ServiceException.
HANDLER_RAISED: Hints = [
    (
        matches(r"error processing request: .*takes 1 positional argument but 2 were given"),
        "The handler is a method without self. Write it with two parameters, self and request.",
    ),
    (
        matches(r"error processing request: .*takes 0 positional arguments but 1 was given"),
        "The handler has no parameter. rospy calls it with one argument, the request.",
    ),
    (
        matches(r"error processing request: '\w+' object is not callable"),
        "rospy.Service got the result of a call instead of a handler. Pass the name of the handler "
        "without parentheses.",
    ),
    (
        matches(r"error processing request: '\w+Request' object has no attribute"),
        "The request has no field of this name. Compare the name with the fields that rossrv show prints "
        "for the type.",
    ),
    (
        matches(r"error processing request: (local variable .* referenced|cannot access local variable)"),
        "The handler assigns a value to this name, so Python treats the name as a local variable. "
        "Store the value in self, or declare the name as `global`.",
    ),
    (
        matches(r"error processing request: name '\w+' is not defined"),
        (
            "The handler uses a name that does not exist. Compare its spelling with the line that "
            "defines the name."
        ),
    ),
]
