"""11.1: CMakeLists.txt of a package with a program in C++, repaired, and built with a sound program."""

from __future__ import annotations

import re
from dataclasses import replace

from course_pkg.building import Fault, explain
from course_pkg.building.cmake import commands
from course_pkg.errors import ExamError
from course_pkg.examiner import Exam, part
from course_pkg.examiner.checks.chapter_11.programs import LIMITS, PACKAGE, require_tools
from course_pkg.examiner.outcome import Finished

FILE = f"{PACKAGE}/CMakeLists.txt"
BUILDING = 75.0  # s for all of it; it takes 4 on a machine at rest
NO_ROSCPP = (
    "catkin_LIBRARIES has the libraries of those packages that find_package(catkin … COMPONENTS …) names, "
    "and roscpp is not among them."
)
RULE = "catkin_make builds the package"

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

int main(int argc, char** argv) {
  ros::init(argc, argv, "sound");
  return course_pkg::geometry::Request().length != 0;
}
"""


@part(
    "11.1",
    points=2,
    goal="Repair CMakeLists.txt: catkin_make builds the program box_server of src/box_server.cpp.",
    needs=[f"file:{FILE}"],
    deadline=90.0,
    start=START,
)
def the_list_file(exam: Exam) -> None:
    """Build a sound program with it, and look where the program lies."""
    require_tools()
    texts = {f"{PACKAGE}/package.xml": MANIFEST, f"{PACKAGE}/src/box_server.cpp": PROGRAM}
    folder = exam.folder(files=[FILE], texts=texts)
    done = folder.command("bash", "-c", f"{LIMITS}; exec catkin_make", within=BUILDING, worded="catkin_make")
    _built(exam, done)
    there = folder.command("test", "-x", "devel/lib/cpp_boxes/box_server")
    exam.hold(
        "rosrun would find the program box_server",
        there.status == 0,
        expected="devel/lib/cpp_boxes/box_server",
        seen="no such program",
        hints=_hint(exam.source(f"file:{FILE}")),
    )


def _built(exam: Exam, done: Finished) -> None:
    if done.status is None:
        raise ExamError(
            f"catkin_make was not done after {BUILDING:g} s: the machine is busy, or something in the file "
            "never ends. Run this cell again."
        )
    if done.status == 0:
        exam.hold(RULE, True)
        return
    printed = f"{done.out}\n{done.err}"
    last = " / ".join([line for line in printed.strip().splitlines() if line.strip()][-3:])
    fault = explain(printed) or Fault("catkin_make failed.", f"The end of what it printed: {last}")
    if not fault.file.endswith("CMakeLists.txt"):  # the program is the check's own, and sound
        fault = replace(fault, file="cpp_boxes/CMakeLists.txt", line=0)
        if _lacks_roscpp(exam.source(f"file:{FILE}")):
            fault = replace(fault, remedy=NO_ROSCPP)
    exam.fail(
        RULE,
        expected="a build that passes",
        seen=f"{fault.place}: {fault.problem}" if fault.place else fault.problem,
        hint=fault.remedy,
    )


def _lacks_roscpp(text: str) -> bool:
    """Say whether the program is linked with what catkin found, and roscpp was not asked for."""
    code = re.sub(r"#[^\n]*", "", text)
    return (
        bool(re.search(r"(?i)target_link_libraries\s*\([^)]*catkin_LIBRARIES", code)) and "roscpp" not in code
    )


def _hint(text: str) -> str:
    found = {command.name: command for command in commands(text) if not command.is_comment}
    if "add_executable" not in found:
        return "No add_executable: nothing is made of src/box_server.cpp."
    if "catkin_package" not in found:
        return "There is no catkin_package, which says where catkin puts its programs. Write it above."
    if found["catkin_package"].line > found["add_executable"].line:
        return "catkin_package says where catkin puts its programs: it stands above add_executable."
    return "The first word in add_executable is the name of the program: box_server."
