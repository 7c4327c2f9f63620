"""Read a student's definition of a service type with ROS's own rules."""

from __future__ import annotations

from course_pkg.checking.context import CheckContext
from course_pkg.errors import BrokenDefinition
from course_pkg.types import ServiceType, compile_service

MARK = "\ufeff"


def read_definition(context: CheckContext, name: str, text: str) -> ServiceType:
    """Assert that ROS can read the definition `text` of the type `name`, such as "my_geometry/geometry"."""
    assertion = "ROS can read the definition"
    if text.startswith(MARK):
        hint = (
            "Line 1 begins with an invisible character, the byte order mark (BOM). Save the file as "
            "UTF-8 without BOM."
        )
        context.fail(assertion, expected="a definition", actual="an invisible character", hint=hint)
    try:
        given = compile_service(name, text)
    except BrokenDefinition as error:
        seen = f"line {error.line}: {error.text.strip()}" if error.text.strip() else f"line {error.line}"
        hint = f"{_sentence(error.problem)} {_sentence(error.remedy)}"
        hint = (
            "The definition still contains the line with the three dots. Remove this line."
            if error.text.strip() == "..."
            else hint
        )
        if "\t" in error.text.split("#")[0].strip():
            hint = "There is a tab between the type and the name of a field. Replace the tab with a space."
        context.fail(assertion, expected="a definition", actual=seen, hint=hint)
    context.require(assertion, holds=True)
    return given


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."
