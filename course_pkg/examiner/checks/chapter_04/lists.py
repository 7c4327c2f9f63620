"""CMakeLists.txt, repaired: the build passes, and the type is really there."""

from __future__ import annotations

from course_pkg.building.cmake import commands
from course_pkg.examiner import Exam, part
from course_pkg.examiner.checks.chapter_04.lamp import PACKAGE, built, lamp_class, md5_in

FILE = f"{PACKAGE}/CMakeLists.txt"
CONFIGURATION = "devel/share/lamp_services/cmake/lamp_servicesConfig.cmake"

START = f"""%%writefile {FILE}
cmake_minimum_required(VERSION 3.10)
project(lamp_services)

find_package(catkin REQUIRED COMPONENTS std_msgs)

catkin_package(CATKIN_DEPENDS message_runtime std_msgs)

add_service_files(FILES lamp.srv)
# generate_messages()
"""


@part(
    "04.4",
    points=2,
    goal="Repair CMakeLists.txt: the build passes, and Python finds the type.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
)
def the_list_file(exam: Exam) -> None:
    """Build with it, and everything else the check's own; then import the type, as a program would."""
    folder = built(exam, given=[FILE])
    text = exam.source(f"file:{FILE}")
    md5, printed = md5_in(folder)
    exam.hold(
        "Python finds the type Lamp in lamp_services.srv",
        bool(md5),
        expected="from lamp_services.srv import Lamp",
        seen=printed.strip().rpartition("\n")[2],
        hints=_why_no_type(text),
    )
    exam.hold(
        "it is the type of Lamp.srv",
        md5 == lamp_class()._md5sum,
        expected=lamp_class()._md5sum,
        seen=md5,
        hints="The type comes from another text: name Lamp.srv in add_service_files, and nothing else.",
    )
    exam.hold(
        "other packages can find this one",
        folder.command("test", "-f", CONFIGURATION).status == 0,
        expected="what catkin_package writes for them",
        seen="nothing of it",
        hints=_about(text, "catkin_package", "It is what tells other packages that this one is there."),
    )


def _why_no_type(text: str) -> str:
    for name in ("generate_messages", "add_service_files"):
        if not any(each.name == name and not each.is_comment for each in commands(text)):
            return _about(text, name, "The build passes without it, and makes nothing.")
    if not any(each.name == "project" for each in commands(text)):
        return "Write project(lamp_services) near the top."
    return (
        "add_service_files and generate_messages are there, and made nothing. Do they run? What stands "
        "between #[[ and ]] is a comment, and what stands between if() and endif() may be left out."
    )


def _about(text: str, name: str, reason: str) -> str:
    """Say where a command that does not run stands as a comment, or that it is not there."""
    for each in commands(text):
        if each.name == name and each.is_comment:
            return f"Line {each.line}: {name} is only a comment. Take the # away. {reason}"
    return f"There is no {name}. {reason}"
