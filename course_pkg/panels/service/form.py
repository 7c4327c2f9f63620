"""The request as one types it: a tree of texts, what is wrong with it, what it amounts to."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from course_pkg.errors import FieldError
from course_pkg.interfaces import ServiceType, rospy_line, rosservice_line, schema
from course_pkg.panels.service.texts import Texts, compact

State = dict[str, Any]

DEADLINE = "@deadline"  # no field of a message can have this name
LONGEST = 3600.0


class RequestForm:
    """The form for calling `service`, of the given type."""

    def __init__(self, service: str, kind: ServiceType) -> None:
        self.service = service
        self.type = kind
        self.blank: Texts = self._texts(kind.request.default())

    def described(self) -> State:
        """Return the form for the page: the fields of the request with their ranges and comments."""
        return {"type": self.type.name, "md5": self.type.md5, "request": schema(self.type.request)}

    def errors(self, draft: Texts) -> dict[str, str]:
        """Return what is allowed instead by the path of what is wrong; one for each top-level field."""
        wrong: dict[str, str] = {}
        for name in self.blank:
            try:
                self.type.request.parse({**self.blank, name: draft.get(name, self.blank[name])})
            except FieldError as error:
                wrong[error.field] = correction(error)
        return wrong

    def checked(self, draft: Texts) -> State:
        """Return the errors, or the two commands that do the same as the form."""
        try:
            values = self.values(draft)
        except FieldError:
            return {"errors": self.errors(draft)}
        return {
            "errors": {},
            "shell": rosservice_line(self.service, self.type, values),
            "python": rospy_line(self.service, self.type, values),
        }

    def values(self, draft: Texts) -> dict[str, Any]:
        """Return the plain values of the request. Raises FieldError."""
        values: dict[str, Any] = self.type.request.parse({**self.blank, **draft})
        return values

    def filled(self, draft: Texts, values: Mapping[str, Any]) -> Texts:
        """Return the draft with plain values written into it. Raises FieldError where one does not fit."""
        whole = self.type.request.check({**self.type.request.default(), **values})
        texts = self._texts(whole)
        return {**draft, **{name: texts[name] for name in values}}

    def _texts(self, values: Mapping[str, Any]) -> Texts:
        return compact(self.type.request.fields, self.type.request.format(values))


def correction(error: FieldError) -> str:
    """Return what is wrong with a field and what would be right; the field's name stands beside it."""
    hint = f"; {error.hint}" if error.hint else ""
    return f"{error.problem[:1].upper()}{error.problem[1:]}. Give {error.allowed}{hint}."


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
