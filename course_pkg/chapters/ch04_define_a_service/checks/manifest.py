"""The repaired package.xml: catkin must accept it, and it must contain the package's dependencies."""

from __future__ import annotations

from course_pkg.chapters.ch04_define_a_service.checks.lamp import PACKAGE, built
from course_pkg.checking import CheckContext, part
from course_pkg.workspace.fault import dependencies, manifest_tags

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
ACCEPTED = "Write a package.xml that catkin accepts."
LISTED = {
    "built": "List the packages that the build needs.",
    "run": "List the packages that the program needs when it runs.",
}


@part(
    "04.3",
    points=2,
    goal=(
        "Repair package.xml, so that catkin accepts the file. List all packages that the build and the "
        "program need."
    ),
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
    goals=[ACCEPTED, *LISTED.values()],
)
def the_manifest(context: CheckContext) -> None:
    """Build a package from the student's package.xml and the check's other files.

    Then check that package.xml lists all packages that the build and the program need.
    """
    built(context, given=[FILE])
    context.fulfilled(ACCEPTED)
    text = context.source(f"file:{FILE}")
    for purpose, packages, tag in (
        ("built", ("message_generation", "std_msgs"), "build_depend"),
        ("run", ("message_runtime", "rospy", "std_msgs"), "exec_depend"),
    ):
        named = dependencies(text, "build" if purpose == "built" else "run")
        for package in packages:
            context.require(
                (
                    f"package.xml lists {package} as a "
                    f"{'build' if purpose == 'built' else 'run-time'} dependency"
                ),
                holds=package in named,
                expected=f"<{tag}>{package}</{tag}>",
                actual=", ".join(sorted(named)) or "nothing",
                hints=_hint(text, package, tag),
            )
        context.fulfilled(LISTED[purpose])


def _hint(text: str, package: str, tag: str) -> str:
    elsewhere = [each for each in manifest_tags(text) if each.text == package]
    if elsewhere:
        return (
            f"The tag {elsewhere[0].name} in line {elsewhere[0].line} is not enough for {package}. "
            f"Also add {_an(tag)} tag for {package}."
        )
    if package == "rospy":
        return (
            "package.xml does not list rospy, which lamp_server.py imports. Add "
            "<exec_depend>rospy</exec_depend>."
        )
    return (
        "message_generation generates classes from a .srv file, and these classes need "
        "message_runtime. List the package message_runtime, too."
    )


def _an(tag: str) -> str:
    return f"an {tag}" if tag[0] in "aeiou" else f"a {tag}"
