"""Reads the messages of CMake in the output of a build, and the commands in a CMakeLists.txt.

CMake breaks its messages into lines of about 75 characters. A message contains the name of the file that
reported the error. The student's line is in the call stack below the message. Each row of a table of messages
is (pattern, file, problem, remedy). If `file` is empty, the message contains the name of the wrong file.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from dataclasses import dataclass

from course_pkg.workspace.fault import Fault

GENERATION = ("add_message_files", "add_service_files", "add_action_files", "generate_messages")
CATKIN = ("catkin_package", "catkin_python_setup", "catkin_install_python")

Row = tuple[str, str, str, str]

_HEAD = re.compile(
    r"CMake (?P<kind>Error|Warning)(?: \(dev\))?"
    r"(?: at (?P<file>.+?):(?P<line>\d+)(?: \(\w+\))?)?:(?P<rest>.*)"
)
# The pattern matches only files of the student's packages. CMake prints catkin's top-level file without a
# folder, and files outside of src with absolute paths.
_OURS = re.compile(r"(?P<file>[\w.+-]+(?:/[\w.+-]+)*/CMakeLists\.txt):(?P<line>\d+)")
_STACK = "Call Stack (most recent call first):"
_COMMAND = re.compile(r"(?P<comment>#\s*)?(?P<name>[A-Za-z_]\w*)[ \t]*\(")


@dataclass(frozen=True)
class Message:
    """One message as one line of text, and the line of CMakeLists.txt that caused this message."""

    text: str
    file: str
    line: int
    is_error: bool


@dataclass(frozen=True)
class Command:
    """A command in a CMakeLists.txt, and the line where it begins."""

    name: str
    line: int
    is_comment: bool


def cmake_messages(output: str) -> Iterator[Message]:
    """Yield the errors and warnings of CMake in the output of a build, in the order of the output."""
    lines = output.splitlines()
    for number, line in enumerate(lines):
        if head := _HEAD.match(line):
            yield _message(head, lines[number + 1 :])


def _message(head: re.Match[str], below: list[str]) -> Message:
    body = list(_indented(below))
    split = body.index(_STACK) if _STACK in body else len(body)
    text = " ".join(" ".join([head["rest"], *body[:split]]).split())
    places = [f"{head['file']}:{head['line']}", *body[split + 1 :]]
    ours = next((found for place in places if (found := _OURS.match(place.strip()))), None)
    is_error = head["kind"] == "Error"
    return (
        Message(text, ours["file"], int(ours["line"]), is_error) if ours else Message(text, "", 0, is_error)
    )


def _indented(lines: list[str]) -> Iterator[str]:
    """Yield the lines of a message: indented lines, empty lines between them, and the call stack."""
    for line in lines:
        if line.strip() and not line.startswith("  ") and line.strip() != _STACK:
            return
        yield line.strip()


def cmake_commands(text: str) -> Iterator[Command]:
    """Yield the commands of a CMakeLists.txt, including the commands in comments."""
    for number, line in enumerate(text.splitlines(), 1):
        if found := _COMMAND.match(line.strip()):
            yield Command(found["name"].lower(), number, bool(found["comment"]))


def unknown_command(name: str, message: Message) -> Fault:
    """Return the fault for an unknown command.

    The package that defines the command was not found, or the command's name is misspelt.
    """
    if name.lower() in GENERATION:
        problem = (
            f"CMake does not know the command {name}. The package message_generation defines "
            "this command, but no find_package above this line contains this package."
        )
        remedy = "Write find_package(catkin REQUIRED COMPONENTS message_generation) above this line."
    elif name.lower() in CATKIN:
        problem = (
            f"CMake does not know the command {name}. catkin defines this command, but catkin was "
            "not found above this line."
        )
        remedy = "Write find_package(catkin REQUIRED COMPONENTS …) above this line."
    else:
        near = difflib.get_close_matches(name.lower(), [*GENERATION, *CATKIN, "find_package", "project"], n=1)
        problem = f"CMake and catkin have no command {name}."
        remedy = (
            f"Write {near[0]}."
            if near
            else (
                "Check the spelling of the command. If the spelling is right, find the package that "
                "defines the command."
            )
        )
    return Fault(problem, remedy, message.file, message.line)


FROM_CMAKE: tuple[Row, ...] = (
    (
        r"generate_messages\(\) must be called after (?P<name>add_\w+)\(\)",
        "",
        "{name} comes after generate_messages, so generate_messages does not use the files of this command.",
        "Move this line above generate_messages.",
    ),
    (
        r"generate_messages\(\) must be called before catkin_package\(\)",
        "",
        "generate_messages comes after catkin_package, but it has to come before catkin_package.",
        "Move generate_messages above catkin_package.",
    ),
    (
        r"generate_messages\(\) must only be called once",
        "",
        "CMakeLists.txt calls generate_messages twice.",
        "List all files above generate_messages, and call generate_messages only once.",
    ),
    (
        r"file '\S*?/(?P<name>[^/']+)' does not exist.*(?:service|message|action) file not found",
        "",
        "The file {name} is not in the folder that this command searches.",
        "Check the spelling of the file's name, including upper and lower case. Do not write "
        "the folder srv in front of the name.",
    ),
    (
        r"(?P<name>add_\w+)\(\) directory not found: \S*/(?P<package>[^/\s]+)/(?P<folder>\w+)",
        "",
        "{name} looks for files in the folder {folder}, but {package} has no such folder.",
        "Put .srv files into srv, and list them in add_service_files. Put .msg files into msg, and "
        "list them in add_message_files.",
    ),
    (
        r"(?P<name>add_\w+)\(\) called with unused arguments: (?P<rest>.+)",
        "",
        "The command {name} does not know the argument {rest}.",
        "Write FILES before the names of files.",
    ),
    (
        r'package configuration file provided by "(?P<name>[^"]+)"',
        "",
        "find_package needs the package {name}, but this package is not installed.",
        "Check the spelling of the package's name, or install the package. If the package is in a "
        "workspace, source that workspace.",
    ),
    (
        r"Messages depends on unknown pkg: (?P<name>\w+)",
        "",
        "generate_messages depends on {name}, but find_package has not found this package.",
        "Add {name} to the COMPONENTS of find_package.",
    ),
    (
        r"which '\S*?/(?P<package>[^/']+)/(?P<file>srv/[^/']+)' depends on.*"
        r"Cannot locate message \[(?P<type>\w+)\].*? package \[(?P=package)\]",
        "{package}/{file}",
        "{type} is not a built-in type of ROS, and {package} has no message with this name.",
        "Write an existing type, such as float32 instead of float, or int32 instead of int.",
    ),
    (
        r"which '\S*?/(?P<file>[^/']+\.srv)' depends on.*"
        r"Cannot locate message \[(?P<type>\w+)\].*? package \[(?P<package>\w+)\]",
        "",
        "{file} uses the type {package}/{type}, but CMakeLists.txt does not name {package} as a dependency.",
        "Write generate_messages(DEPENDENCIES {package}), and add {package} to the COMPONENTS "
        "of find_package.",
    ),
    (
        r"package name '(?P<name>[^']*)' in '\S*?/(?P<folder>[^/']+)/package\.xml' does not match current "
        r"PROJECT_NAME '(?P<project>[^']*)'",
        "",
        "package.xml has the name {name}, but CMakeLists.txt has the name {project}.",
        "Write the same name in <name> and in project().",
    ),
    (
        r"PROJECT_NAME is set to 'Project'",
        "",
        "CMakeLists.txt has no line with project().",
        "Write project(NAME) near the top of the file, where NAME is the package's name in package.xml.",
    ),
    (
        r"DEPENDS on the catkin package 'message_generation' which must therefore be listed as a run",
        "",
        "catkin_package lists message_generation, which only the build needs.",
        "In catkin_package, write message_runtime instead of message_generation.",
    ),
    (
        r"DEPENDS on the catkin package '(?P<name>[^']+)' which must therefore be listed as a run dependency",
        "",
        "catkin_package lists {name}, but package.xml does not list {name} as a package that "
        "the program needs at run time.",
        "Add <exec_depend>{name}</exec_depend> to package.xml, or remove {name} from catkin_package.",
    ),
    (
        r"the catkin package '(?P<name>[^']+)' has been find_package\(\)-ed but is not listed as a build dep",
        "",
        "find_package needs {name}, but package.xml does not list {name} as a package that the build needs.",
        "Add <build_depend>{name}</build_depend> to package.xml.",
    ),
    (
        r"'catkin' must be listed as a buildtool dependency",
        "",
        "package.xml does not contain the build tool.",
        "Add <buildtool_depend>catkin</buildtool_depend> to package.xml.",
    ),
    (
        r"add_dependencies called with incorrect number of arguments",
        "",
        "add_dependencies has only one argument, because the variables after the first argument are empty.",
        "Move add_dependencies below generate_messages. Write both pairs of ${{ }} in "
        "${{${{PROJECT_NAME}}_EXPORTED_TARGETS}}.",
    ),
    (
        r'The dependency target "(?P<name>\w+_EXPORTED_TARGETS)" of target',
        "",
        "There is no target {name}: this is only the name of a variable.",
        "Write ${{ }} around the whole name of the variable to get its value, as in "
        "${{${{PROJECT_NAME}}_EXPORTED_TARGETS}}.",
    ),
    (
        r"Parse error\.\s+Function missing ending",
        "",
        "This line opens a parenthesis that is never closed.",
        "Write the missing closing parenthesis.",
    ),
    (
        r"Parse error.*got (?P<what>.+) with text \"(?P<text>.*?)\"",
        "",
        "CMake cannot read this line: it contains {text} at the place where a command has to begin.",
        "Write a command as a name with parentheses, such as project(my_services). Begin a comment with #.",
    ),
    (
        r"Cannot find source file:\s+(?P<name>\S+)",
        "",
        "The file {name} does not exist at this path.",
        "Write the path of the file relative to the folder of the package, such as "
        "src/NAME.cpp, and check the spelling.",
    ),
    (
        r'Cannot specify link libraries for target "(?P<name>[^"]+)" which is not built',
        "",
        "No line above this line creates the program {name}.",
        "Write add_executable above this line, and use the same program name in both commands.",
    ),
    (
        r"No CMAKE_CXX_COMPILER could be found|Could not find compiler set in environment variable CXX",
        "",
        "CMake finds no C++ compiler.",
        "Install a C++ compiler: the package g++ on Debian and Ubuntu, or the conda package with the "
        "name compilers.",
    ),
    (
        r"The source directory \S*?/(?P<package>[^/\s]+) does not contain a CMakeLists\.txt file",
        "{package}",
        "The package has no CMakeLists.txt.",
        "Create this file. The name of the file must be exactly CMakeLists.txt, including "
        "upper and lower case.",
    ),
    (
        r"current CMakeCache\.txt directory .* is different",
        "",
        "The workspace was moved or copied, but the folder build still contains the old path.",
        "Remove the folders build and devel, and build again.",
    ),
)

SILENT: tuple[Row, ...] = (
    (
        r"generate_messages\(\) without having added any message or service",
        "",
        "No file was listed before generate_messages, so generate_messages generates nothing.",
        "Write add_service_files(FILES …) above generate_messages.",
    ),
)
