"""The definition: read as ROS reads it, compared field by field, and built."""

from __future__ import annotations

import difflib
from collections.abc import Collection

from course_pkg.errors import BrokenDefinition
from course_pkg.examiner import Exam, part
from course_pkg.examiner.checks.chapter_04.lamp import DEFINITION, PACKAGE, TYPE, built, md5_in
from course_pkg.interfaces import MessageType, ServiceType, compile_service
from course_pkg.interfaces.definition import lines

FILE = f"{PACKAGE}/srv/Lamp.srv"
MARK = "\ufeff"


@part(
    "04.1",
    points=2,
    goal="Write Lamp.srv as it is described.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
)
def the_lamp(exam: Exam) -> None:
    """Read the text as ROS does, hold it against the description, and build it elsewhere."""
    text = exam.source(f"file:{FILE}")
    asked, given = compile_service(TYPE, DEFINITION), _read(exam, text)
    answers = {field.name for field in asked.response.fields}
    _names(exam, "request", asked.request, given.request, text, elsewhere=answers)
    _names(exam, "response", asked.response, given.response, text)
    _types(exam, "request", asked.request, given.request, text)
    _types(exam, "response", asked.response, given.response, text)
    _constants(exam, asked, given, text)
    folder = built(exam, given=[FILE])
    md5, printed = md5_in(folder)
    exam.hold(
        "the MD5 is the one of the description",
        md5 == asked.md5,
        expected=asked.md5,
        seen=md5 or printed,
        hints="Everything is there, in another order: the order of the lines counts.",
    )


def _read(exam: Exam, text: str) -> ServiceType:
    rule = "ROS can read it"
    if text.startswith(MARK):
        hint = "In front of line 1 stands an invisible mark of Windows. Save the file as UTF-8 without BOM."
        exam.fail(rule, expected="a definition", seen="a mark that is no letter", hint=hint)
    try:
        given = compile_service(TYPE, text)
    except BrokenDefinition as error:
        seen = f"line {error.line}: {error.text.strip()}" if error.text.strip() else f"line {error.line}"
        hint = f"{_sentence(error.problem)} {_sentence(error.remedy)}"
        hint = "Take the line with the three dots out." if error.text.strip() == "..." else hint
        if "\t" in error.text.split("#")[0].strip():
            hint = "Between type and name stands a tab there. To ROS only blanks part words."
        exam.fail(rule, expected="a definition", seen=seen, hint=hint)
    exam.hold(rule, True)
    return given


def _names(
    exam: Exam,
    half: str,
    asked: MessageType,
    given: MessageType,
    text: str,
    elsewhere: Collection[str] = (),
) -> None:
    wanted, found = [field.name for field in asked.fields], [field.name for field in given.fields]
    exam.hold(
        f"the {half} has the fields {', '.join(wanted)}, in this order",
        wanted == found,
        expected=", ".join(wanted),
        seen=", ".join(found) or "no fields",
        hints=_in_other_half(found, elsewhere, text) or _about_names(half, wanted, found, text),
    )


def _in_other_half(found: list[str], elsewhere: Collection[str], text: str) -> str:
    stray = next((name for name in found if name in elsewhere), "")
    return f"{_line(text, stray)}{stray} belongs to the response: below the line ---." if stray else ""


def _about_names(half: str, wanted: list[str], found: list[str], text: str) -> str:
    missing = [name for name in wanted if name not in found]
    extra = [name for name in found if name not in wanted]
    if not missing and not extra:
        return "All are there. Put the lines into the order of the description: it counts."
    if missing and (near := difflib.get_close_matches(missing[0], extra, n=1, cutoff=0.5)):
        return f"{_line(text, near[0])}{near[0]} should be {missing[0]}: names are compared letter by letter."
    if missing and _line(text, missing[0]):
        side = "above" if half == "request" else "below"
        return f"{_line(text, missing[0])}{missing[0]} belongs to the {half}: {side} the line ---."
    if missing:
        return f"There is no field {missing[0]}."
    if extra[0].upper() in ("OFF", "ON", "BLINK"):
        return f"{_line(text, extra[0])}a constant has a value: uint8 {extra[0].upper()}=… makes it one."
    return f"{_line(text, extra[0])}{extra[0]} is not part of the {half}."


def _types(exam: Exam, half: str, asked: MessageType, given: MessageType, text: str) -> None:
    wanted = [f"{field.type} {field.name}" for field in asked.fields]
    found = [f"{field.type} {field.name}" for field in given.fields]
    pairs = zip(asked.fields, given.fields, strict=True)
    wrong = next((pair for pair in pairs if pair[0].type != pair[1].type), None)
    exam.hold(
        f"the {half} has the types of the description",
        wrong is None,
        expected=", ".join(wanted),
        seen=", ".join(found),
        hints=_about_type(wrong[0].name, wrong[0].type, wrong[1].type, text) if wrong else "",
    )


def _about_type(name: str, wanted: str, found: str, text: str) -> str:
    where = f"{_line(text, name)}{name} "
    base = found.partition("[")[0]
    if "[" in wanted and "[" not in found:
        return f"{where}is one value here. An array has brackets behind its type: {wanted}."
    if wanted.endswith("[]") and "[" in found and not found.endswith("[]"):
        return f"{where}has a fixed length here. Empty brackets take any number: {wanted}."
    if "[" in wanted and not wanted.endswith("[]") and found.endswith("[]"):
        return f"{where}may have any length here. Exactly three is {wanted}."
    if "[" in found and "[" not in wanted:
        return f"{where}is an array here, and one value is asked for: {wanted}."
    if base == "float64":
        return f"{where}is twice as wide as asked for. To ROS that is another type: {wanted}."
    return f"{where}should be {wanted}."


def _constants(exam: Exam, asked: ServiceType, given: ServiceType, text: str) -> None:
    wanted = [f"{each.type} {each.name}={each.value}" for each in asked.request.constants]
    found = [f"{each.type} {each.name}={each.value}" for each in given.request.constants]
    below = [each.name for each in given.response.constants]
    exam.hold(
        f"the request has the constants {', '.join(each.name for each in asked.request.constants)}",
        wanted == found and not below,
        expected=", ".join(wanted),
        seen=", ".join(found) or "no constants in the request",
        hints=_about_constants(wanted, found, below, text),
    )


def _about_constants(wanted: list[str], found: list[str], below: list[str], text: str) -> str:
    if below:
        return f"{_line(text, below[0])}{below[0]} belongs to the request, so it stands above the line ---."
    if sorted(wanted) == sorted(found):
        return "All are there. Put them into the order of the description: it counts."
    wrong = [each for each in found if each not in wanted]
    if wrong:
        name = wrong[0].partition(" ")[2].partition("=")[0]
        right = next((each for each in wanted if f" {name}=" in each), "")
        return (
            f"{_line(text, name)}{wrong[0]} should be {right}."
            if right
            else (f"{_line(text, name)}{name} is no constant of the description: compare the letters.")
        )
    missing = [each for each in wanted if each not in found]
    return f"Write each on a line of its own, such as {missing[0]}." if missing else ""


def _line(text: str, name: str) -> str:
    """Return "line 3: " for the line that declares `name`, an empty text if none does."""
    for line in lines(text):
        if any(word.text.partition("=")[0] == name for word in line.words()[1:]):
            return f"Line {line.number}: "
    return ""


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."
