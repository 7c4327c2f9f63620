"""The complete package of chapter 04's exercises, and functions that build it with the student's files."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import replace

from course_pkg.checking import CheckContext
from course_pkg.checking.commands.folder import Folder
from course_pkg.checking.plain_values import ServiceClass
from course_pkg.checking.shared.catkin_package import run_catkin_make
from course_pkg.types import compile_service
from course_pkg.workspace import Fault, explain
from course_pkg.workspace.fault import locate

PACKAGE = "src/lamp_services"
TYPE = "lamp_services/Lamp"
# For each build step, -t limits the CPU time in s, and -f limits the size of a file in KiB. A step needs
# about 1 s of CPU time.
LIMITS = "ulimit -t 6 -f 100000"
# The whole build may take up to this time in s; a build takes 1.5 s on an idle machine and 20 s on a very
# busy machine.
BUILD = 40.0

# catkin prints this problem if catkin_package names a package that package.xml does not name.
LISTED = re.compile(r"catkin_package lists (\w+), but package\.xml")

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
  <build_depend>rospy</build_depend>
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
    # A student's CMakeLists.txt can install this file, so the file must exist.
    f"{PACKAGE}/scripts/lamp_server.py": "#!/usr/bin/env python3\n",
}


def lamp_class() -> ServiceClass:
    """Return the class of the service type that the exercise describes."""
    return compile_service(TYPE, DEFINITION).cls


def built(context: CheckContext, *, given: Sequence[str]) -> Folder:
    """Build a workspace with files of the student.

    `given` are the paths of the student's files or folders in the workspace. The check supplies all other
    files.
    """
    texts = {path: text for path, text in SOUND.items() if not path.startswith(tuple(given))}
    folder = context.folder(files=given, texts=texts)
    build = run_catkin_make(folder, f"{LIMITS};", within=BUILD)
    printed = f"{build.out}\n{build.err}"
    if build.status != 0:
        _fails_to_build(context, _in_their_file(context, explain(printed) or _unexplained(printed), given))
    context.require("catkin_make builds the package", holds=True)
    return folder


def md5_in(context: CheckContext, folder: Folder) -> tuple[str, str]:
    """Return the MD5 sum of the type that was built in this folder, and the output of a failed import.

    If the import succeeds, the output is ""; if the import fails, the MD5 sum is "". The type must also
    serialise a random request, so that an object that has only the right MD5 sum is not enough.
    """
    line = "from lamp_services.srv import Lamp; print(Lamp._md5sum)"
    mode, *seconds = context.random.integers(4, 3, 255)
    sends = f"Lamp._request_class(mode={mode}, seconds={seconds}).serialize(b); print(b.getvalue().hex())"
    done = folder.command(
        "bash",
        "-c",
        f". devel/setup.bash && python3 -c 'import io; b = io.BytesIO(); {line}; {sends}'",
        within=10.0,
        worded=f"python3 -c '{line}'",
    )
    body = io.BytesIO()
    lamp_class()._request_class(mode=mode, seconds=seconds).serialize(body)
    md5, _, sent = done.out.strip().partition("\n")
    return (md5, "") if done.status == 0 and sent == body.getvalue().hex() else ("", done.out + done.err)


def _in_their_file(context: CheckContext, fault: Fault, given: Sequence[str]) -> Fault:
    """Return a copy of `fault` in which the faulty file is the student's file.

    The check's own files are correct, so the mistake is in the student's file.
    """
    theirs = given[0].removeprefix("src/")
    if theirs.endswith("package.xml") and (listed := LISTED.search(fault.problem)):
        fault = replace(fault, remedy=f"Add <exec_depend>{listed[1]}</exec_depend> to package.xml.")
    if fault.file != theirs:
        fault = replace(fault, file=theirs, line=0)
    return locate(fault, context.source(f"file:{given[0]}")) if theirs.endswith("package.xml") else fault


def _fails_to_build(context: CheckContext, fault: Fault) -> None:
    context.fail(
        "catkin_make builds the package",
        expected="a successful build",
        actual=f"{fault.place}: {fault.problem}" if fault.place else fault.problem,
        hint=fault.remedy,
    )


def _unexplained(printed: str) -> Fault:
    lines = [line for line in printed.strip().splitlines() if line.strip()]
    return Fault(
        "catkin_make failed", f"Read the end of the output of catkin_make: {' / '.join(lines[-3:])}."
    )
