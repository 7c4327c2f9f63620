"""package.xml, repaired: catkin takes it, and it says what the package needs."""

from __future__ import annotations

from course_pkg.building.manifest import needed, tags
from course_pkg.examiner import Exam, part
from course_pkg.examiner.checks.chapter_04.lamp import PACKAGE, built

FILE = f"{PACKAGE}/package.xml"

START = f"""%%writefile {FILE}
<?xml version="1.0"?>
<package format="2">
  <name>Lamp Services</name>
  <version>1.0</version>
  <description>A lamp on a robot.</description>
  <maintainer email="you@example.com">You</maintainer>
  <license>MIT</license>

  <build_depend>message_generation</build_depend>
  <run_depend>message_runtime</run_depend>
  <run_depend>rospy</run_depend>
</package>
"""


@part(
    "04.3",
    points=2,
    goal="Repair package.xml: catkin takes it, and it names what the package needs.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
)
def the_manifest(exam: Exam) -> None:
    """Build with it, and everything else the check's own; then look at what a build does not notice."""
    built(exam, given=[FILE])
    text = exam.source(f"file:{FILE}")
    for purpose, packages, tag in (
        ("built", ("message_generation", "std_msgs"), "build_depend"),
        ("run", ("message_runtime", "std_msgs"), "exec_depend"),
    ):
        named = needed(text, "build" if purpose == "built" else "run")
        for package in packages:
            exam.hold(
                f"{package} is needed for it to be {purpose}",
                package in named,
                expected=f"<{tag}>{package}</{tag}>",
                seen=", ".join(sorted(named)) or "nothing",
                hints=_hint(text, package, tag),
            )


def _hint(text: str, package: str, tag: str) -> str:
    elsewhere = [each for each in tags(text) if each.text == package]
    if elsewhere:
        return f"Line {elsewhere[0].line} names it by {elsewhere[0].name}. Add {_an(tag)} for it."
    if package == "std_msgs":
        return f"Lamp.srv uses std_msgs/ColorRGBA, so std_msgs has to be there: add {_an(tag)} for it."
    near = [each for each in tags(text) if each.text.startswith(package.partition("_")[0])]
    where = f"Line {near[0].line} names {near[0].text}. " if near else ""
    return f"{where}A .srv file becomes classes by message_generation, and those need message_runtime."


def _an(tag: str) -> str:
    return f"an {tag}" if tag[0] in "aeiou" else f"a {tag}"
