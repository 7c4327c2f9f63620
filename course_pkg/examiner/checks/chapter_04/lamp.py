"""The package that the exercises of chapter 04 add up to, as it should be, and how a check builds it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from course_pkg.building import Fault, explain
from course_pkg.building.manifest import placed
from course_pkg.errors import ExamError
from course_pkg.examiner import Exam
from course_pkg.examiner.folder import Folder
from course_pkg.examiner.plain import ServiceClass
from course_pkg.interfaces import compile_service

PACKAGE = "src/lamp_services"
TYPE = "lamp_services/Lamp"
LIMITS = "ulimit -t 6 -f 100000"  # s of a processor and KiB of a file; a step takes 1 s, busy machine or not
BUILD = 40.0  # s for all of it; it takes 1.5 on a machine at rest, and 20 on a very busy one

DEFINITION = """\
uint8 OFF=0
uint8 ON=1
uint8 BLINK=2

uint8 mode
std_msgs/ColorRGBA colour
float32[] seconds
---
bool success
float32[3] rgb
float32 total
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="2">
  <name>lamp_services</name>
  <version>0.1.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>std_msgs</build_depend>
  <exec_depend>message_runtime</exec_depend>
  <exec_depend>rospy</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>
"""
LISTS = """\
cmake_minimum_required(VERSION 3.10)
project(lamp_services)

find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)

add_service_files(FILES Lamp.srv)
generate_messages(DEPENDENCIES std_msgs)

catkin_package(CATKIN_DEPENDS message_runtime std_msgs)
"""
SOUND = {
    f"{PACKAGE}/srv/Lamp.srv": DEFINITION,
    f"{PACKAGE}/package.xml": MANIFEST,
    f"{PACKAGE}/CMakeLists.txt": LISTS,
}


def lamp_class() -> ServiceClass:
    """Return the class of the service type, as the description has it."""
    return compile_service(TYPE, DEFINITION).cls


def built(exam: Exam, *, given: Sequence[str]) -> Folder:
    """Build a workspace that has the student's `given` (files or folders), and for the rest the check's."""
    texts = {path: text for path, text in SOUND.items() if path not in given}
    folder = exam.folder(files=given, texts=texts)
    limited = f"{LIMITS}; exec catkin_make"
    build = folder.command("bash", "-c", limited, within=BUILD, worded="catkin_make")
    if build.status is None:
        raise ExamError(
            f"catkin_make was not done after {BUILD:g} s: the machine is busy, or something in the package "
            "never ends. Run this cell again."
        )
    printed = f"{build.out}\n{build.err}"
    if build.status != 0:
        _fails_to_build(exam, _in_their_file(exam, explain(printed) or _unexplained(printed), given))
    exam.hold("catkin_make builds the package", True)
    return folder


def in_sourced(folder: Folder, line: str, within: float = 10.0) -> tuple[int | None, str]:
    """Return status and output of a line of bash in a shell that has sourced the folder's workspace."""
    sourced = f". devel/setup.bash && {line}"
    done = folder.command("bash", "-c", sourced, within=within, worded=line)
    return done.status, done.out + done.err


def md5_in(folder: Folder) -> tuple[str, str]:
    """Return the MD5 of the type that Python finds there, and what is printed where it finds none."""
    line = "python3 -c 'from lamp_services.srv import Lamp; print(Lamp._md5sum)'"
    status, printed = in_sourced(folder, line)
    return (printed.strip(), "") if status == 0 else ("", printed)


def _in_their_file(exam: Exam, fault: Fault, given: Sequence[str]) -> Fault:
    """Return the fault as one of the file that is examined: all others are the check's own, and sound."""
    theirs = given[0].removeprefix("src/")
    if fault.file != theirs:
        fault = replace(fault, file=theirs, line=0)
    return placed(fault, exam.source(f"file:{given[0]}")) if theirs.endswith("package.xml") else fault


def _fails_to_build(exam: Exam, fault: Fault) -> None:
    exam.fail(
        "catkin_make builds the package",
        expected="a build that passes",
        seen=f"{fault.place}: {fault.problem}" if fault.place else fault.problem,
        hint=fault.remedy,
    )


def _unexplained(printed: str) -> Fault:
    if "-- Configuring" not in printed:
        return Fault("CMake did not come to an end.", "Look for a loop that has no way out.")
    lines = [line for line in printed.strip().splitlines() if line.strip()]
    return Fault("catkin_make failed.", f"The end of what it printed: {' / '.join(lines[-3:])}")
