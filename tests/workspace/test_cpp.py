"""Tests of missing_for_cpp() and of the explanations of compiler errors."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from course_pkg.workspace import cpp_support, explain, missing_for_cpp

needs_compiler = pytest.mark.skipif(bool(missing_for_cpp()), reason=missing_for_cpp())


def test_nothing_is_missing_in_the_environment_of_the_course() -> None:
    """In the course's environment, missing_for_cpp() finds a compiler and roscpp."""
    assert missing_for_cpp() == ""


def test_a_missing_compiler_is_named_with_what_to_type(monkeypatch: pytest.MonkeyPatch) -> None:
    """The error message about a missing compiler contains the command that installs a compiler."""
    monkeypatch.setenv("CXX", "/nowhere/c++")
    words = missing_for_cpp()
    assert words.startswith("No C++ compiler is installed (/nowhere/c++).")
    assert "apt-get install --no-install-recommends g++" in words
    assert "conda install compilers" in words


def test_missing_headers_are_named_with_what_to_type(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Without roscpp, the error message contains the command that installs roscpp."""
    monkeypatch.setattr(cpp_support, "prefixes", lambda: [tmp_path])
    assert "apt-get install --no-install-recommends libroscpp-dev" in missing_for_cpp()


def test_each_prefix_is_searched_for_headers_and_libraries(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """The compile command searches the folders of CMAKE_PREFIX_PATH first, and then the conda environment."""
    monkeypatch.setenv("CMAKE_PREFIX_PATH", f"{tmp_path}/devel")
    monkeypatch.setenv("CONDA_PREFIX", f"{tmp_path}/conda")
    command = cpp_support.compile_command("in.cpp", "out")
    assert [word for word in command if word.startswith("-I")] == [
        f"-I{tmp_path}/devel/include",
        f"-I{tmp_path}/conda/include",
    ]
    assert "-I/usr/include" not in command


ROS = "#include <ros/ros.h>\n#include <std_srvs/Trigger.h>\n"
FILE = "src/boxes/src/program.cpp"

# Each mistake has a program, the line of the mistake, and a text that the explanation must contain.
MISTAKES = {
    "no such header": ("#include <roz/ros.h>\nint main() {}\n", 1, "the header roz/ros.h"),
    "no return": (
        "bool measure(int& n) { n = 1; }\nint main() {}\n",
        1,
        "at the end of every branch of the function",
    ),
    "a semicolon lost": ("int main() {\n  int n = 1\n  return n;\n}\n", 3, "for a missing ; or bracket"),
    "a name misspelt": ("int main() {\n  return cuont;\n}\n", 2, "The compiler does not know the name cuont"),
    "a field misspelt": (
        "struct Box { float height; };\nint main() {\n  return Box().hieght;\n}\n",
        3,
        "Did you mean height?",
    ),
    "a field with a different name": (
        "struct Box { float height; };\nint main() {\n  return Box().colour;\n}\n",
        3,
        "rossrv show prints these fields",
    ),
    "something else": ('int main() {\n  return 1 / "two";\n}\n', 2, "The compiler reports: invalid operands"),
    "no library": ("void far_away();\nint main() { far_away(); }\n", 0, "not linked with a library"),
    "no main": ("int start() { return 0; }\n", 0, "The program has no function main"),
    "a handler of another kind": (
        f"{ROS}bool handle(std_srvs::Trigger::Request, std_srvs::Trigger::Response) {{ return true; }}\n"
        'int main() {\n  ros::NodeHandle node;\n  auto server = node.advertiseService("x", handle);\n}\n',
        6,
        "with both &",
    ),
}


@needs_compiler
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_recognised(mistake: str, tmp_path: Path) -> None:
    """The explanation of a compiler error contains the student's file, the line number, and advice."""
    text, line, words = MISTAKES[mistake]
    source = tmp_path / FILE
    source.parent.mkdir(parents=True)
    source.write_text(text)
    command = cpp_support.compile_command(str(source), str(tmp_path / "program"))
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    fault = explain(done.stderr)
    assert fault is not None
    assert words in f"{fault.problem} {fault.remedy}"
    assert (fault.file, fault.line) == (("boxes/src/program.cpp", line) if line else ("", 0))


@needs_compiler
def test_the_first_fault_is_one_of_the_student(tmp_path: Path) -> None:
    """The explanation begins with the error in the student's file, not in a system header."""
    printed = (
        "/usr/include/boost/function.hpp:7:3: error: no type named 'type'\n"
        f"{tmp_path}/{FILE}:9:3: error: 'x' was not declared in this scope\n"
    )
    fault = explain(printed)
    assert fault is not None
    assert fault.place == "boxes/src/program.cpp, line 9"


@needs_compiler
def test_a_good_program_builds_and_runs(tmp_path: Path) -> None:
    """With the compile command of the check, a program can use roscpp and the course's types."""
    source = tmp_path / "good.cpp"
    source.write_text(
        "#include <course_pkg/geometry.h>\n#include <ros/ros.h>\n"
        'int main(int argc, char** argv) { ros::init(argc, argv, "good"); return 0; }\n'
    )
    program = tmp_path / "good"
    done = subprocess.run(
        cpp_support.compile_command(str(source), str(program)), capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    assert subprocess.run([program], check=False).returncode == 0
