"""13.1: the repaired CMakeLists.txt of a package with a C++ program."""

from __future__ import annotations

import re
from dataclasses import replace

from course_pkg.chapters.ch13_cpp.checks.compiled_program import LIMITS, PACKAGE, require_tools
from course_pkg.checking import CheckContext, part
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.catkin_package import run_catkin_make
from course_pkg.checking.shared.roscpp_program import require_roscpp
from course_pkg.workspace import Fault, explain
from course_pkg.workspace.cmake_messages import cmake_commands

FILE = f"{PACKAGE}/CMakeLists.txt"
BUILDING = 75.0  # The build may take up to this time in s; it takes 4 s on an idle machine.
NO_ROSCPP = (
    "The variable catkin_LIBRARIES contains only the libraries of the packages in "
    "find_package(catkin … COMPONENTS …). Add roscpp after the word COMPONENTS."
)
ONLY_ROSCPP = (
    "A server also needs the libraries that roscpp uses, such as rostime. Write ${catkin_LIBRARIES} into "
    "target_link_libraries, because this variable contains all these libraries."
)
RULE = "catkin_make builds the package"
BUILT = "devel/lib/cpp_boxes/box_server"
# With the option -n, make only prints the commands that are necessary after the change of the file.
AGAIN = f"touch {PACKAGE}/src/box_server.cpp && make -n -C build"
COMPILED_AGAIN = re.compile(r"-c \S*box_server\.cpp|link_script")

START = f"""%%writefile {FILE}
cmake_minimum_required(VERSION 3.10)
project(cpp_boxes)

find_package(catkin REQUIRED COMPONENTS course_pkg)
catkin_package()

target_link_libraries(box_server ${{catkin_LIBRARIES}})
add_executable(box_server box_server.cpp)
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="2">
  <name>cpp_boxes</name>
  <version>0.1.0</version>
  <description>Boxes in C++.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <depend>roscpp</depend>
  <depend>course_pkg</depend>
</package>
"""
PROGRAM = """\
#include <course_pkg/geometry.h>
#include <ros/init.h>

#include <iostream>

int main(int argc, char** argv) {
  ros::init(argc, argv, "sound");
  ros::Time::init();
  ros::serialization::serializationLength(course_pkg::geometry::Request());
  if (!ros::Time::isValid()) ros::serialization::throwStreamOverrun();
  std::cout << "DRAWN" << std::endl;
  return course_pkg::geometry::Request().length != 0;
}
"""  # A random text replaces `DRAWN`, so only a program built from this code prints the text.
# Like every server, this program also needs the libraries rostime and roscpp_serialization.

# The student's CMakeLists.txt must not build a program from this file.
OTHER_PROGRAM = "int main() { return 0; }\n"
SECOND_MAIN = (
    "CMake built box_server from all the files in the folder src, but a program can have only one "
    "main(). In add_executable, write only src/box_server.cpp after the name of the program."
)


@part(
    "13.1",
    points=2,
    goal="Repair CMakeLists.txt: catkin_make has to build the program box_server from src/box_server.cpp.",
    needs=[f"file:{FILE}"],
    deadline=90.0,
    start=START,
)
def cmake_list_file(context: CheckContext) -> None:
    """Build the check's own program with the student's CMakeLists.txt; the executable must exist."""
    require_tools()
    drawn = context.random.word(12)
    code = PROGRAM.replace("DRAWN", drawn)
    texts = {
        f"{PACKAGE}/package.xml": MANIFEST,
        f"{PACKAGE}/src/box_server.cpp": code,
        f"{PACKAGE}/src/{context.random.word()}.cpp": OTHER_PROGRAM,
    }
    folder = context.folder(files=[FILE], texts=texts)
    _builds(context, run_catkin_make(folder, f"{LIMITS};", within=BUILDING))
    there = folder.command("test", "-x", BUILT)
    context.require(
        "rosrun finds the program box_server",
        holds=there.status == 0,
        expected=BUILT,
        actual="no program with this name",
        hints=_why_not_there(context.source(f"file:{FILE}")),
    )
    require_roscpp(context, folder, BUILT)
    printed = folder.command(f"./{BUILT}").out.strip()
    if printed != drawn:
        _not_from_the_file(context, f"a program that prints {drawn}", printed)
    planned = folder.command("sh", "-c", AGAIN, within=20.0, worded="make")
    if planned.status == 0 and not COMPILED_AGAIN.search(planned.out):
        _not_from_the_file(context, "after a change of the file, make compiles it again", "no compilation")


def _not_from_the_file(context: CheckContext, expected: str, actual: str) -> None:
    context.fail(
        "the program is built from src/box_server.cpp",
        expected=expected,
        actual=actual,
        hint="The program was not built from src/box_server.cpp. Write this file name into add_executable.",
    )


def _builds(context: CheckContext, finished: Finished) -> None:
    if finished.status == 0:
        context.require(RULE, holds=True)
        return
    printed = f"{finished.out}\n{finished.err}"
    fault = _fault_in(printed)
    # The check's own program is right, so the mistake is in the student's CMakeLists.txt.
    if not fault.file.endswith("CMakeLists.txt"):
        fault = replace(fault, file="cpp_boxes/CMakeLists.txt", line=0)
        text = context.source(f"file:{FILE}")
        if _lacks_roscpp(text):
            fault = replace(fault, remedy=NO_ROSCPP)
        elif _links_only_roscpp(text):
            fault = replace(fault, remedy=ONLY_ROSCPP)
    context.fail(
        RULE,
        expected="a successful build",
        actual=f"{fault.place}: {fault.problem}" if fault.place else fault.problem,
        hint=fault.remedy,
    )


def _fault_in(printed: str) -> Fault:
    """Return the cause of a failed build, from the output of catkin_make."""
    if "multiple definition of `main'" in printed or "duplicate symbol" in printed:
        return Fault("main() is defined twice", SECOND_MAIN, file="cpp_boxes/CMakeLists.txt")
    last = " / ".join([line for line in printed.strip().splitlines() if line.strip()][-3:])
    return explain(printed) or Fault(
        "catkin_make failed", f"Read the end of the output of catkin_make: {last}."
    )


def _lacks_roscpp(text: str) -> bool:
    """Return whether CMakeLists.txt links the program with catkin's libraries, but does not name `roscpp`.

    Without `roscpp` in find_package, the variable catkin_LIBRARIES does not contain the library roscpp.
    """
    code = re.sub(r"#[^\n]*", "", text)
    return (
        bool(re.search(r"(?i)target_link_libraries\s*\([^)]*catkin_LIBRARIES", code)) and "roscpp" not in code
    )


def _links_only_roscpp(text: str) -> bool:
    """Return whether CMakeLists.txt links a program with `roscpp`, but not with all of catkin's libraries."""
    code = re.sub(r"#[^\n]*", "", text)
    linked = re.findall(r"(?i)target_link_libraries\s*\(([^)]*)\)", code)
    return any("roscpp" in each for each in linked) and not any("catkin_LIBRARIES" in each for each in linked)


def _why_not_there(text: str) -> str:
    found = {command.name: command for command in cmake_commands(text) if not command.is_comment}
    if "add_executable" not in found:
        return (
            "The command add_executable is missing, so CMake builds no program. Add this command "
            "with the program's name and the file src/box_server.cpp."
        )
    if "catkin_package" not in found:
        return (
            "The command catkin_package is missing. Write catkin_package() below find_package, "
            "because catkin_package() sets the folder for programs."
        )
    if found["catkin_package"].line > found["add_executable"].line:
        return (
            "The command catkin_package is in the wrong line. Move catkin_package() above "
            "add_executable, because catkin_package() sets the folder for programs."
        )
    return "The program has the wrong name. The first word in add_executable has to be box_server."
