"""`check()` from a program that is a node, with a judge in a process of its own."""

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
from typing import Any

import pytest

from course_pkg.graph import MasterClient, PrivateMaster
from tests.support import eventually

SERVE = """
    def handle_geometry(request):
        return request.width * request.length, request.width * request.length * request.height

    node.serve("/getGeometry", geometry, handle_geometry)
"""
HANG = """
    def handle_geometry(request):
        print("waiting", flush=True)
        threading.Event().wait()

    node.serve("/getGeometry", geometry, handle_geometry)
"""


pytestmark = pytest.mark.usefixtures("master")


@contextmanager
def program(cells: str, state: Path, **env: str) -> Iterator[subprocess.Popen[str]]:
    """Run cells as a program of a student's, below the set-up that every notebook has."""
    setup = """
    import sys
    import threading
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
    """Return what the program prints."""
    with program(cells, state, **env) as process:
        out, err = process.communicate(timeout=30)
        assert process.returncode == 0, err
        return out


def examiners(master: PrivateMaster) -> list[str]:
    """Return the judges that are on the graph."""
    nodes = MasterClient(master.uri).system_state().nodes
    return [name for name in nodes if name.startswith("/examiner_")]


def record(state: Path) -> dict[str, Any]:
    """Return the judge's record of part 05.1."""
    kept: dict[str, Any] = json.loads((state / "results" / "05.1.json").read_text("utf-8"))
    return kept


def test_a_pass_reads_the_same_every_time_and_is_on_record(master: PrivateMaster, tmp_path: Path) -> None:
    """The text is what nbval compares; points come from the record. No judge stays on the graph."""
    out = output(SERVE + '    print(check("05.1"))\n    print(check("05.1"))', tmp_path)
    first, second = out[: len(out) // 2], out[len(out) // 2 :]
    assert first == second
    assert first.startswith("05.1 passed: 2 of 2 points\n")
    kept = record(tmp_path)
    assert (kept["verdict"], kept["points"], kept["possible"]) == ("passed", 2, 2)
    assert not examiners(master)


def test_a_seed_draws_the_same_inputs_again(tmp_path: Path) -> None:
    """With COURSE_SEED from a record, a failure is seen once more."""
    cells = '    node.serve("/getGeometry", geometry, lambda r: (r.length, 0))\n    handle_geometry = 1\n'
    cells += '    print(check("05.1"))'
    first = output(cells, tmp_path)
    assert output(cells, tmp_path, COURSE_SEED=str(record(tmp_path)["seed"])) == first
    assert output(cells, tmp_path) != first


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ('    print(check("05.1"))', "handle_geometry is not there: run the cell above first."),
        ('    handle_geometry = ...\n    print(check("05.1"))', "05.1 not attempted"),
        ('    print(check("99.9"))', "There is no check '99.9'."),
        ('    handle_geometry = 1\n    print(check("05.1"))', "nobody who serves it"),
        (
            '    handle_geometry = 1\n    import os\n    os.environ["ROS_MASTER_URI"] = "http://localhost:1"\n'
            '    print(check("05.1"))',
            "localhost:1",
        ),
        (
            '    t = threading.Thread(target=lambda: print(check("05.1")))\n    t.start()\n    t.join()',
            "not from another thread",
        ),
    ],
)
def test_what_stands_in_the_way_is_told_in_the_report(tmp_path: Path, cells: str, words: str) -> None:
    """Never a traceback: the report says what to do."""
    assert words in output(cells, tmp_path)


def test_the_topics_of_a_check_end_with_it(master: PrivateMaster, tmp_path: Path) -> None:
    """What the student's function left open is off the graph; what they began themselves stays."""
    cells = """
    from std_msgs.msg import UInt32

    mine = node.subscribe("/mine", UInt32)

    def listen(topic):
        return [message.data for message in node.subscribe(topic, UInt32).wait(3, timeout=10)]

    print(check("00.3").verdict.value)
    import rosgraph
    _, subscribers, _ = rosgraph.Master("/anybody").getSystemState()
    print([topic for topic, _ in subscribers])
    """
    assert output(cells, tmp_path).splitlines() == ["passed", "['/mine']"]


def test_the_judge_ends_with_a_killed_kernel(master: PrivateMaster, tmp_path: Path) -> None:
    """SIGKILL leaves nobody on the graph, in the middle of a check."""
    with program(HANG + '    check("05.1")', tmp_path) as process:
        eventually(lambda: examiners(master))
        process.send_signal(signal.SIGKILL)
        process.wait(5)
        eventually(lambda: not examiners(master))


def test_an_interrupt_ends_the_check_and_the_judge(master: PrivateMaster, tmp_path: Path) -> None:
    """The cell ends at once, the program goes on, and nobody stays behind."""
    cells = HANG + (
        "    try:\n"
        '        check("05.1")\n'
        "    except KeyboardInterrupt:\n"
        '        print("interrupted")\n'
        '    print("on the graph:", node.name)\n'
    )
    with program(cells, tmp_path) as process:
        eventually(lambda: examiners(master))
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=5)
    assert "interrupted\non the graph: /student" in out
    eventually(lambda: not examiners(master))


def test_a_file_of_the_students_does_not_shadow_the_judges_modules(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A rospy.py beside the notebook is the student's affair alone."""
    monkeypatch.chdir(tmp_path)
    cells = '    open("genpy.py", "w").write("raise SystemExit")\n    open("random.py", "w").write("1/0")\n'
    out = output(cells + SERVE + '    print(check("05.1"))', tmp_path)
    assert out.startswith("05.1 passed")
