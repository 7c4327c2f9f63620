"""07.1: the package.xml that catkin_create_pkg wrote and the student completed."""

from __future__ import annotations

from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY
from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.catkin_package import built
from course_pkg.workspace.fault import dependencies, manifest_tags

NAME = "package.xml"
FILE = MY_GEOMETRY.path(NAME)
GENERATED = {  # For each XML tag, this dict contains the text that catkin_create_pkg generates, and a hint.
    "description": ("The my_geometry package", "Describe in one sentence what the package does."),
    "license": ("TODO", "Write the name of a licence, for example MIT or BSD."),
}
NEEDS = (
    ("build", "build_depend", ("message_generation", "rospy", "std_msgs")),
    ("run", "exec_depend", ("message_runtime", "rospy", "std_msgs")),
)

START = f"""%%writefile {FILE}
<?xml version="1.0"?>
<package format="2">
  <name>my_geometry</name>
  <version>0.0.0</version>
  <description>The my_geometry package</description>
  <maintainer email="you@todo.todo">you</maintainer>
  <license>TODO</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <build_depend>rospy</build_depend>
  <build_depend>std_msgs</build_depend>
  <build_export_depend>rospy</build_export_depend>
  <build_export_depend>std_msgs</build_export_depend>
  <exec_depend>rospy</exec_depend>
  <exec_depend>std_msgs</exec_depend>
</package>
"""
COMPLETE = "Write a package.xml that catkin accepts. List all packages that your package needs."


@part(
    "07.1",
    points=2,
    goal=(
        "Complete package.xml. Write your own description, address and licence, and add an "
        "exec_depend for message_runtime."
    ),
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
    goals={COMPLETE: 3, "Write your own description, address and licence.": 1},
)
def the_manifest(context: CheckContext) -> None:
    """Check that package.xml lists the required packages, and that the package can be built.

    Then check that the description, the address and the licence are the student's own.
    """
    text = context.source(f"file:{FILE}")
    # If catkin cannot read the file, the build below reports the reason.
    for purpose, tag, packages in NEEDS if _texts(text) else ():
        named = dependencies(text, purpose)
        kind = "build" if purpose == "build" else "run-time"
        for package in packages:
            context.require(
                f"package.xml lists {package} as a {kind} dependency",
                holds=package in named,
                expected=f"{tag} for {package}",
                actual=", ".join(sorted(named)) or "no dependency",
                hints=_about_dependency(text, package, tag),
            )
    built(context, MY_GEOMETRY, examined=NAME, alone=True)
    context.fulfilled(COMPLETE)
    texts = _texts(text)
    for name, (generated, hint) in GENERATED.items():
        found = " ".join(texts[name].split())
        context.require(
            f"the {name} is not the generated text",
            holds=found not in ("", generated),
            expected="a text that you wrote",
            actual=found or "no text",
            hints=hint,
        )
    context.require(
        "the address of the maintainer is not the generated address",
        holds="@todo.todo" not in texts["maintainer"],
        expected="an address that does not end with @todo.todo",
        actual=texts["maintainer"],
        hints=(
            "The address in the maintainer tag still ends with @todo.todo. Write your own address, or "
            "you@example.com."
        ),
    )


def _texts(text: str) -> dict[str, str]:
    """Return the description, licences and addresses as catkin reads them, or {} if catkin cannot read them.

    catkin's own parser reads the file, so the result is right for every notation of XML.
    """
    # The import takes 50 ms, so it is inside the function.
    from catkin_pkg.package import InvalidPackage, parse_package_string

    try:
        package = parse_package_string(text)
    except InvalidPackage:
        return {}
    return {
        "description": package.description,
        "license": " ".join(map(str, package.licenses)),
        "maintainer": " ".join(each.email for each in package.maintainers),
    }


def _about_dependency(text: str, package: str, tag: str) -> str:
    elsewhere = [each for each in manifest_tags(text) if each.text == package]
    if "condition" in text and any(each.name in (tag, "depend") for each in elsewhere):
        return (
            f"The tag for {package} has the attribute `condition`, so some versions of ROS ignore this tag. "
            "Remove the condition."
        )
    if elsewhere:
        return (
            f"The tag {elsewhere[0].name} in line {elsewhere[0].line} is not enough for {package}. "
            f"Also add a line with {tag} for {package}."
        )
    if package == "message_runtime":
        return "The name of a package is missing. Look for this name in the warning of catkin_create_pkg."
    return f"The package uses {package}, but package.xml has no tag for {package}. Add this tag."
