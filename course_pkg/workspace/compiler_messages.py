"""The errors of a C++ compiler and linker for a program that uses roscpp (seen with GCC 12 on Debian 12)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from course_pkg.workspace.fault import Fault

_ERROR = re.compile(r"^(?P<file>[^\s:][^:\n]*):(?P<line>\d+):(?:\d+:)? (?:fatal )?error: (?P<text>.+)$", re.M)
_UNDEFINED = re.compile(r"undefined reference to [`'](?P<name>.+?)'$", re.MULTILINE)
_SOURCE = re.compile(r".*/src/(?=[\w.+-]+/(?:\w+/)*[\w.+-]+$)")

_TABLE: tuple[tuple[str, str, str], ...] = (
    (
        r"(?P<name>\S+): No such file or directory",
        "The compiler does not find the header {name}.",
        "Check the spelling of the header's name, and add the header's package to the COMPONENTS of "
        "find_package. Write include_directories(${{catkin_INCLUDE_DIRS}}) above "
        "add_executable.",
    ),
    (
        r"(?:no matching function for call to|call of overloaded) .*advertiseService.*<lambda",
        "advertiseService cannot use this lambda function directly.",
        "Store the lambda function in a boost::function<bool(TYPE::Request&, TYPE::Response&)>, and pass "
        "this object.",
    ),
    (
        r"no matching function for call to .*advertiseService",
        "advertiseService got a function that is not a handler.",
        "Write bool NAME(TYPE::Request& request, TYPE::Response& response), with the same type in both "
        "parameters, and with both &.",
    ),
    (
        r"has no member named .(?P<name>\w+).; did you mean .(?P<near>\w+).",
        "This object has no field or method {name}.",
        "Did you mean {near}?",
    ),
    (
        r"has no member named .(?P<name>\w+).",
        "This object has no field or method {name}.",
        "Compare the name with the fields of the type. The command rossrv show prints these fields.",
    ),
    (
        r"no return statement in function returning|control reaches end of non-void",
        "This function must return a value, but the function can end without a return statement.",
        "Write `return true;` or `return false;` at the end of every branch of the function.",
    ),
    (
        r"expected .*[';]",
        "The compiler expected something that is missing: {message}.",
        "Look for a missing ; or bracket in this line and in the line above it.",
    ),
    (
        r".(?P<name>\w+). (?:was not declared in this scope|has not been declared)",
        "The compiler does not know the name {name}.",
        "Check the spelling of the name, and its prefix (ros:: or std::). Then check the #include lines.",
    ),
    (r"", "The compiler reports: {message}.", "Find the mistake in the line that the compiler reports."),
)


def compiler_faults(text: str) -> Iterator[Fault]:
    """Yield the errors in the student's files first, then other compiler errors, then the linker's errors."""
    found = list(_ERROR.finditer(text))
    for each in sorted(found, key=lambda each: each["file"].startswith(("/usr/", "/opt/"))):
        problem, remedy = _explained(each["text"])
        yield Fault(problem, remedy, _SOURCE.sub("", each["file"]), int(each["line"]))
    for missing in _UNDEFINED.finditer(text):
        yield _unlinked(missing["name"])


def _explained(message: str) -> tuple[str, str]:
    for pattern, problem, remedy in _TABLE:
        if found := re.search(pattern, message):
            known = {"message": message.rstrip("."), **found.groupdict()}
            return problem.format(**known), remedy.format(**known)
    raise AssertionError("the last row matches every message")


def _unlinked(name: str) -> Fault:
    if name == "main":
        return Fault("The program has no function main.", "Write int main(int argc, char** argv) { … }.")
    return Fault(
        f"The program uses {name}, but the program is not linked with a library that contains {name}.",
        "Write target_link_libraries(PROGRAM ${catkin_LIBRARIES}) below add_executable, with the same small "
        "and capital letters. If you wrote this function yourself, look for its definition.",
    )
