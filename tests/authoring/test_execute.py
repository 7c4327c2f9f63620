"""`course sync --execute` runs each chapter in a new kernel and stores the outputs."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Cell, Output, not_passed
from course_pkg.authoring.execute import execute
from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.authoring.validate import validate
from course_pkg.cli import INSIDE, main
from course_pkg.errors import AuthoringError
from course_pkg.setup import Places
from tests.authoring.books import book, check, code, exercise
from tests.support import eventually, process_state

SET_UP = (
    "import rospy\nfrom course_pkg import check, join\nfrom course_pkg.srv import geometry\n"
    'node = join("chapter_05")'
)
SERVER = (
    "def handle_geometry(request):\n"
    "    area = request.width * request.length\n"
    "    return area, area * request.height\n\n\n"
    'service = rospy.Service("/getGeometry", geometry, handle_geometry)'
)
PLOT = (
    "import matplotlib.pyplot as plt\n\n"
    'plt.plot([0, 1], [1, 3], label="by topic")\nplt.xlabel("time (s)")\nplt.legend()\nplt.show()'
)


def solution(root: Path, *cells: Cell) -> Path:
    """Write a solution notebook of chapter 05 with the given cells, and return the path of the notebook."""
    (root / "solutions").mkdir()
    path = root / "solutions" / "05_write_a_server.ipynb"
    path.write_text(json.dumps(book(*cells)))
    return path


def test_an_executed_solution_is_stable_and_valid(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A second execution does not change the stored notebook, and nbval accepts this notebook."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    path = solution(tmp_path, code(SET_UP, id="set-up"), exercise(source=SERVER), check())
    execute(["05"], tmp_path)
    first = path.read_text()
    assert "05.1 passed: 2 of 2 points" in first
    execute(["05"], tmp_path)
    assert path.read_text() == first
    outcome = validate([path], workers=1)
    assert outcome.returncode == 0, outcome.stdout


def test_a_figure_is_a_stable_svg_that_nbval_does_not_compare(tmp_path: Path) -> None:
    """Each execution stores the same SVG, and nbval compares only the plain text of the figure."""
    set_up = code('from course_pkg import join\nnode = join("chapter_05")', id="set-up")
    path = solution(tmp_path, code(PLOT, id="early"), set_up, code(PLOT, id="plot"))
    execute(["05"], tmp_path)
    first = path.read_text()
    execute(["05"], tmp_path)
    notebook, (figure,) = json.loads(first), json.loads(path.read_text())["cells"][2]["outputs"]
    assert notebook["cells"][2]["outputs"] == [figure]
    assert set(figure["data"]) == {"image/svg+xml", "text/plain"}
    svg = "".join(figure["data"]["image/svg+xml"])
    assert ">time (s)</text>" in svg
    assert ">by topic</text>" in svg
    assert figure["data"]["text/plain"] == ["<Figure size 640x480 with 1 Axes>"]
    for kind, agrees in (("image/svg+xml", True), ("text/plain", False)):
        figure["data"][kind] = ["another"]
        notebook["cells"][2]["outputs"] = [figure]
        path.write_text(json.dumps(notebook))
        outcome = validate([path], workers=1)
        assert (outcome.returncode == 0) is agrees, outcome.stdout


def test_a_cell_that_stops_the_run_is_named(tmp_path: Path) -> None:
    """If a cell fails, the error message contains its id, and the stored notebook does not change."""
    path = solution(tmp_path, code("1 / 0", id="boom"))
    before = path.read_text()
    with pytest.raises(AuthoringError, match="the run stopped at cell boom: ZeroDivisionError"):
        execute(["05"], tmp_path)
    assert path.read_text() == before


def test_a_check_that_does_not_pass_is_not_stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a check fails, `course sync --execute` exits with status 1 and prints the check's report."""
    wrong = SERVER.replace("request.width * request.length", "request.width + request.length")
    path = solution(tmp_path, code(SET_UP, id="set-up"), exercise(source=wrong), check())
    before = path.read_text()
    monkeypatch.setenv(INSIDE, str(Places.of().python))
    monkeypatch.setattr("course_pkg.authoring.execute.NotebookStore", lambda _: NotebookStore(tmp_path))
    with pytest.raises(SystemExit) as ended:
        main(["sync", "--execute", "05"])
    assert path.read_text() == before
    first, headline, *report = str(ended.value.code).splitlines()
    assert first.startswith("course: 05_write_a_server: check 05.1 has not passed")
    assert headline == "  05.1 not yet: 0 of 2 points"
    assert any("Your area is width + length" in line for line in report)


def test_a_check_without_a_report_has_not_passed() -> None:
    """A check has passed only if the cell's output is the report of this check, and not printed text."""
    passed = {"output_type": "execute_result", "data": {"text/plain": "05.1 passed: 2 of 2 points"}}
    printed = {"output_type": "stream", "name": "stdout", "text": "05.1 passed"}
    assert not_passed(book(_checked(passed), _checked(printed, passed), code("1"))) == {}
    assert not_passed(book(_checked())) == not_passed(book(_checked(printed))) == {"05.1": ""}
    other = {"output_type": "execute_result", "data": {"text/plain": "05.2 passed: 2 of 2 points"}}
    assert not_passed(book(_checked(other))) == {"05.1": "05.2 passed: 2 of 2 points"}


def _checked(*outputs: Output) -> Cell:
    return {**check(), "outputs": list(outputs)}


INTERRUPTED = """
import sys
from course_pkg.authoring.execute import run_all
from tests.authoring.books import book, code
cell = f"import os, time\\nopen({sys.argv[1]!r}, 'w').write(str(os.getpid()))\\ntime.sleep(100)"
run_all({"05_wait": book(code(cell))}, lambda *_: None)
"""


def test_an_interrupt_ends_the_kernels(tmp_path: Path) -> None:
    """Ctrl-C ends the kernel and the program that executes the notebooks."""
    pid_file = tmp_path / "pid"
    with subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, str(pid_file)], stderr=subprocess.DEVNULL
    ) as process:
        pid = int(eventually(lambda: pid_file.exists() and pid_file.read_text(), timeout=60))
        process.send_signal(signal.SIGINT)
        assert process.wait(30) != 0
    eventually(lambda: process_state(pid) == "Z", timeout=20)
