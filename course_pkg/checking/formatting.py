"""Texts for reports about calls, values and errors."""

from __future__ import annotations

from course_pkg.checking.plain_values import Message, ServiceClass, fields_of
from course_pkg.ros.explain import known
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.types import rosservice_line, service_type


def command_line(name: str, kind: ServiceClass, request: Message) -> str:
    """Return the `rosservice call` command that calls the service `name` with this `request`."""
    return rosservice_line(name, service_type(kind), fields_of(request))


def explained(error: str) -> str:
    """Return the meaning of a ROS error message and what the student can do, or "" for an unknown message."""
    if error.startswith("TimesUp"):
        return (
            "The call has not returned, because the handler does not return. Look for an "
            "endless loop, or for a wait without a time limit."
        )
    explanation = known(error)
    return f"{explanation.cause} {explanation.remedy}" if explanation else ""


def shown(value: Json) -> str:
    """Return `value` as text for a report, such as "x=1, y=2"; a number has at most seven digits."""
    if isinstance(value, float):
        return f"{value:.7g}"
    if isinstance(value, dict) and value.keys() == {"object"}:
        return f"an object of the class {value['object']}"
    if isinstance(value, dict):
        return ", ".join(f"{key}={shown(item)}" for key, item in value.items()) or "nothing"
    if isinstance(value, list):
        return (
            "["
            + ", ".join(f"({shown(item)})" if isinstance(item, dict) else shown(item) for item in value)
            + "]"
        )
    return repr(value)
