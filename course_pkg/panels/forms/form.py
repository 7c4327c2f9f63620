"""A message as one types it: a tree of texts, what is wrong with it, what it amounts to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from course_pkg.errors import FieldError
from course_pkg.interfaces import MessageType
from course_pkg.panels.forms.texts import Texts, compact

State = dict[str, Any]
Commands = Callable[[Mapping[str, Any]], dict[str, str]]


class MessageForm:
    """The form for a message; `commands` makes of its values the lines that do the same by hand."""

    def __init__(self, message: MessageType, commands: Commands) -> None:
        self.message = message
        self.blank: Texts = self.texts(message.default())
        self._commands = commands

    def errors(self, draft: Texts) -> dict[str, str]:
        """Return what is allowed instead by the path of what is wrong; one for each top-level field."""
        wrong: dict[str, str] = {}
        for name in self.blank:
            try:
                self.message.parse({**self.blank, name: draft.get(name, self.blank[name])})
            except FieldError as error:
                wrong[error.field] = correction(error)
        return wrong

    def checked(self, draft: Texts) -> State:
        """Return the errors, or the commands that do the same as the form."""
        try:
            values = self.values(draft)
        except FieldError:
            return {"errors": self.errors(draft)}
        return {"errors": {}, **self._commands(values)}

    def values(self, draft: Texts) -> dict[str, Any]:
        """Return the plain values of the message. Raises FieldError."""
        values: dict[str, Any] = self.message.parse({**self.blank, **draft})
        return values

    def filled(self, draft: Texts, values: Mapping[str, Any]) -> Texts:
        """Return the draft with plain values written into it. Raises FieldError where one does not fit."""
        whole = self.message.check({**self.message.default(), **values})
        texts = self.texts(whole)
        return {**draft, **{name: texts[name] for name in values}}

    def texts(self, values: Mapping[str, Any]) -> Texts:
        """Return plain values as the form shows them."""
        return compact(self.message.fields, self.message.format(values))


def correction(error: FieldError) -> str:
    """Return what is wrong with a field and what would be right; the field's name stands beside it."""
    hint = f"; {error.hint}" if error.hint else ""
    return f"{error.problem[:1].upper()}{error.problem[1:]}. Give {error.allowed}{hint}."
