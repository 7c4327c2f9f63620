"""The check of Lamp.srv: it parses the file in the same way as ROS, compares the fields, and builds it."""

from __future__ import annotations

import difflib
from collections.abc import Collection

from course_pkg.chapters.ch04_define_a_service.checks.lamp import DEFINITION, PACKAGE, TYPE, built, md5_in
from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.definition import read_definition
from course_pkg.types import MessageType, ServiceType, compile_service
from course_pkg.types.definition import lines

FILE = f"{PACKAGE}/srv/Lamp.srv"
FIELDS = "Write the fields of the request and the response, and the types of these fields."


@part(
    "04.1",
    points=2,
    goal="Write Lamp.srv as the exercise describes it.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    goals={FIELDS: 3, "Write the constants of the request.": 1},
)
def the_lamp(context: CheckContext) -> None:
    """Parse the student's Lamp.srv in the same way as ROS, and compare it with the exercise's description.

    At the end, build the definition in another folder.
    """
    text = context.source(f"file:{FILE}")
    asked, given = compile_service(TYPE, DEFINITION), read_definition(context, TYPE, text)
    answers = {field.name for field in asked.response.fields}
    _names(context, "request", asked.request, given.request, text, elsewhere=answers)
    _names(context, "response", asked.response, given.response, text)
    _types(context, "request", asked.request, given.request, text)
    _types(context, "response", asked.response, given.response, text)
    context.fulfilled(FIELDS)
    _constants(context, asked, given, text)
    folder = built(context, given=[FILE])
    md5, printed = md5_in(context, folder)
    context.require(
        "the MD5 sum of the definition is right",
        holds=md5 == asked.md5,
        expected=asked.md5,
        actual=md5 or printed,
    )


def _names(
    context: CheckContext,
    half: str,
    asked: MessageType,
    given: MessageType,
    text: str,
    elsewhere: Collection[str] = (),
) -> None:
    wanted, found = [field.name for field in asked.fields], [field.name for field in given.fields]
    context.require(
        f"the {half} has the fields {', '.join(wanted)}, in this order",
        holds=wanted == found,
        expected=", ".join(wanted),
        actual=", ".join(found) or "no fields",
        hints=_in_other_half(found, elsewhere, text) or _about_names(half, wanted, found, text),
    )


def _in_other_half(found: list[str], elsewhere: Collection[str], text: str) -> str:
    stray = next((name for name in found if name in elsewhere), "")
    return (
        f"{_line(text, stray)}the field {stray} belongs to the response. Write this field below the line ---."
        if stray
        else ""
    )


def _about_names(half: str, wanted: list[str], found: list[str], text: str) -> str:
    missing = [name for name in wanted if name not in found]
    extra = [name for name in found if name not in wanted]
    if not missing and not extra:
        return (
            "Your file contains all fields, but in the wrong order. Write the fields in the same "
            "order as in the exercise."
        )
    if missing and (near := difflib.get_close_matches(missing[0], extra, n=1, cutoff=0.5)):
        return (
            f"{_line(text, near[0])}the field {near[0]} has to be called {missing[0]}. Compare the "
            "names letter by letter."
        )
    if missing and _line(text, missing[0]):
        where = f"{_line(text, missing[0])}the field {missing[0]}"
        return f"{where} is on the wrong side of the line ---. Move this field to the {half}."
    if missing:
        return f"The field {missing[0]} is missing. Add this field to the {half}."
    if extra[0].upper() in ("OFF", "ON", "BLINK"):
        return (
            f"{_line(text, extra[0])}a constant needs a value. Write uint8 "
            f"{extra[0].upper()}=… with the value of the constant."
        )
    return (
        f"{_line(text, extra[0])}the field {extra[0]} is not part of the {half} in the exercise. "
        "Remove this field."
    )


def _types(context: CheckContext, half: str, asked: MessageType, given: MessageType, text: str) -> None:
    wanted = [f"{field.type} {field.name}" for field in asked.fields]
    found = [f"{field.type} {field.name}" for field in given.fields]
    pairs = zip(asked.fields, given.fields, strict=True)
    wrong = next((pair for pair in pairs if pair[0].type != pair[1].type), None)
    context.require(
        f"the fields of the {half} have the right types",
        holds=wrong is None,
        expected=", ".join(wanted),
        actual=", ".join(found),
        hints=_about_type(wrong[0].name, wrong[0].type, wrong[1].type, text) if wrong else "",
    )


def _about_type(name: str, wanted: str, found: str, text: str) -> str:
    where = f"{_line(text, name)}the field {name} "
    base = found.partition("[")[0]
    if "[" in wanted and "[" not in found:
        return (
            f"{where}is a single value in your file, but the exercise needs an array. Write brackets "
            f"after the type: {wanted}."
        )
    if wanted.endswith("[]") and "[" in found and not found.endswith("[]"):
        return (
            f"{where}has a fixed length in your file. For an array of any length, the brackets are "
            f"empty: {wanted}."
        )
    if "[" in wanted and not wanted.endswith("[]") and found.endswith("[]"):
        return (
            f"{where}can have any length in your file. For an array of exactly three values, write {wanted}."
        )
    if "[" in found and "[" not in wanted:
        return f"{where}is an array in your file, but the exercise needs a single value: {wanted}."
    if base == "float64":
        return (
            f"{where}has the type {found} in your file, and this type is too large. Copy the type "
            f"from the exercise: {wanted}."
        )
    return f"{where}has the wrong type in your file. Copy the type from the exercise: {wanted}."


def _constants(context: CheckContext, asked: ServiceType, given: ServiceType, text: str) -> None:
    wanted = [f"{each.type} {each.name}={each.value}" for each in asked.request.constants]
    found = [f"{each.type} {each.name}={each.value}" for each in given.request.constants]
    below = [each.name for each in given.response.constants]
    context.require(
        f"the request has the constants {', '.join(each.name for each in asked.request.constants)}",
        holds=wanted == found and not below,
        expected=", ".join(wanted),
        actual=", ".join(found) or "no constants in the request",
        hints=_about_constants(wanted, found, below, text),
    )


def _about_constants(wanted: list[str], found: list[str], below: list[str], text: str) -> str:
    if below:
        return (
            f"{_line(text, below[0])}the constant {below[0]} belongs to the request. Write this "
            "constant above the line ---."
        )
    if sorted(wanted) == sorted(found):
        return (
            "Your file contains all constants, but in the wrong order. Write the constants in the "
            "same order as in the exercise."
        )
    wrong = [each for each in found if each not in wanted]
    if wrong:
        name = wrong[0].partition(" ")[2].partition("=")[0]
        right = next((each for each in wanted if f" {name}=" in each), "")
        return (
            f"{_line(text, name)}{wrong[0]} is wrong. The constant has to be {right}."
            if right
            else f"{_line(text, name)}the exercise has no constant with the name {name}. Compare the "
            "names letter by letter."
        )
    missing = [each for each in wanted if each not in found]
    return f"Write each constant on a separate line, such as {missing[0]}." if missing else ""


def _line(text: str, name: str) -> str:
    """Return "Line N: " with the number of the line that declares `name`, or "" if no line declares it."""
    for line in lines(text):
        if any(word.text.partition("=")[0] == name for word in line.words()[1:]):
            return f"Line {line.number}: "
    return ""
