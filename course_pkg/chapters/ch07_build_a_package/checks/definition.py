"""07.2 and 07.8: the student's service definitions; the checks build them and compare the MD5 sums."""

from __future__ import annotations

import difflib

from course_pkg.chapters.ch07_build_a_package.checks.packages import (
    GEOMETRY,
    MY_GEOMETRY,
    SERVICE_EXAMPLE,
    SERVICE_EXAMPLE_PACKAGE,
)
from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.catkin_package import Package, built
from course_pkg.checking.shared.definition import read_definition
from course_pkg.types import MessageType, compile_service

GEOMETRY_FILE = "srv/geometry.srv"
EXAMPLE_FILE = "srv/ServiceExample.srv"


@part(
    "07.2",
    points=1,
    goal=(
        "Write geometry.srv, in which all fields are float32. The request has the fields "
        "length, width and height, and the response has the fields area and volume."
    ),
    needs=[f"file:{MY_GEOMETRY.path(GEOMETRY_FILE)}"],
    deadline=60.0,
)
def the_definition(context: CheckContext) -> None:
    """Compare the fields in the student's geometry.srv, and build the package with this file."""
    _examine(context, MY_GEOMETRY, GEOMETRY_FILE, "geometry", GEOMETRY)


@part(
    "07.8",
    points=1,
    goal=(
        "Write ServiceExample.srv in the package service_example. The request has the field "
        "number (int32), and the response has the field state (string)."
    ),
    needs=[f"file:{SERVICE_EXAMPLE_PACKAGE.path(EXAMPLE_FILE)}"],
    deadline=60.0,
)
def the_second_definition(context: CheckContext) -> None:
    """Compare the fields in the student's ServiceExample.srv, and build the package with this file."""
    _examine(context, SERVICE_EXAMPLE_PACKAGE, EXAMPLE_FILE, "ServiceExample", SERVICE_EXAMPLE)


def _examine(context: CheckContext, package: Package, file: str, name: str, text: str) -> None:
    full = f"{package.name}/{name}"
    asked = compile_service(full, text)
    given = read_definition(context, full, context.source(f"file:{package.path(file)}"))
    _compare(context, "request", asked.request, given.request, asked.response)
    _compare(context, "response", asked.response, given.response, asked.request)
    md5, printed = built(context, package, examined=file, alone=True).md5(name)
    context.require(
        f"the MD5 sum of {full} is right",
        holds=md5 == asked.md5,
        expected=asked.md5,
        actual=md5 or printed.rpartition("\n")[2],
        hints=(
            "The MD5 sum is wrong, because it depends on the constants, too. Write only the fields of "
            "the exercise, without constants."
        ),
    )


def _compare(
    context: CheckContext, half: str, asked: MessageType, given: MessageType, other: MessageType
) -> None:
    wanted = [f"{field.type} {field.name}" for field in asked.fields]
    found = [f"{field.type} {field.name}" for field in given.fields]
    context.require(
        f"the {half} has the fields {', '.join(wanted)}",
        holds=wanted == found,
        expected=", ".join(wanted),
        actual=", ".join(found) or "no fields",
        hints=_hint(half, asked, given, other) if wanted != found else "",
    )


def _hint(half: str, asked: MessageType, given: MessageType, other: MessageType) -> str:
    wanted = {field.name: field.type for field in asked.fields}
    found = {field.name: field.type for field in given.fields}
    missing = [name for name in wanted if name not in found]
    extra = [name for name in found if name not in wanted]
    if stray := next((field.name for field in other.fields if field.name in extra), ""):
        return (
            f"The field {stray} is on the wrong side of the line ---. Write the request above "
            "this line, and the response below this line."
        )
    if missing and (near := difflib.get_close_matches(missing[0], extra, n=1, cutoff=0.5)):
        return (
            f"The name of the field {near[0]} contains a spelling mistake. Compare this name with the "
            "name in the exercise, letter by letter."
        )
    if missing:
        return f"The {half} has no field {missing[0]}. Add this field."
    if extra:
        return f"The {half} contains the field {extra[0]}, which is not in the exercise. Remove this field."
    wrong = next((name for name in wanted if wanted[name] != found[name]), "")
    if wrong:
        return (
            f"The field {wrong} has the type {found[wrong]}. Copy the type from the exercise, which "
            f"is {wanted[wrong]}."
        )
    return (
        "The order of the fields is wrong, and the MD5 sum depends on the order. The first field has "
        f"to be {next(iter(wanted))}."
    )
