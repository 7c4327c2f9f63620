"""What CMake says of a package: (words, the file where it is not CMake's line, the problem, the remedy)."""

from __future__ import annotations

import difflib

from course_pkg.building.cmake import Message
from course_pkg.building.fault import Fault

GENERATION = ("add_message_files", "add_service_files", "add_action_files", "generate_messages")
CATKIN = ("catkin_package", "catkin_python_setup", "catkin_install_python")

Row = tuple[str, str, str, str]


def unknown_command(name: str, message: Message) -> Fault:
    """Return why CMake does not know a command: who brings it was not found before, or it is misspelt."""
    if name.lower() in GENERATION:
        problem = f"CMake does not know {name} here: message_generation brings it, and was not found before."
        remedy = "Write find_package(catkin REQUIRED COMPONENTS message_generation) above this line."
    elif name.lower() in CATKIN:
        problem = f"CMake does not know {name} here: catkin brings it, and was not found before."
        remedy = "Write find_package(catkin REQUIRED COMPONENTS …) above this line."
    else:
        near = difflib.get_close_matches(name.lower(), [*GENERATION, *CATKIN, "find_package", "project"], n=1)
        problem = f"There is no command {name} in CMake or catkin."
        remedy = f"Write {near[0]}." if near else "Compare its spelling, or find the package that brings it."
    return Fault(problem, remedy, message.file, message.line)


FROM_CMAKE: tuple[Row, ...] = (
    (
        r"generate_messages\(\) must be called after (?P<name>add_\w+)\(\)",
        "",
        "{name} comes after generate_messages, which by then has made all that it knew of.",
        "Move this line above generate_messages.",
    ),
    (
        r"generate_messages\(\) must be called before catkin_package\(\)",
        "",
        "generate_messages comes after catkin_package, which tells others what there is.",
        "Move generate_messages above catkin_package.",
    ),
    (
        r"generate_messages\(\) must only be called once",
        "",
        "generate_messages stands there twice.",
        "Name all files first, then call it once.",
    ),
    (
        r"file '\S*?/(?P<name>[^/']+)' does not exist.*(?:service|message|action) file not found",
        "",
        "There is no file {name} where this line says.",
        "Compare the name with the file's, upper and lower case too; the folder srv is not part of it.",
    ),
    (
        r"(?P<name>add_\w+)\(\) directory not found: \S*/(?P<package>[^/\s]+)/(?P<folder>\w+)",
        "",
        "{name} looks for its files in the folder {folder}, and {package} has none.",
        "A .srv file lies in srv and is named by add_service_files, a .msg file in msg by add_message_files.",
    ),
    (
        r"(?P<name>add_\w+)\(\) called with unused arguments: (?P<rest>.+)",
        "",
        "{name} does not know what {rest} is.",
        "Write FILES in front of the names of files.",
    ),
    (
        r'package configuration file provided by "(?P<name>[^"]+)"',
        "",
        "find_package asks for {name}, and no such package is here.",
        "Compare its spelling, or install it; and source the workspace that it is in.",
    ),
    (
        r"Messages depends on unknown pkg: (?P<name>\w+)",
        "",
        "generate_messages depends on {name}, which find_package has not found.",
        "Add {name} to the COMPONENTS of find_package.",
    ),
    (
        r"which '\S*?/(?P<package>[^/']+)/(?P<file>srv/[^/']+)' depends on.*"
        r"Cannot locate message \[(?P<type>\w+)\].*? package \[(?P=package)\]",
        "{package}/{file}",
        "{type} is no type that ROS has built in, and {package} has no message of that name.",
        "Write a type that there is, such as float32 for float or int32 for int.",
    ),
    (
        r"which '\S*?/(?P<file>[^/']+\.srv)' depends on.*"
        r"Cannot locate message \[(?P<type>\w+)\].*? package \[(?P<package>\w+)\]",
        "",
        "{file} uses {package}/{type}, and nothing says here that it depends on {package}.",
        "Write generate_messages(DEPENDENCIES {package}), and {package} in find_package's COMPONENTS, too.",
    ),
    (
        r"package name '(?P<name>[^']*)' in '\S*?/(?P<folder>[^/']+)/package\.xml' does not match current "
        r"PROJECT_NAME '(?P<project>[^']*)'",
        "",
        "package.xml has the name {name}, and CMakeLists.txt has {project}.",
        "Write one name in both, in <name> and in project().",
    ),
    (
        r"PROJECT_NAME is set to 'Project'",
        "",
        "There is no project() line.",
        "Write project(NAME) near the top, with the name that package.xml has.",
    ),
    (
        r"DEPENDS on the catkin package '(?P<name>[^']+)' which must therefore be listed as a run dependency",
        "",
        "catkin_package names {name}, and package.xml does not say that it is needed to run.",
        "Add <exec_depend>{name}</exec_depend> to package.xml, or take {name} out of catkin_package.",
    ),
    (
        r"the catkin package '(?P<name>[^']+)' has been find_package\(\)-ed but is not listed as a build dep",
        "",
        "find_package asks for {name}, and package.xml does not say that it is needed to build.",
        "Add <build_depend>{name}</build_depend> to package.xml.",
    ),
    (
        r"'catkin' must be listed as a buildtool dependency",
        "",
        "package.xml does not say what the package is built with.",
        "Add <buildtool_depend>catkin</buildtool_depend> to package.xml.",
    ),
    (
        r"Parse error\.\s+Function missing ending",
        "",
        "A bracket that is opened here is never closed.",
        "Write the missing ).",
    ),
    (
        r"Parse error.*got (?P<what>.+) with text \"(?P<text>.*?)\"",
        "",
        "CMake cannot read this line: it meets {text} where a command belongs.",
        "A command is a name and brackets, such as project(my_services); a comment begins with #.",
    ),
    (
        r"Cannot find source file:\s+(?P<name>\S+)",
        "",
        "There is no file {name} where this line says.",
        "Write its path from the package's own folder, such as src/NAME.cpp, and compare the spelling.",
    ),
    (
        r'Cannot specify link libraries for target "(?P<name>[^"]+)" which is not built',
        "",
        "There is no program {name} above this line.",
        "add_executable comes first, and both have the same name.",
    ),
    (
        r"No CMAKE_CXX_COMPILER could be found|Could not find compiler set in environment variable CXX",
        "",
        "CMake finds no C++ compiler.",
        "Install one: g++ on Debian and Ubuntu, the package compilers of conda.",
    ),
    (
        r"The source directory \S*?/(?P<package>[^/\s]+) does not contain a CMakeLists\.txt file",
        "{package}",
        "The package has no CMakeLists.txt.",
        "Write one. Its name is spelt just so, upper and lower case.",
    ),
    (
        r"current CMakeCache\.txt directory .* is different",
        "",
        "The folder build was made for another place: the workspace was moved or copied.",
        "Remove the folders build and devel, and build again.",
    ),
)

SILENT: tuple[Row, ...] = (
    (
        r"generate_messages\(\) without having added any message or service",
        "",
        "No file was named before generate_messages, so nothing is made.",
        "Write add_service_files(FILES …) above it.",
    ),
)
