"""07.3: the CMakeLists.txt, which must generate a type before programs use it."""

from __future__ import annotations

import re
import shlex

from course_pkg.chapters.ch07_build_a_package.checks.packages import GEOMETRY, MY_GEOMETRY
from course_pkg.checking import CheckContext, part
from course_pkg.checking.plain_values import Message
from course_pkg.checking.shared.catkin_package import BuiltPackage, built
from course_pkg.types import compile_service
from course_pkg.workspace.cmake_messages import cmake_commands

NAME = "CMakeLists.txt"
FILE = MY_GEOMETRY.path(NAME)
TARGET = "my_geometry_programs"
DEPENDS = ("message_runtime", "rospy", "std_msgs")
CLASSES = "devel/lib/python3*/*-packages/my_geometry"
CONFIGURATION = "devel/share/my_geometry/cmake/my_geometryConfig.cmake"

START = f"""%%writefile {FILE}
cmake_minimum_required(VERSION 3.0.2)
project(my_geometry)

find_package(catkin REQUIRED COMPONENTS
  message_generation
  rospy
  std_msgs
)

catkin_package()
"""
GENERATED = "Generate the type my_geometry/geometry."
WAITS = "Make sure that the target my_geometry_programs depends on the generated type."


@part(
    "07.3",
    points=3,
    goal=(
        "Complete CMakeLists.txt. The build has to generate the type my_geometry/geometry before it "
        "builds the target my_geometry_programs. Declare message_runtime, rospy and std_msgs as "
        "dependencies of every package that uses this package."
    ),
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
    goals=[
        GENERATED,
        WAITS,
        "Declare the run-time dependencies of every package that uses this package.",
    ],
)
def the_build(context: CheckContext) -> None:
    """Build the package; then remove the generated classes, and build only the student's target."""
    text = context.source(f"file:{FILE}")
    # One field has a random name, so the student's CMakeLists.txt cannot contain the right MD5 sum.
    definition = f"float32 {context.random.word()}\n{GEOMETRY}"
    package = built(context, MY_GEOMETRY, examined=NAME, drawn={"srv/geometry.srv": definition})
    kind = compile_service("my_geometry/geometry", definition)
    md5, request = kind.md5, kind.cls._request_class(*context.random.numbers(4, 0.5, 9.0))
    _has_type(context, package, text, md5, request)
    context.fulfilled(GENERATED)
    _target_waits(context, package, text)
    context.fulfilled(WAITS)
    _tells_other_packages(context, package, text)


def _has_type(context: CheckContext, package: BuiltPackage, text: str, wanted: str, request: Message) -> None:
    md5, printed = package.md5("geometry", request)
    context.require(
        "Python finds the type my_geometry/geometry",
        holds=bool(md5),
        expected="from my_geometry.srv import geometry",
        actual=printed.rpartition("\n")[2],
        hints=_why_no_type(text),
    )
    context.require(
        "the MD5 sum of the type is equal to the MD5 sum of geometry.srv",
        holds=md5 == wanted,
        expected="the MD5 sum of the definition in geometry.srv",
        actual="a different MD5 sum",
    )


def _why_no_type(text: str) -> str:
    for name in ("add_service_files", "generate_messages"):
        if not _has(text, name):
            return f"The command {name} is missing, so the build generates no type. Add this command."
    return (
        "The file contains add_service_files and generate_messages, but no type was generated. "
        "Look for an if() with a false condition."
    )


def _target_waits(context: CheckContext, package: BuiltPackage, text: str) -> None:
    """Build only the target while the classes are missing; the build must generate the classes.

    The definition has changed since the first build, so that copies of the first classes are wrong.
    """
    definition = f"float32 {context.random.word()}\n{GEOMETRY}"
    wanted = compile_service("my_geometry/geometry", definition).md5
    changed = f"printf %s {shlex.quote(definition)} > {MY_GEOMETRY.path('srv/geometry.srv')}"
    line = f"rm -rf {CLASSES} && {changed} && make -C build {TARGET}"
    done = package.folder.command("bash", "-c", line, within=20.0, worded=f"make {TARGET}")
    unknown = "No rule to make target" in done.out + done.err
    context.require(
        f"the classes are generated before {TARGET} is built",
        holds=done.status == 0 and package.md5("geometry")[0] == wanted,
        expected=f"make {TARGET} generates the classes first",
        actual="there is no such target" if unknown else "no classes",
        hints=_why_not_waiting(text, unknown=unknown),
    )


def _why_not_waiting(text: str, *, unknown: bool) -> str:
    if unknown and _has(text, "add_custom_target"):
        return (
            "The name of the target is wrong. Use my_geometry_programs, because "
            "${PROJECT_NAME} is the name of the package."
        )
    if unknown:
        return (
            "The target does not exist. Create the target with add_custom_target: write the "
            "name of the target first, and then ALL."
        )
    if _comes_before(text, "add_dependencies", "generate_messages"):
        return (
            "When CMake reads add_dependencies, the list of this package's targets is still empty. Write "
            "add_custom_target and add_dependencies below generate_messages."
        )
    if _has(text, "add_dependencies"):
        return (
            "Your add_dependencies contains only targets of other packages. Add the targets of "
            "${PROJECT_NAME}, which generate the type."
        )
    return "The target does not depend on the generated classes. Add this dependency with add_dependencies."


def _tells_other_packages(context: CheckContext, package: BuiltPackage, text: str) -> None:
    # catkin_package writes the names after CATKIN_DEPENDS into the line "set(depends …". A later line has no
    # effect on other packages.
    done = package.folder.command("grep", "--max-count=1", "^ *set(depends ", CONFIGURATION)
    missing = [name for name in DEPENDS if name not in re.findall(r"\w+", done.out)]
    context.require(
        f"every package that uses this package also depends on {', '.join(DEPENDS)}",
        holds=not missing,
        expected=f"{', '.join(DEPENDS)} in CATKIN_DEPENDS of catkin_package",
        actual=f"no {', '.join(missing)}",
        hints=f"Your catkin_package does not name {' and '.join(missing)}. Write CATKIN_DEPENDS, and then "
        "the three packages that your package needs at run time."
        if _has(text, "catkin_package")
        else "Without catkin_package, other packages cannot find this package. Add the command "
        "catkin_package.",
    )


def _has(text: str, name: str) -> bool:
    return name in _names(text)


def _comes_before(text: str, first: str, second: str) -> bool:
    names = _names(text)
    return first in names and second in names[names.index(first) :]


def _names(text: str) -> list[str]:
    """Return the names of all commands, in the order of the file; commands in comments are left out."""
    return [each.name for each in cmake_commands(text) if not each.is_comment]
