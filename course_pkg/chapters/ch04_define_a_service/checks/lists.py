"""The repaired CMakeLists.txt: the build must succeed, and Python must be able to import the type."""

from __future__ import annotations

from course_pkg.chapters.ch04_define_a_service.checks.lamp import PACKAGE, built, lamp_class, md5_in
from course_pkg.checking import CheckContext, part
from course_pkg.checking.commands.folder import telling_line
from course_pkg.workspace.cmake_messages import cmake_commands

FILE = f"{PACKAGE}/CMakeLists.txt"
# This program reads the file that find_package reads in another package. catkin_package generates this file,
# which sets the variable. The program replaces the commands that `cmake -P` does not have. It does not search
# for other packages, because they are not the student's work.
FIND = """\
function(add_custom_target)
endfunction()
function(find_package)
endfunction()
set(CMAKE_FIND_LIBRARY_PREFIXES lib)
set(CMAKE_FIND_LIBRARY_SUFFIXES .so .a)
set(lamp_services_DIR "${CMAKE_SOURCE_DIR}/devel/share/lamp_services/cmake")
include(${lamp_services_DIR}/lamp_servicesConfig.cmake)
if(NOT lamp_services_FOUND_CATKIN_PROJECT)
  message(FATAL_ERROR "not a catkin package")
endif()
"""
FIND_IT = 'printf %s "$1" > find.cmake && cmake -P find.cmake'
NO_LIBRARY = "tried to find library"  # The file that catkin_package generates prints this text.

START = f"""%%writefile {FILE}
cmake_minimum_required(VERSION 3.10)
project(lamp_services)

find_package(catkin REQUIRED COMPONENTS std_msgs)

catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

add_service_files(FILES lamp.srv)
# generate_messages()
"""
GENERATED = "Make the build succeed, and generate the type Lamp."


@part(
    "04.4",
    points=2,
    goal="Repair CMakeLists.txt, so that the build succeeds and Python can import the type Lamp.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
    goals={GENERATED: 3, "Make sure that other packages can find this package.": 1},
)
def the_list_file(context: CheckContext) -> None:
    """Build the package with the student's file and the check's other files; then import the type."""
    folder = built(context, given=[FILE])
    text = context.source(f"file:{FILE}")
    md5, printed = md5_in(context, folder)
    context.require(
        "Python finds the type Lamp in lamp_services.srv",
        holds=bool(md5),
        expected="from lamp_services.srv import Lamp",
        actual=printed.strip().rpartition("\n")[2],
        hints=_why_no_type(text),
    )
    context.require(
        "the generated type is the type that Lamp.srv defines",
        holds=md5 == lamp_class()._md5sum,
        expected=lamp_class()._md5sum,
        actual=md5,
    )
    context.fulfilled(GENERATED)
    found = folder.command("bash", "-c", FIND_IT, "bash", FIND, worded="find_package(lamp_services)")
    context.require(
        "other packages can find this package",
        holds=found.status == 0,
        expected="a file for other packages, which catkin_package generates",
        actual=telling_line(found.out + found.err),
        hints=(
            "catkin_package lists a library that this package does not build, so find_package fails in other "
            "packages. Remove LIBRARIES from catkin_package."
        )
        if NO_LIBRARY in found.out + found.err
        else _about(text, "catkin_package", "Without this command, other packages cannot find this package."),
    )


def _why_no_type(text: str) -> str:
    for name in ("generate_messages", "add_service_files"):
        if not any(each.name == name and not each.is_comment for each in cmake_commands(text)):
            return _about(text, name, "Without this command, the build generates no type.")
    return (
        "The file contains add_service_files and generate_messages, but they generated no "
        "type. Look for a comment between #[[ and ]], and for an if() with a false condition."
    )


def _about(text: str, name: str, reason: str) -> str:
    """Return a hint that the command `name` is missing, or occurs only in a comment."""
    for each in cmake_commands(text):
        if each.name == name and each.is_comment:
            return f"In line {each.line}, {name} is only a comment. Remove the #. {reason}"
    return f"The command {name} is missing. {reason}"
