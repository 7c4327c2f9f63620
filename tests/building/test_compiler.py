"""What the real compiler and linker print is recognised, with the line, and with what to do about it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from course_pkg.building import explain, missing_for_cpp
from course_pkg.building.cpp import compile_command

pytestmark = pytest.mark.skipif(bool(missing_for_cpp()), reason=missing_for_cpp())

ROS = "#include <ros/ros.h>\n#include <std_srvs/Trigger.h>\n"
FILE = "src/boxes/src/program.cpp"

# The program, the line that has to be named, and words of the problem or the remedy.
SLIPS = {
    "no such header": ("#include <roz/ros.h>\nint main() {}\n", 1, "no header roz/ros.h"),
    "no return": (
        "bool measure(int& n) { n = 1; }\nint main() {}\n",
        1,
        "return true or return false on every",
    ),
    "a semicolon lost": ("int main() {\n  int n = 1\n  return n;\n}\n", 3, "for a missing ; or bracket"),
    "a name misspelt": ("int main() {\n  return cuont;\n}\n", 2, "Nothing here is called cuont"),
    "a field misspelt": (
        "struct Box { float height; };\nint main() {\n  return Box().hieght;\n}\n",
        3,
        "Did you mean height?",
    ),
    "a field that is nothing like it": (
        "struct Box { float height; };\nint main() {\n  return Box().colour;\n}\n",
        3,
        "rossrv show says which fields",
    ),
    "something else": ('int main() {\n  return 1 / "two";\n}\n', 2, "The compiler says: invalid operands"),
    "no library": ("void far_away();\nint main() { far_away(); }\n", 0, "linked with no library that has it"),
    "no main": ("int start() { return 0; }\n", 0, "The program has no function main"),
    "a handler of another kind": (
        f"{ROS}bool handle(std_srvs::Trigger::Request, std_srvs::Trigger::Response) {{ return true; }}\n"
        'int main() {\n  ros::NodeHandle node;\n  auto server = node.advertiseService("x", handle);\n}\n',
        6,
        "each with its &",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_recognised(slip: str, tmp_path: Path) -> None:
    """The fault names the student's file below src, its line, and the remedy."""
    text, line, words = SLIPS[slip]
    source = tmp_path / FILE
    source.parent.mkdir(parents=True)
    source.write_text(text)
    command = compile_command(str(source), str(tmp_path / "program"))
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    fault = explain(done.stderr)
    assert fault is not None
    assert words in f"{fault.problem} {fault.remedy}"
    assert (fault.file, fault.line) == (("boxes/src/program.cpp", line) if line else ("", 0))


def test_the_first_fault_is_one_of_the_student(tmp_path: Path) -> None:
    """Errors in headers of the system follow from what stands in the student's file, and come after it."""
    printed = (
        "/usr/include/boost/function.hpp:7:3: error: no type named 'type'\n"
        f"{tmp_path}/{FILE}:9:3: error: 'x' was not declared in this scope\n"
    )
    fault = explain(printed)
    assert fault is not None
    assert fault.place == "boxes/src/program.cpp, line 9"


def test_a_good_program_builds_and_runs(tmp_path: Path) -> None:
    """The command that a check compiles with finds roscpp, its libraries and the course's own types."""
    source = tmp_path / "good.cpp"
    source.write_text(
        "#include <course_pkg/geometry.h>\n#include <ros/ros.h>\n"
        'int main(int argc, char** argv) { ros::init(argc, argv, "good"); return 0; }\n'
    )
    program = tmp_path / "good"
    done = subprocess.run(
        compile_command(str(source), str(program)), capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    assert subprocess.run([program], check=False).returncode == 0
