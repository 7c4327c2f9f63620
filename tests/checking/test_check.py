"""Tests of `check()` in a program that runs a node."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from course_pkg.ros.protocol.json_channel import Json
from tests.support import eventually

SERVE = """
    def handle_geometry(request):
        return request.width * request.length, request.width * request.length * request.height

    rospy.Service("/getGeometry", geometry, handle_geometry)
"""
HANG = """
    def handle_geometry(request):
        print("waiting", flush=True)
        threading.Event().wait()

    rospy.Service("/getGeometry", geometry, handle_geometry)
"""


pytestmark = pytest.mark.usefixtures("master")


@contextmanager
def program(cells: str, state: Path, **env: str) -> Iterator[subprocess.Popen[str]]:
    """Run the source of notebook cells in a program that has called join() with the name `student`."""
    setup = """
    import sys
    import threading
    import rospy
    from course_pkg import check, join
    from course_pkg.srv import geometry
    node = join("student")
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(setup) + textwrap.dedent(cells)],
        env={**os.environ, "COURSE_STATE": str(state), **env},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def output(cells: str, state: Path, **env: str) -> str:
    """Return the output of a program with these cells."""
    with program(cells, state, **env) as process:
        out, err = process.communicate(timeout=30)
        assert process.returncode == 0, err
        return out


def check_runners(master: PrivateMaster) -> list[str]:
    """Return the nodes of check runners on the ROS graph."""
    nodes = MasterClient(master.uri).system_state().nodes
    return [name for name in nodes if name.startswith("/client_")]


def record(state: Path) -> dict[str, Json]:
    """Return the student's record of part 05.1."""
    kept: dict[str, Json] = json.loads((state / "results-2" / "05.1.json").read_text("utf-8"))
    return kept


def test_pass_has_the_same_text_each_time_and_is_recorded(master: PrivateMaster, tmp_path: Path) -> None:
    """Two passed checks print the same text, and the record contains the points."""
    out = output(SERVE + '    print(check("05.1"))\n    print(check("05.1"))', tmp_path)
    first, second = out[: len(out) // 2], out[len(out) // 2 :]
    assert first == second
    assert first.startswith("05.1 passed: 2 of 2 points\n")
    kept = record(tmp_path)
    assert (kept["verdict"], kept["points"], kept["possible"]) == ("passed", 2, 2)
    assert not check_runners(master)


def test_a_seed_draws_the_same_inputs_again(tmp_path: Path) -> None:
    """If COURSE_SEED is the seed from a record, the check uses the same inputs and fails again."""
    cells = '    rospy.Service("/getGeometry", geometry, lambda r: (r.length, 0))\n    handle_geometry = 1\n'
    cells += '    print(check("05.1"))'
    first = output(cells, tmp_path)
    assert output(cells, tmp_path, COURSE_SEED=str(record(tmp_path)["seed"])) == first
    assert output(cells, tmp_path) != first


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ('    print(check("05.1"))', "handle_geometry is not defined. First run the cell above."),
        ('    handle_geometry = ...\n    print(check("05.1"))', "05.1 not attempted"),
        ('    print(check("99.9"))', "There is no check '99.9'."),
        ('    handle_geometry = 1\n    print(check("05.1"))', "no server"),
        (
            '    handle_geometry = 1\n    import os\n    os.environ["ROS_MASTER_URI"] = "http://localhost:1"\n'
            '    print(check("05.1"))',
            "localhost:1",
        ),
        (
            '    t = threading.Thread(target=lambda: print(check("05.1")))\n    t.start()\n    t.join()',
            "called from another thread",
        ),
    ],
)
def test_report_says_what_to_do_first(tmp_path: Path, cells: str, words: str) -> None:
    """If a check cannot run, the report says what the student should do next."""
    assert words in output(cells, tmp_path)


def test_the_topics_of_a_check_end_with_it(master: PrivateMaster, tmp_path: Path) -> None:
    """After a check, the subscriptions that the student's function made no longer exist."""
    cells = """
    import time
    from std_msgs.msg import UInt32

    mine = node.subscribe("/mine", UInt32)

    def count_missed(topic, pause):
        received = node.subscribe(topic, UInt32)
        received.wait(1, timeout=3)
        time.sleep(pause + 0.1)
        before, after = received.messages[0].data, received.messages[-1].data
        return before, after, after - before - 1

    print(check("00.3").verdict.value)
    import rosgraph
    _, subscribers, _ = rosgraph.Master("/anybody").getSystemState()
    print([topic for topic, _ in subscribers])
    """
    assert output(cells, tmp_path).splitlines() == ["not yet", "['/mine']"]


def test_the_check_runner_ends_with_a_killed_kernel(master: PrivateMaster, tmp_path: Path) -> None:
    """If the kernel is killed during a check, the check runner ends too."""
    with program(HANG + '    check("05.1")', tmp_path) as process:
        eventually(lambda: check_runners(master))
        process.send_signal(signal.SIGKILL)
        process.wait(5)
        eventually(lambda: not check_runners(master))


def test_an_interrupt_ends_the_check_and_the_check_runner(master: PrivateMaster, tmp_path: Path) -> None:
    """After an interrupt, the cell ends, the program continues, and the check runner ends."""
    cells = HANG + (
        "    try:\n"
        '        check("05.1")\n'
        "    except KeyboardInterrupt:\n"
        '        print("interrupted")\n'
        '    print("on the graph:", node.name)\n'
    )
    with program(cells, tmp_path) as process:
        eventually(lambda: check_runners(master))
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=5)
    assert "interrupted\non the graph: /student" in out
    eventually(lambda: not check_runners(master))


def test_a_file_of_the_students_does_not_shadow_the_modules_of_the_check_runner(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The check runner does not import modules from the notebook's folder."""
    monkeypatch.chdir(tmp_path)
    cells = '    open("genpy.py", "w").write("raise SystemExit")\n    open("random.py", "w").write("1/0")\n'
    out = output(cells + SERVE + '    print(check("05.1"))', tmp_path)
    assert out.startswith("05.1 passed")
