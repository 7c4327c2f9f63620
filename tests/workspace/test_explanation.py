"""Tests of the explanations of messages from ROS tools.

Each case is a package with one mistake, which the real catkin_make builds. All cases use one workspace,
because this saves time.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from course_pkg.workspace import Fault, explain
from course_pkg.workspace.fault import dependencies, locate, manifest_tags
from tests.support import usual
from tests.workspace.packages import BOX, GOOD, LISTS, MANIFEST, build, shell, spoilt, write

LIST_FILE = "my_services/CMakeLists.txt"
FIND = "find_package(catkin REQUIRED COMPONENTS message_generation)\n"
ADD = "add_service_files(FILES Box.srv)\n"
GENERATE = "generate_messages()\n"
PACKAGE = "catkin_package(CATKIN_DEPENDS message_runtime)\n"
C, S, X = "CMakeLists.txt", "srv/Box.srv", "package.xml"

# Each case of `SLIPS` has the files, the expected position, and a text that the explanation must contain.
SLIPS = {
    "message_generation missing": (
        spoilt(C, (" COMPONENTS message_generation", "")),
        f"{LIST_FILE}, line 6",
        "message_generation defines this command",
    ),
    "find_package too late": (
        spoilt(C, (FIND, ""), (ADD, ADD + FIND)),
        f"{LIST_FILE}, line 5",
        "above this line",
    ),
    "generated before the files are listed": (
        spoilt(C, (ADD, ""), (GENERATE, GENERATE + ADD)),
        f"{LIST_FILE}, line 7",
        "Move this line above generate_messages",
    ),
    "generated after catkin_package": (
        spoilt(C, (GENERATE, ""), (PACKAGE, PACKAGE + GENERATE)),
        f"{LIST_FILE}, line 9",
        "Move generate_messages above catkin_package",
    ),
    "a program whose file is missing": (
        spoilt(C, (PACKAGE, PACKAGE + "add_executable(box src/none.cpp)\n")),
        f"{LIST_FILE}, line 10",
        "The file src/none.cpp does not exist",
    ),
    "the name of a variable instead of its value": (
        spoilt(
            C,
            (
                PACKAGE,
                PACKAGE + "add_custom_target(a)\nadd_dependencies(a ${PROJECT_NAME}_EXPORTED_TARGETS)\n",
            ),
        ),
        f"{LIST_FILE}, line 11",
        "this is only the name of a variable",
    ),
    "linked before add_executable": (
        spoilt(C, (PACKAGE, PACKAGE + "target_link_libraries(box ros)\n")),
        f"{LIST_FILE}, line 10",
        "No line above this line creates the program box",
    ),
    "generated twice": (
        spoilt(C, (GENERATE, GENERATE * 2)),
        f"{LIST_FILE}, line 8",
        "CMakeLists.txt calls generate_messages twice",
    ),
    "no file listed": (spoilt(C, (ADD, "")), f"{LIST_FILE}, line 6", "Write add_service_files"),
    "wrong file name": (
        spoilt(C, ("Box.srv", "Bocks.srv")),
        f"{LIST_FILE}, line 6",
        "The file Bocks.srv is not in the folder",
    ),
    "wrong case in the file name": (
        spoilt(C, ("Box.srv", "box.srv")),
        f"{LIST_FILE}, line 6",
        "upper and lower case",
    ),
    "the folder in the file name": (
        spoilt(C, ("Box.srv", "srv/Box.srv")),
        f"{LIST_FILE}, line 6",
        "Do not write the folder srv",
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
        "find_package needs the package message_generaton",
    ),
    "a bracket missing": (
        spoilt(C, (GENERATE, "generate_messages(\n")),
        f"{LIST_FILE}, line 7",
        "Write the missing closing parenthesis",
    ),
    "a bracket too many": (
        spoilt(C, (GENERATE, "generate_messages())\n")),
        f"{LIST_FILE}, line 7",
        "at the place where a command has to begin",
    ),
    "still as in the template": (
        {**GOOD, C: "...\n"},
        f"{LIST_FILE}, line 1",
        "it contains ... at the place where a command has to begin",
    ),
    "no project": (
        spoilt(C, ("project(my_services)\n", "")),
        f"{LIST_FILE}, line 8",
        "Write project(NAME)",
    ),
    "another name in project": (
        spoilt(C, ("project(my_services)", "project(my_service)")),
        f"{LIST_FILE}, line 9",
        "package.xml has the name my_services, but CMakeLists.txt has the name my_service.",
    ),
    "needed to run, but not listed": (
        spoilt(X, ("  <exec_depend>message_runtime</exec_depend>\n", "")),
        f"{LIST_FILE}, line 9",
        "<exec_depend>message_runtime</exec_depend>",
    ),
    "message_generation in catkin_package": (
        spoilt(C, ("CATKIN_DEPENDS message_runtime", "CATKIN_DEPENDS message_generation")),
        f"{LIST_FILE}, line 9",
        "write message_runtime instead of message_generation",
    ),
    "needed to build, but not listed": (
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
    "catkin not listed": (
        spoilt(X, ("  <buildtool_depend>catkin</buildtool_depend>\n", "")),
        f"{LIST_FILE}, line 9",
        "<buildtool_depend>catkin</buildtool_depend>",
    ),
    "another package's message": (
        spoilt(S, ("float32 length", "std_msgs/Header header")),
        f"{LIST_FILE}, line 7",
        "generate_messages(DEPENDENCIES std_msgs)",
    ),
    "depends on a package that was not found": (
        spoilt(C, ("generate_messages()", "generate_messages(DEPENDENCIES std_msgs)")),
        f"{LIST_FILE}, line 7",
        "Add std_msgs to the COMPONENTS",
    ),
    "no such type": (
        spoilt(S, ("float32 length", "float length")),
        "my_services/srv/Box.srv",
        "float is not a built-in type of ROS",
    ),
    "dashes with blanks": (spoilt(S, ("---", "- - -")), "", "contains the line - - - instead of the"),
    "two dashes": (spoilt(S, ("---", "--")), "", "Write a line that contains only ---"),
    "a tab": (
        spoilt(S, ("float32 length", "float32\tlength")),
        "",
        "A field needs a type, one space, and a name",
    ),
    "a semicolon": (spoilt(S, ("length", "length;")), "", "length; is not a legal"),
    "a name twice": (spoilt(S, ("width", "length")), "", "Duplicate field names"),
    "a byte order mark in the .srv": ({**GOOD, S: "\ufeff" + BOX}, "", "is not a legal message field type"),
    "a tag not closed": (spoilt(X, ("</name>", "")), "my_services/package.xml, line 12", "Close every"),
    "a line above the XML": (
        {**GOOD, X: "\n" + GOOD[X]},
        "my_services/package.xml, line 2",
        "in the first column of line 1",
    ),
    "a tag of format 1": (
        spoilt(X, ("exec_depend", "run_depend")),
        "my_services/package.xml",
        "A package.xml of format 2 cannot have the tag run_depend",
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
        "Keep only <depend>",
    ),
    "half a version": (spoilt(X, ("0.1.0", "0.1")), "my_services/package.xml", "as in this example: 0.1.0"),
    "no maintainer": (
        spoilt(X, ('  <maintainer email="me@example.com">Me</maintainer>\n', "")),
        "my_services/package.xml",
        "has no maintainer",
    ),
    "no address": (spoilt(X, (' email="me@example.com"', "")), "package.xml", "has no attribute email"),
    "half an address": (
        spoilt(X, ("me@example.com", "me")),
        "my_services/package.xml",
        "a whole e-mail address",
    ),
    "a dash in the name": (
        {**spoilt(X, ("my_services", "my-services")), C: LISTS.replace("my_services", "my-services")},
        "package.xml",
        "cannot be the name of a package",
    ),
}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Create a workspace in a folder with a long path."""
    return tmp_path_factory.mktemp("workspace-with-a-long-name")


@pytest.mark.parametrize(("files", "place", "words"), usual(10, SLIPS))
def test_mistake_in_a_package_is_explained(
    workspace: Path, files: dict[str, str], place: str, words: str
) -> None:
    """For each mistake in a package, the explanation contains the position, the problem and advice."""
    write(workspace, files)
    _, printed = build(workspace)
    fault = explain(printed)
    assert fault is not None, printed
    assert fault.place == place
    assert words in str(fault)


CORRECT: dict[str, dict[str, str]] = {
    "good": GOOD,
    "Windows line ends": {name: text.replace("\n", "\r\n") for name, text in GOOD.items()},
    "a byte order mark": {**GOOD, C: "\ufeff" + LISTS},
    "no minimum": {**GOOD, C: LISTS.replace("cmake_minimum_required(VERSION 3.10)\n", "")},
}


@pytest.mark.parametrize("files", usual(1, CORRECT))
def test_successful_build_has_no_fault(workspace: Path, files: dict[str, str]) -> None:
    """explain() finds no fault in the output of a successful build."""
    write(workspace, files)
    status, printed = build(workspace)
    assert (status, explain(printed)) == (0, None)
    assert shell(workspace, "python3 -c 'from my_services.srv import Box'") == ""


def test_another_python_is_recognised(tmp_path: Path) -> None:
    """If the first Python in PATH has no ROS, the advice contains the option that selects another Python."""
    subprocess.run(["python3", "-m", "venv", "--without-pip", tmp_path / "other"], check=True)
    write(tmp_path, GOOD)
    for path in (str(tmp_path / "other" / "bin"), ""):
        fault = explain(build(tmp_path, path=path)[1])
        assert fault is not None
        assert "-DPYTHON_EXECUTABLE" in fault.remedy
    assert build(tmp_path, "-DPYTHON_EXECUTABLE=/usr/bin/python3")[0] == 0


# GCC 12 prints these error messages if a handler is a lambda function, without and with a type in < >.
LAMBDAS = [
    "no matching function for call to 'ros::NodeHandle::advertiseService(const char [4], main(int, char**)::"
    "<lambda(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)>)'",
    "call of overloaded 'advertiseService(const char [4], main(int, char**)::"
    "<lambda(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)>)' is ambiguous",
]


@pytest.mark.parametrize("message", LAMBDAS)
def test_lambda_as_a_handler_is_explained(message: str) -> None:
    """If advertiseService gets a lambda function, the advice names the type that roscpp needs."""
    fault = explain(f"/home/you/workspace/src/boxes/src/box.cpp:7:58: error: {message}\n")
    assert fault is not None
    assert fault.place == "boxes/src/box.cpp, line 7"
    assert "boost::function" in fault.remedy


# Each entry of `SAID` has a command that runs after the build, and a text that the explanation must contain.
SAID = {
    "not sourced: Python": ("python3 -c 'import my_services.srv'", False, "source devel/setup.bash"),
    "another Python": ("/usr/bin/python3 -S -c 'import numpy'", True, "#!/usr/bin/env python3"),
    "not sourced: rospack": ("rospack find my_services", False, "source devel/setup.bash"),
    "not sourced: rossrv": ("rossrv show my_services/Box", False, "source devel/setup.bash"),
    "wrong case": (
        "python3 -c 'from my_services.srv import box'",
        True,
        "distinguish capital and small letters",
    ),
    "no run bit": ("rosrun my_services plain.py", True, "chmod +x"),
    "no shebang": ("rosrun my_services shell.py", True, "#!/usr/bin/env python3"),
    "Windows line ends": ("rosrun my_services windows.py", True, "Linux line endings"),
    "roslaunch instead of rosrun": ("roslaunch course_pkg server", True, "with rosrun"),
    "roslaunch of a script": ("roslaunch my_services plain.py", True, "with rosrun"),
    "rosservice show": ("rosservice show /box", True, "rossrv show"),
}


@pytest.mark.parametrize(("line", "sourced", "words"), usual(5, SAID))
def test_messages_of_other_tools_are_explained(workspace: Path, line: str, sourced: bool, words: str) -> None:
    """The course explains a wrong import, a missing shebang and a wrong command."""
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


def test_a_missing_shebang_is_explained_where_imagemagick_is_installed() -> None:
    """The course explains a script without a shebang even if ImageMagick's program `import` is installed."""
    fault = explain(
        "import-im6.q16: unable to open X server `' @ error/import.c/ImportImageCommand/346.\n"
        "shell.py: line 2: syntax error near unexpected token `('"
    )
    assert fault is not None
    assert "#!/usr/bin/env python3" in fault.remedy
    alone = explain("import: unable to open X server `:0' @ error/import.c/ImportImageCommand/350.")
    assert alone == fault


def test_types_that_were_not_generated_are_explained(tmp_path: Path) -> None:
    """If generate_messages is missing, the explanation says how to add generate_messages."""
    write(tmp_path, spoilt(C, (GENERATE, f"# {GENERATE}")))
    status, printed = build(tmp_path)
    assert (status, explain(printed)) == (0, None)
    fault = explain(shell(tmp_path, "python3 -c 'from my_services.srv import Box'"))
    assert fault is not None
    assert "generate_messages" in fault.remedy


@pytest.mark.parametrize("text", ["", "all is well", "CMake Warning at a/CMakeLists.txt:1 (x):\n  Old.\n"])
def test_unknown_output_has_no_explanation(text: str) -> None:
    """Unknown output has no explanation."""
    assert explain(text) is None


def test_unknown_message_is_quoted() -> None:
    """If a message is unknown, the problem is one line, and the position is in the student's package."""
    fault = explain(
        "-- Configuring\n\x1b[31mCMake Error at /usr/share/x/y.cmake:3 (message):\n  Something about\n"
        "  /home/me/ws/src/a/b.txt is\n  wrong.\nCall Stack (most recent call first):\n"
        "  a/CMakeLists.txt:9 (x)\n  CMakeLists.txt:68 (catkin_workspace)\n\n\n-- Configuring incomplete"
    )
    assert fault is not None
    assert fault.place == "a/CMakeLists.txt, line 9"
    assert fault.problem == "CMake reports: Something about a/b.txt is wrong."


def test_tags_have_lines() -> None:
    """manifest_tags() finds tags with attributes, but no tags in comments."""
    text = '<?xml version="1.0"?>\n<package format="2">\n<!-- <name>old</name>\n-->\n  <name> mine </name>\n'
    assert [(tag.name, tag.line, tag.text) for tag in manifest_tags(text)] == [
        ("package", 2, ""),
        ("name", 5, "mine"),
    ]


BOTH = {"message_generation", "message_runtime"}
CONDITION = MANIFEST.replace("<exec_depend", '<exec_depend condition="$A == b"').replace('"2"', '"3"')


@pytest.mark.parametrize(
    ("text", "build", "run"),
    [
        (MANIFEST, {"message_generation"}, {"message_runtime"}),
        (MANIFEST.replace("build_depend", "depend"), {"message_generation"}, BOTH),
        (CONDITION, {"message_generation"}, set()),
    ],
)
def test_what_a_package_needs(text: str, build: set[str], run: set[str]) -> None:
    """The tag `depend` declares both a build dependency and a runtime dependency."""
    assert (dependencies(text, "build"), dependencies(text, "run")) == (build, run)


@pytest.mark.parametrize(
    ("problem", "text", "line"),
    [
        ("The version 1.0 is not three numbers.", MANIFEST, 4),
        ("package.xml has the name a, but CMakeLists.txt has b.", MANIFEST, 3),
        ("A tag is not closed.", MANIFEST.replace("</license>", ""), 7),
        ("Nobody knows.", MANIFEST, 0),
    ],
)
def test_a_fault_is_located(problem: str, text: str, line: int) -> None:
    """locate() finds the line of the tag with the problem in the text of package.xml."""
    assert locate(Fault(problem, "", "my_services/package.xml"), text).line == line


def test_a_fault_of_another_file_stays_where_it_is() -> None:
    """If a fault is not in a package.xml, locate() returns the fault unchanged."""
    fault = Fault("The version is old.", "", "my_services/CMakeLists.txt", 9)
    assert locate(fault, MANIFEST) == fault
