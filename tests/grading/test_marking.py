"""What a submission earns: all that its answers deserve, part by part, and a reason for what is missing."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.authoring.cells import code_cells
from course_pkg.errors import WardFailed
from course_pkg.examiner.report import Verdict
from course_pkg.grading.extras import Extras
from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.marking import mark
from course_pkg.grading.plan import plan
from course_pkg.grading.store import Store
from course_pkg.grading.ward.job import PartJob, PartOutcome
from course_pkg.grading.wards import Ward
from tests.grading.submitted import WRONG, hand_in

pytestmark = pytest.mark.usefixtures("walls")


@pytest.fixture(scope="module")
def ward() -> Iterator[Ward]:
    """One ward for all."""
    with Ward() as behind_walls:
        yield behind_walls


def graded(ward: Ward, path: Path, chapter: str = "05") -> Grade:
    """Return the grade of the notebook at `path`."""
    submission = Submission("s01", chapter, path.read_bytes(), path.name)
    return mark(submission, plan(chapter), Extras(), ward.run, "secret", "key", walls=True)


@pytest.mark.parametrize("chapter", ["00", "01", "02", "03", "04", "05", "06", "07", "08"])
@pytest.mark.timeout(300)
def test_the_solution_earns_full_marks(ward: Ward, tmp_path: Path, chapter: str) -> None:
    """The reference itself, as a submission, behind all walls: every part passes."""
    grade = graded(ward, hand_in(tmp_path, "s01", chapter), chapter)
    assert {report.check: report.verdict for report in grade.reports} == {
        each.part.check: Verdict.PASSED for each in plan(chapter).parts
    }
    assert grade.earned == grade.possible > 0


def test_each_part_is_credited_by_itself(ward: Ward, tmp_path: Path) -> None:
    """One wrong answer, one that ends its process and one that is left blank cost their own points alone."""
    answers = {"05.1": WRONG, "05.2": "import os; os._exit(1)", "05.3": ""}
    grade = graded(ward, hand_in(tmp_path, "s01", answers=answers))
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
    assert "came to an end" in ended.note
    assert "handed out" in blank.note


def test_a_ward_that_is_lost_costs_nobody_else_anything(ward: Ward, tmp_path: Path) -> None:
    """The part is not examined, says so, and is not kept: the next run of the command tries again."""

    def run(job: PartJob) -> PartOutcome:
        if job.check == "05.2":
            raise WardFailed("it came to an end")
        return ward.run(job)

    submission = Submission("s01", "05", hand_in(tmp_path, "s01").read_bytes(), "05.ipynb")
    grade = mark(submission, plan("05"), Extras(), run, "secret", "key", walls=True)
    verdicts = [report.verdict for report in grade.reports]
    assert verdicts == [Verdict.PASSED, Verdict.UNDECIDED, *[Verdict.PASSED] * 3]
    store = Store(tmp_path)
    store.keep(grade)
    assert store.find("key", submission) is None
    store.keep(graded(ward, hand_in(tmp_path, "s02")))
    assert store.find("key", submission) is not None


def test_what_a_cell_raised_is_said(ward: Ward, tmp_path: Path) -> None:
    """A cell that fails is told to the student with its error."""
    grade = graded(
        ward, hand_in(tmp_path, "s01", answers={"05.1": "def handle_geometry(request:\n    pass\n"})
    )
    assert "SyntaxError" in grade.reports[0].note


def test_an_answer_may_use_what_the_notebook_has_above(ward: Ward, tmp_path: Path) -> None:
    """A function from an earlier answer, and an import of the reference, are there for a later one."""
    first = (
        "import math\n\ndef product(*sides):\n    return math.prod(sides)\n\n\n"
        "def handle_geometry(request):\n    area = product(request.width, request.length)\n"
        "    return geometryResponse(area, product(area, request.height))\n"
    )
    later = (
        "def handle_checked_geometry(request):\n"
        "    for name in ('length', 'width', 'height'):\n"
        "        if getattr(request, name) < 0:\n"
        "            raise rospy.ServiceException(f'{name} is {getattr(request, name):g}')\n"
        "    area = product(request.width, request.length)\n"
        "    return geometryResponse(area, product(area, request.height))\n"
    )
    grade = graded(ward, hand_in(tmp_path, "s01", answers={"05.1": first, "05.3": later}))
    assert [report.verdict for report in grade.reports[:3]] == [Verdict.PASSED] * 3


def test_a_notebook_without_a_cell_is_graded_as_far_as_it_goes(ward: Ward, tmp_path: Path) -> None:
    """A deleted exercise costs its own points, and says so."""
    path = hand_in(tmp_path, "s01")
    notebook = json.loads(path.read_text())
    gone = next(cell for cell in code_cells(notebook) if "def handle_checked" in cell["source"])
    notebook["cells"].remove(gone)
    path.write_text(json.dumps(notebook))
    grade = graded(ward, path)
    assert grade.earned == grade.possible - grade.reports[2].possible
    assert grade.reports[2].verdict is Verdict.NOT_ATTEMPTED
    assert grade.reports[2].note


def test_what_is_no_notebook_earns_nothing_and_says_why(ward: Ward, tmp_path: Path) -> None:
    """Every part is in the grade, with the reason."""
    path = tmp_path / "05.ipynb"
    path.write_text("<html>not a notebook</html>")
    grade = graded(ward, path)
    assert grade.earned == 0
    assert len(grade.reports) == 5
    assert all(report.note for report in grade.reports)
