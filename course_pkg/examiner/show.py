"""How a report words what crossed the graph."""

from __future__ import annotations

from course_pkg.examiner.plain import Message, Plain, ServiceClass, plain
from course_pkg.graph.explanations import known
from course_pkg.interfaces import rosservice_line, service_type


def command_line(name: str, kind: ServiceClass, request: Message) -> str:
    """Return the `rosservice call` that asks the same."""
    return rosservice_line(name, service_type(kind), plain(request))


def explained(words: str) -> str:
    """Return what ROS's words mean and what to do about it, or an empty text for words not known."""
    if words.startswith("TimesUp"):
        return (
            "The call has not come back: the handler waits for something that does not happen, or never "
            "returns. rospy sets no time limit on a call."
        )
    explanation = known(words)
    return f"{explanation.cause} {explanation.remedy}" if explanation else ""


def shown(value: Plain) -> str:
    """Return plain data as a student would write it, a float32 without the digits that it does not have."""
    if isinstance(value, float):
        return f"{value:.7g}"
    if isinstance(value, dict):
        return ", ".join(f"{key}={shown(item)}" for key, item in value.items()) or "nothing"
    if isinstance(value, list):
        return (
            "["
            + ", ".join(f"({shown(item)})" if isinstance(item, dict) else shown(item) for item in value)
            + "]"
        )
    return repr(value)
