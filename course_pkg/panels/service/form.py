"""The form for calling a service: its request, and how long one waits."""

from __future__ import annotations

from course_pkg.errors import FieldError
from course_pkg.interfaces import ServiceType, rospy_line, rosservice_line, schema
from course_pkg.panels.forms.form import MessageForm, State

DEADLINE = "@deadline"  # no field of a message can have this name
LONGEST = 3600.0


class RequestForm(MessageForm):
    """The form for calling `service`, of the given type."""

    def __init__(self, service: str, kind: ServiceType) -> None:
        super().__init__(
            kind.request,
            lambda values: {
                "shell": rosservice_line(service, kind, values),
                "python": rospy_line(service, kind, values),
            },
        )
        self.service = service
        self.type = kind

    def described(self) -> State:
        """Return the form for the page: the fields of the request with their ranges and comments."""
        return {"type": self.type.name, "md5": self.type.md5, "request": schema(self.type.request)}


def seconds(text: str) -> float:
    """Return a deadline as typed, in s. Raises FieldError."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 < value <= LONGEST:
        raise FieldError(
            DEADLINE,
            text,
            f"a number of seconds above 0, at most {LONGEST:g}",
            f"{text!r} is not a time to wait",
        )
    return value
