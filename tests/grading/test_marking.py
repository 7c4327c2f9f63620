"""Tests of the points that each part of a submission earns, and of the reasons for missing points."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells
from course_pkg.checking.parts import chapters
from course_pkg.checking.report import Verdict
from course_pkg.errors import WorkerFailed
from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.marking import mark
from course_pkg.grading.plan import plan
from course_pkg.grading.store import Store
from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.worker_client import SandboxWorker
from tests.grading.submitted import WRONG, hand_in

pytestmark = pytest.mark.usefixtures("sandbox")
USUAL = ("00", "05", "08")  # The solutions of these chapters are graded in every test run.
CLIENT = """
import json, os, socket
host, port = os.environ["COURSE_CHECK_RUNNER"].split(":")
lines = socket.create_connection((host, int(port))).makefile("rw")
def send(text):
    lines.write(text + "\\n")
    lines.flush()
"""  # This student's check client replaces the course's check client.
BREAKERS = {
    "another protocol": CLIENT + 'send(json.dumps({"protocol": 1, "check": "05.1"}))\nlines.readline()',
    "another check": CLIENT + 'send(json.dumps({"protocol": 3, "check": "00.1"}))\nlines.readline()',
    "a line that is not JSON": CLIENT + "send('x' * 100)\nlines.readline()",
    "deeply nested JSON": CLIENT
    + 'send(json.dumps({"protocol": 3, "check": "05.1"}))\nlines.readline()\n'
    + 'send(\'{"answer": 1, "kind": "function", "older": \' + "[" * 900 + "]" * 900 + "}")\nlines.readline()',
    "JSON with deeper levels than Python can read": CLIENT
    + 'send(json.dumps({"protocol": 3, "check": "05.1"}))\nlines.readline()\n'
    + 'send(\'{"answer": 1, "kind": \' + "[" * 100_000 + "]" * 100_000 + "}")\nlines.readline()',
    "the master is shut down": (
        "import os, xmlrpc.client\nhandle_geometry = 1\n"
        'xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).shutdown("/x", "")'
    ),
}  # Each value is a student's program; its key describes how the program disturbs the check.


@pytest.fixture(scope="module")
def worker() -> Iterator[SandboxWorker]:
    """Run one sandbox worker, which all tests of this module use."""
    with SandboxWorker() as started:
        yield started


def graded(worker: SandboxWorker, path: Path, chapter: str = "05") -> Grade:
    """Return the grade of a notebook."""
    submission = Submission("s01", chapter, path.read_bytes(), path.name)
    return mark(submission, plan(chapter), worker.run, "secret", "key", sandboxed=True)


@pytest.mark.parametrize(
    "chapter",
    [
        pytest.param(chapter, marks=() if chapter in USUAL else pytest.mark.when_changed)
        for chapter in chapters()
    ],
)
@pytest.mark.timeout(300)
def test_the_solution_earns_full_marks(worker: SandboxWorker, tmp_path: Path, chapter: str) -> None:
    """In the sandbox, the solution of a chapter passes every part."""
    grade = graded(worker, hand_in(tmp_path, "s01", chapter), chapter)
    assert {report.check: report.verdict for report in grade.reports} == {
        each.part.check: Verdict.PASSED for each in plan(chapter).parts
    }
    assert grade.earned == grade.possible > 0


def test_each_part_has_its_own_points(worker: SandboxWorker, tmp_path: Path) -> None:
    """A wrong answer, a blank answer or an answer that ends its process loses only the points of one part."""
    answers = {"05.1": WRONG, "05.2": "import os; os._exit(1)", "05.3": ""}
    grade = graded(worker, hand_in(tmp_path, "s01", answers=answers))
    verdicts = [report.verdict for report in grade.reports]
    assert verdicts == [
        Verdict.FAILED,
        Verdict.FAILED,
        Verdict.NOT_ATTEMPTED,
        Verdict.PASSED,
        Verdict.PASSED,
    ]
    wrong, ended, blank, *_ = grade.reports
    assert "area" in str(wrong)
    assert "ended before the check was finished" in ended.note
    assert "not changed" in blank.note


def test_a_worker_that_fails_costs_no_points(worker: SandboxWorker, tmp_path: Path) -> None:
    """If the worker fails, the report says that the part was not examined, and the grade is not stored."""

    def run(job: PartJob) -> PartResult:
        if job.check == "05.2":
            raise WorkerFailed("it ended")
        return worker.run(job)

    submission = Submission("s01", "05", hand_in(tmp_path, "s01").read_bytes(), "05.ipynb")
    grade = mark(submission, plan("05"), run, "secret", "key", sandboxed=True)
    verdicts = [report.verdict for report in grade.reports]
    assert verdicts == [Verdict.PASSED, Verdict.UNDECIDED, *[Verdict.PASSED] * 3]
    store = Store(tmp_path)
    store.keep(grade)
    assert store.find("key", submission) is None
    store.keep(graded(worker, hand_in(tmp_path, "s02")))
    assert store.find("key", submission) is not None


@pytest.mark.parametrize("breaker", BREAKERS)
def test_a_student_cannot_choose_not_examined(worker: SandboxWorker, tmp_path: Path, breaker: str) -> None:
    """If an answer breaks the check, the part fails, and the grade is stored."""
    path = hand_in(tmp_path, "s01", answers={"05.1": BREAKERS[breaker]})
    submission = Submission("s01", "05", path.read_bytes(), path.name)
    first = replace(plan("05"), parts=plan("05").parts[:1])
    grade = mark(submission, first, worker.run, "secret", "key", sandboxed=True)
    (broken,) = grade.reports
    assert (broken.verdict, broken.points, broken.possible) == (Verdict.FAILED, 0, 2)
    assert broken.goal
    assert broken.note or broken.assertions
    store = Store(tmp_path)
    store.keep(grade)
    assert store.find("key", submission) is not None


def test_error_of_a_cell_is_in_the_feedback(worker: SandboxWorker, tmp_path: Path) -> None:
    """If a cell fails, the feedback shows its error."""
    grade = graded(
        worker, hand_in(tmp_path, "s01", answers={"05.1": "def handle_geometry(request:\n    pass\n"})
    )
    assert "SyntaxError" in grade.reports[0].note


def test_answer_may_use_cells_above(worker: SandboxWorker, tmp_path: Path) -> None:
    """An answer can use a function from an earlier answer and the imports of the course."""
    first = (
        "import math\n\ndef product(*sides):\n    return math.prod(sides)\n\n\n"
        "def handle_geometry(request):\n    area = product(request.width, request.length)\n"
        "    return geometryResponse(area, product(area, request.height))\n\n\n"
        "geometry_service = rospy.Service('/getGeometry', geometry, handle_geometry)\n"
    )
    later = (
        "def handle_checked_geometry(request):\n"
        "    for name in ('length', 'width', 'height'):\n"
        "        if getattr(request, name) < 0:\n"
        "            raise rospy.ServiceException(f'{name} is {getattr(request, name):g}')\n"
        "    area = product(request.width, request.length)\n"
        "    return geometryResponse(area, product(area, request.height))\n\n\n"
        "checked_service = rospy.Service('/getGeometryChecked', geometry, handle_checked_geometry)\n"
    )
    grade = graded(worker, hand_in(tmp_path, "s01", answers={"05.1": first, "05.3": later}))
    assert [report.verdict for report in grade.reports[:3]] == [Verdict.PASSED] * 3


def test_notebook_without_a_cell(worker: SandboxWorker, tmp_path: Path) -> None:
    """If a student has deleted an exercise, the student loses only the points of this exercise."""
    path = hand_in(tmp_path, "s01")
    notebook = json.loads(path.read_text())
    gone = next(cell for cell in code_cells(notebook) if "def handle_checked" in cell["source"])
    notebook["cells"].remove(gone)
    path.write_text(json.dumps(notebook))
    grade = graded(worker, path)
    assert grade.earned == grade.possible - grade.reports[2].possible
    assert grade.reports[2].verdict is Verdict.NOT_ATTEMPTED
    assert grade.reports[2].note


def test_what_is_no_notebook_earns_nothing_and_says_why(worker: SandboxWorker, tmp_path: Path) -> None:
    """If a file is not a notebook, its parts get no points, and each part gets a note with the reason."""
    path = tmp_path / "05.ipynb"
    path.write_text("<html>not a notebook</html>")
    grade = graded(worker, path)
    assert grade.earned == 0
    assert len(grade.reports) == 5
    assert all(report.note for report in grade.reports)
