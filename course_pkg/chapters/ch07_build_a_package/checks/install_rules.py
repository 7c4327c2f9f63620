"""07.6: the install rules. The check moves the folder src away before it starts the installed server."""

from __future__ import annotations

import re

from course_pkg.chapters.ch07_build_a_package.checks.cmake_lists import FILE, NAME
from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY, geometry_class
from course_pkg.chapters.ch07_build_a_package.checks.program import serves
from course_pkg.chapters.ch07_build_a_package.checks.server import SERVER
from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.catkin_package import LIMITS, BuiltPackage, built
from course_pkg.workspace.cmake_messages import cmake_commands

SCRIPTS = ("server.py", "client.py")
EXECUTABLE = 0o100  # Linux tests this bit of a file's mode if the file's owner executes the file.
PLACE = "lib/my_geometry"
INSTALLING = 20.0  # The installation may take up to this time in s; it takes 1 s on an idle machine.
INSTALLED = "Install server.py and client.py in the folder that rosrun searches."


@part(
    "07.6",
    points=2,
    goal=(
        "Extend CMakeLists.txt, so that catkin_make install puts server.py and client.py into "
        "the folder that rosrun searches."
    ),
    needs=[f"file:{FILE}"],
    deadline=120.0,
    goals={INSTALLED: 3, "Install all files that the installed server needs.": 1},
)
def the_install_rules(context: CheckContext) -> None:
    """Install a copy of the package, move its other folders away, and start the installed server."""
    package = built(context, MY_GEOMETRY, examined=NAME)
    _installs(context, package)
    for script in SCRIPTS:
        _is_in_its_place(context, package, script)
    context.fulfilled(INSTALLED)
    package.folder.command("mv", "src", "devel", "build")
    space = f"/{context.random.word()}"
    name = f"{space}{SERVER.service}"
    line = f"rosrun my_geometry {SERVER.name} __ns:={space} {SERVER.service}:={name}"
    installed = "install/setup.bash"
    with package.start(line, worded=f"rosrun my_geometry {SERVER.name}", setup=installed) as running:
        serves(context, running, package, SERVER, name, f"{space}/{SERVER.node}")
        length, width, height = context.random.numbers(3, 0.5, 9.0)
        measure = context.service(name, geometry_class(), timeout=5.0)
        context.expect(
            "the installed server answers",
            expected=length * width * height,
            actual=measure(length=length, width=width, height=height).volume,
            near=1e-3,
        )


def _installs(context: CheckContext, package: BuiltPackage) -> None:
    # catkin_make has already run CMake, so `make install` now does the same as `catkin_make install`. Files
    # in the folder `install` that were copied without an install rule are deleted first.
    line = f"{LIMITS}; rm -rf install; exec make -C build install"
    done = package.folder.command("bash", "-c", line, within=INSTALLING, worded="catkin_make install")
    problem = re.search(r"cannot find\s+\"(?:\S*/src/)?([^\"]*)\"", done.out + done.err)
    context.require(
        "catkin_make install succeeds",
        holds=done.status == 0,
        expected="exit status 0",
        actual=f"there is no {problem[1]}" if problem else f"exit status {done.status}",
        hints=(
            "A path in the install rule is wrong. Compare each path in the rule with the files of "
            "the package."
        ),
    )


def _is_in_its_place(context: CheckContext, package: BuiltPackage, script: str) -> None:
    found = package.folder.command("find", "install", "-name", script, "-printf", "%m %P\\n").out.split()
    modes, places = found[::2], found[1::2]
    there = f"{PLACE}/{script}" in places
    context.require(
        f"{script} is installed in {PLACE}, as an executable file",
        holds=there and int(modes[places.index(f"{PLACE}/{script}")], 8) & EXECUTABLE != 0,
        expected=f"{PLACE}/{script}",
        actual=", ".join(places) + (", a file without the permission to execute it" if there else "")
        or "no such file",
        hints=_why_not_there(context.source(f"file:{FILE}"), script, places, there=there),
    )
    # catkin_install_python can change the first line, so compare only the other lines.
    both = f"<(tail -n +2 {MY_GEOMETRY.path(f'scripts/{script}')}) <(tail -n +2 install/{PLACE}/{script})"
    if package.folder.command("bash", "-c", f"cmp {both}", worded=f"cmp {script}").status != 0:
        context.fail(
            f"{script} is installed in {PLACE}, as an executable file",
            expected=f"the same lines as in scripts/{script}",
            actual="a different file",
            hint=f"The installed file differs from the script in the package. Install scripts/{script}.",
        )


def _why_not_there(text: str, script: str, places: list[str], *, there: bool) -> str:
    rules = [each.name for each in cmake_commands(text) if not each.is_comment]
    if there and "PERMISSIONS" in text:
        return (
            "The installed file is not executable, because the PERMISSIONS in your install rule do not "
            "contain OWNER_EXECUTE. Use catkin_install_python, which sets the right permissions."
        )
    if there:
        rule = "install(DIRECTORY …)" if re.search(r"install\s*\(\s*DIRECTORY", text) else "install(FILES …)"
        return (
            f"The installed file is not executable, because {rule} removes the permission to execute a file. "
            "Use catkin_install_python for scripts."
        )
    if any(place.startswith("share/") for place in places):
        return (
            f"The script is installed in the folder share, but the exercise asks for {PLACE}. Write exactly "
            "${CATKIN_PACKAGE_BIN_DESTINATION} after DESTINATION."
        )
    if places:
        return (
            "rosrun does not search the folder that you chose. Write exactly "
            "${CATKIN_PACKAGE_BIN_DESTINATION} after DESTINATION."
        )
    if "catkin_install_python" not in rules and "install" not in rules:
        return (
            "The install rule is missing. The generated CMakeLists.txt contains an example in a "
            "comment: look for catkin_install_python."
        )
    return f"The install rule does not contain {script}. List both scripts after PROGRAMS."
