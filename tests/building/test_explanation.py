"""What the tools of ROS really print is recognised, with the line, and with what to do about it.

Each case is a package with one slip, built by the real catkin_make; all share one workspace, so that CMake
looks for the compilers once.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from course_pkg.building import explain
from tests.building.packages import BOX, GOOD, LISTS, MANIFEST, build, shell, spoilt, write

LIST_FILE = "my_services/CMakeLists.txt"
FIND = "find_package(catkin REQUIRED COMPONENTS message_generation)\n"
ADD = "add_service_files(FILES Box.srv)\n"
GENERATE = "generate_messages()\n"
PACKAGE = "catkin_package(CATKIN_DEPENDS message_runtime)\n"
C, S, X = "CMakeLists.txt", "srv/Box.srv", "package.xml"

# The files, the place that has to be named, and words of the problem or the remedy.
SLIPS = {
    "message_generation missing": (
        spoilt(C, (" COMPONENTS message_generation", "")),
        f"{LIST_FILE}, line 6",
        "message_generation brings it",
    ),
    "find_package too late": (
        spoilt(C, (FIND, ""), (ADD, ADD + FIND)),
        f"{LIST_FILE}, line 5",
        "above this line",
    ),
    "generated before the files are named": (
        spoilt(C, (ADD, ""), (GENERATE, GENERATE + ADD)),
        f"{LIST_FILE}, line 7",
        "Move this line above generate_messages",
    ),
    "generated after catkin_package": (
        spoilt(C, (GENERATE, ""), (PACKAGE, PACKAGE + GENERATE)),
        f"{LIST_FILE}, line 9",
        "Move generate_messages above catkin_package",
    ),
    "a program of no file": (
        spoilt(C, (PACKAGE, PACKAGE + "add_executable(box src/none.cpp)\n")),
        f"{LIST_FILE}, line 10",
        "There is no file src/none.cpp",
    ),
    "linked before it is made": (
        spoilt(C, (PACKAGE, PACKAGE + "target_link_libraries(box ros)\n")),
        f"{LIST_FILE}, line 10",
        "There is no program box above this line",
    ),
    "generated twice": (
        spoilt(C, (GENERATE, GENERATE * 2)),
        f"{LIST_FILE}, line 8",
        "stands there twice",
    ),
    "no file named": (spoilt(C, (ADD, "")), f"{LIST_FILE}, line 6", "Write add_service_files"),
    "wrong file name": (
        spoilt(C, ("Box.srv", "Bocks.srv")),
        f"{LIST_FILE}, line 6",
        "There is no file Bocks.srv",
    ),
    "wrong case in the file name": (
        spoilt(C, ("Box.srv", "box.srv")),
        f"{LIST_FILE}, line 6",
        "upper and lower case",
    ),
    "the folder in the file name": (
        spoilt(C, ("Box.srv", "srv/Box.srv")),
        f"{LIST_FILE}, line 6",
        "the folder srv is not part of it",
    ),
    "FILES left out": (spoilt(C, ("FILES ", "")), f"{LIST_FILE}, line 6", "Write FILES"),
    "messages for services": (
        spoilt(C, ("add_service_files", "add_message_files")),
        f"{LIST_FILE}, line 6",
        "add_service_files",
    ),
    "a command misspelt": (
        spoilt(C, ("generate_messages", "generate_message")),
        f"{LIST_FILE}, line 7",
        "Write generate_messages.",
    ),
    "a package misspelt": (
        spoilt(C, ("message_generation", "message_generaton")),
        f"{LIST_FILE}, line 4",
        "asks for message_generaton",
    ),
    "a bracket missing": (
        spoilt(C, (GENERATE, "generate_messages(\n")),
        f"{LIST_FILE}, line 7",
        "Write the missing )",
    ),
    "a bracket too many": (
        spoilt(C, (GENERATE, "generate_messages())\n")),
        f"{LIST_FILE}, line 7",
        "where a command belongs",
    ),
    "still as handed out": (
        {**GOOD, C: "...\n"},
        f"{LIST_FILE}, line 1",
        "it meets ... where a command belongs",
    ),
    "no project": (
        spoilt(C, ("project(my_services)\n", "")),
        f"{LIST_FILE}, line 8",
        "Write project(NAME)",
    ),
    "another name in project": (
        spoilt(C, ("project(my_services)", "project(my_service)")),
        f"{LIST_FILE}, line 9",
        "package.xml has the name my_services, and CMakeLists.txt has my_service.",
    ),
    "needed to run, and not said": (
        spoilt(X, ("  <exec_depend>message_runtime</exec_depend>\n", "")),
        f"{LIST_FILE}, line 9",
        "<exec_depend>message_runtime</exec_depend>",
    ),
    "needed to build, and not said": (
        {
            **spoilt(
                C,
                ("COMPONENTS message_generation", "COMPONENTS message_generation std_msgs"),
                ("CATKIN_DEPENDS message_runtime", "CATKIN_DEPENDS std_msgs"),
            ),
            X: MANIFEST.replace("message_runtime", "std_msgs"),
        },
        f"{LIST_FILE}, line 9",
        "<build_depend>std_msgs</build_depend>",
    ),
    "catkin not named": (
        spoilt(X, ("  <buildtool_depend>catkin</buildtool_depend>\n", "")),
        f"{LIST_FILE}, line 9",
        "<buildtool_depend>catkin</buildtool_depend>",
    ),
    "another package's message": (
        spoilt(S, ("float32 length", "std_msgs/Header header")),
        f"{LIST_FILE}, line 7",
        "generate_messages(DEPENDENCIES std_msgs)",
    ),
    "depends on what was not found": (
        spoilt(C, ("generate_messages()", "generate_messages(DEPENDENCIES std_msgs)")),
        f"{LIST_FILE}, line 7",
        "Add std_msgs to the COMPONENTS",
    ),
    "no such type": (
        spoilt(S, ("float32 length", "float length")),
        "my_services/srv/Box.srv",
        "float is no type that ROS has built in",
    ),
    "dashes with blanks": (spoilt(S, ("---", "- - -")), "", "has the line - - - where three dashes belong"),
    "two dashes": (spoilt(S, ("---", "--")), "", "Write --- and nothing else"),
    "a tab": (spoilt(S, ("float32 length", "float32\tlength")), "", "one blank between"),
    "a semicolon": (spoilt(S, ("length", "length;")), "", "length; is not a legal"),
    "a name twice": (spoilt(S, ("width", "length")), "", "Duplicate field names"),
    "a mark of Windows in the .srv": ({**GOOD, S: "\ufeff" + BOX}, "", "is not a legal message field type"),
    "a tag not closed": (spoilt(X, ("</name>", "")), "my_services/package.xml, line 12", "Close every"),
    "a line above the XML": (
        {**GOOD, X: "\n" + GOOD[X]},
        "my_services/package.xml, line 2",
        "in the first column of the first line",
    ),
    "a tag of format 1": (
        spoilt(X, ("exec_depend", "run_depend")),
        "my_services/package.xml",
        "Format 2 has no tag run_depend",
    ),
    "no version": (
        spoilt(X, ("  <version>0.1.0</version>\n", "")),
        "my_services/package.xml",
        "The tag version is missing",
    ),
    "named twice": (
        spoilt(
            X, ("<build_depend>message_gen", "<depend>message_runtime</depend>\n  <build_depend>message_gen")
        ),
        "my_services/package.xml",
        "Keep depend",
    ),
    "half a version": (spoilt(X, ("0.1.0", "0.1")), "my_services/package.xml", "as in 0.1.0"),
    "nobody maintains it": (
        spoilt(X, ('  <maintainer email="me@example.com">Me</maintainer>\n', "")),
        "my_services/package.xml",
        "Nobody is named",
    ),
    "no address": (spoilt(X, (' email="me@example.com"', "")), "package.xml", "lacks its email"),
    "half an address": (spoilt(X, ("me@example.com", "me")), "my_services/package.xml", "a whole address"),
    "a dash in the name": (
        {**spoilt(X, ("my_services", "my-services")), C: LISTS.replace("my_services", "my-services")},
        "package.xml",
        "cannot be the name of a package",
    ),
}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A workspace whose name is so long that CMake breaks its messages in another place each time."""
    return tmp_path_factory.mktemp("workspace-with-a-long-name")


@pytest.mark.parametrize(("files", "place", "words"), SLIPS.values(), ids=SLIPS)
def test_a_slip_is_named(workspace: Path, files: dict[str, str], place: str, words: str) -> None:
    """Where it is, what it is, and what to do."""
    write(workspace, files)
    _, printed = build(workspace)
    fault = explain(printed)
    assert fault is not None, printed
    assert fault.place == place
    assert words in str(fault)


@pytest.mark.parametrize(
    "files",
    [
        GOOD,
        {name: text.replace("\n", "\r\n") for name, text in GOOD.items()},
        {**GOOD, C: "\ufeff" + LISTS},
        {**GOOD, C: LISTS.replace("cmake_minimum_required(VERSION 3.10)\n", "")},
    ],
    ids=["good", "lines of Windows", "a mark of Windows", "no minimum"],
)
def test_what_builds_is_not_found_fault_with(workspace: Path, files: dict[str, str]) -> None:
    """No fault is seen in a build that passes, and has the types in it."""
    write(workspace, files)
    status, printed = build(workspace)
    assert (status, explain(printed)) == (0, None)
    assert shell(workspace, "python3 -c 'from my_services.srv import Box'") == ""


def test_another_python_is_recognised(tmp_path: Path) -> None:
    """A Python without ROS, first on PATH, and the folder build that remembers it."""
    subprocess.run(["python3", "-m", "venv", "--without-pip", tmp_path / "other"], check=True)
    write(tmp_path, GOOD)
    for path in (str(tmp_path / "other" / "bin"), ""):
        fault = explain(build(tmp_path, path=path)[1])
        assert fault is not None
        assert "-DPYTHON_EXECUTABLE" in fault.remedy
    assert build(tmp_path, "-DPYTHON_EXECUTABLE=/usr/bin/python3")[0] == 0


# What is printed after the build; the second of each pair is in the remedy.
SAID = {
    "not sourced: Python": ("python3 -c 'import my_services.srv'", False, "Source devel/setup.bash"),
    "not sourced: rospack": ("rospack find my_services", False, "Source devel/setup.bash"),
    "not sourced: rossrv": ("rossrv show my_services/Box", False, "Source devel/setup.bash"),
    "wrong case": ("python3 -c 'from my_services.srv import box'", True, "upper and lower case differ"),
    "no run bit": ("rosrun my_services plain.py", True, "chmod +x"),
    "no shebang": ("rosrun my_services shell.py", True, "#!/usr/bin/env python3"),
    "lines of Windows": ("rosrun my_services windows.py", True, "line ends of Linux"),
    "roslaunch for rosrun": ("roslaunch course_pkg server", True, "by rosrun"),
    "roslaunch of a script": ("roslaunch my_services plain.py", True, "by rosrun"),
    "rosservice show": ("rosservice show /box", True, "rossrv show"),
}


@pytest.mark.parametrize(("line", "sourced", "words"), SAID.values(), ids=SAID)
def test_what_the_other_tools_say_is_recognised(
    workspace: Path, line: str, sourced: bool, words: str
) -> None:
    """The rest of the slips on the way from a definition to a program."""
    scripts = {"plain": 'print("hello")\n', "shell": 'print("hello")\n'}
    scripts["windows"] = "#!/usr/bin/env python3\r\nprint(1)\r\n"
    write(workspace, {**GOOD, **{f"scripts/{name}.py": text for name, text in scripts.items()}})
    for name in ("shell", "windows"):
        (workspace / "src" / "my_services" / "scripts" / f"{name}.py").chmod(0o755)
    if not (workspace / "devel" / "lib").exists():
        build(workspace)
    fault = explain(shell(workspace, line, sourced=sourced))
    assert fault is not None
    assert words in fault.remedy


def test_types_that_were_not_generated_are_told_from_a_package_that_is_not_there(tmp_path: Path) -> None:
    """generate_messages left out: the build passes, and Python finds no types."""
    write(tmp_path, spoilt(C, (GENERATE, f"# {GENERATE}")))
    status, printed = build(tmp_path)
    assert (status, explain(printed)) == (0, None)
    fault = explain(shell(tmp_path, "python3 -c 'from my_services.srv import Box'"))
    assert fault is not None
    assert "generate_messages" in fault.remedy


@pytest.mark.parametrize("text", ["", "all is well", "CMake Warning at a/CMakeLists.txt:1 (x):\n  Old.\n"])
def test_what_is_no_fault_is_none(text: str) -> None:
    """No explanation is better than a wrong one."""
    assert explain(text) is None


def test_an_unknown_message_comes_back_in_its_own_words() -> None:
    """In one line, the paths cut down, with the line of the package that led to it."""
    fault = explain(
        "-- Configuring\n\x1b[31mCMake Error at /usr/share/x/y.cmake:3 (message):\n  Something about\n"
        "  /home/me/ws/src/a/b.txt is\n  wrong.\nCall Stack (most recent call first):\n"
        "  a/CMakeLists.txt:9 (x)\n  CMakeLists.txt:68 (catkin_workspace)\n\n\n-- Configuring incomplete"
    )
    assert fault is not None
    assert fault.place == "a/CMakeLists.txt, line 9"
    assert fault.problem == "CMake says: Something about a/b.txt is wrong."
