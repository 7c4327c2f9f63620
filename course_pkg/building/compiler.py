"""What a C++ compiler and its linker say of a program against roscpp (seen with GCC 12 on Debian 12)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from course_pkg.building.fault import Fault

_ERROR = re.compile(
    r"^(?P<file>[^\s:][^:\n]*):(?P<line>\d+):(?:\d+:)? (?:fatal )?error: (?P<words>.+)$", re.M
)
_UNDEFINED = re.compile(r"undefined reference to [`'](?P<name>.+?)'$", re.MULTILINE)
_SOURCE = re.compile(r".*/src/(?=[\w.+-]+/(?:\w+/)*[\w.+-]+$)")

_TABLE: tuple[tuple[str, str, str], ...] = (
    (
        r"(?P<name>\S+): No such file or directory",
        "The compiler finds no header {name}.",
        "Compare its spelling, name its package among the COMPONENTS of find_package, and write "
        "include_directories(${{catkin_INCLUDE_DIRS}}) above add_executable.",
    ),
    (
        r"no matching function for call to .*advertiseService",
        "What is given to advertiseService is no handler.",
        "A handler is bool NAME(TYPE::Request& request, TYPE::Response& response): both halves of one type, "
        "and each with its &.",
    ),
    (
        r"has no member named .(?P<name>\w+).; did you mean .(?P<near>\w+).",
        "There is no field or method {name} here.",
        "Did you mean {near}?",
    ),
    (
        r"has no member named .(?P<name>\w+).",
        "There is no field or method {name} here.",
        "rossrv show says which fields a type has, and in which half.",
    ),
    (
        r"no return statement in function returning|control reaches end of non-void",
        "This function promises a value and can end without one.",
        "Write return true or return false on every way through it: what a caller gets is anybody's guess.",
    ),
    (
        r"expected .*[';]",
        "The compiler expected something that is not there: {words}.",
        "Look at this line and the one above it for a missing ; or bracket.",
    ),
    (
        r".(?P<name>\w+). (?:was not declared in this scope|has not been declared)",
        "Nothing here is called {name}.",
        "Compare its spelling, with ros:: or std:: in front, and look for its #include.",
    ),
    (r"", "The compiler says: {words}.", "Look at that line."),
)


def compiler_faults(text: str) -> Iterator[Fault]:
    """Yield what the compiler found, the student's files before others; then what the linker misses."""
    found = list(_ERROR.finditer(text))
    for each in sorted(found, key=lambda each: each["file"].startswith(("/usr/", "/opt/"))):
        problem, remedy = _explained(each["words"])
        yield Fault(problem, remedy, _SOURCE.sub("", each["file"]), int(each["line"]))
    for missing in _UNDEFINED.finditer(text):
        yield _unlinked(missing["name"])


def _explained(words: str) -> tuple[str, str]:
    for pattern, problem, remedy in _TABLE:
        if found := re.search(pattern, words):
            known = {"words": words.rstrip("."), **found.groupdict()}
            return problem.format(**known), remedy.format(**known)
    raise AssertionError("the last row matches everything")


def _unlinked(name: str) -> Fault:
    if name == "main":
        return Fault("The program has no function main.", "Write int main(int argc, char** argv) { … }.")
    return Fault(
        f"The program uses {name}, and is linked with no library that has it.",
        "Write target_link_libraries(PROGRAM ${catkin_LIBRARIES}) below add_executable; for something of "
        "your own, look for its definition.",
    )
