"""Tests of grades for submissions that contain a package."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.checking.fixtures import around
from course_pkg.checking.report import Report, Verdict
from course_pkg.grading.extras import Extras
from course_pkg.grading.grade import Grade
from course_pkg.grading.intake.packages import NO_NOTEBOOK
from course_pkg.grading.intake.submissions import submissions
from course_pkg.grading.marking import key_of, mark
from course_pkg.grading.plan import Plan, plan
from course_pkg.sandbox.job import PartJob, PartResult, work_file
from course_pkg.sandbox.worker_client import SandboxWorker
from tests.grading.packages import NO_SERVER, SERVER, my_geometry, work_files, write_package
from tests.grading.submitted import hand_in
from tests.support import usual

# These parts examine the package my_geometry.
MINE = ("07.1", "07.2", "07.3", "07.4", "07.5", "07.6", "07.7")


@pytest.fixture(scope="module")
def seven() -> Plan:
    """Return the plan for grading chapter 07."""
    return plan("07")


@pytest.fixture(scope="module")
def worker(sandbox: None) -> Iterator[SandboxWorker]:
    """Run one sandbox worker, which all tests of this module use."""
    with SandboxWorker() as started:
        yield started


class Jobs:
    """Replaces a sandbox worker; stores each job, and returns a pass for the job."""

    def __init__(self) -> None:
        self.given: dict[str, PartJob] = {}

    def __call__(self, job: PartJob) -> PartResult:
        """Store the job."""
        self.given[job.check] = job
        return PartResult(Report(job.check, Verdict.PASSED, "", 1, 1).as_dict(), "")


def graded(root: Path, planned: Plan, run: Jobs | SandboxWorker) -> Grade:
    """Return the grade of the only submission in a folder."""
    [submission] = submissions(root)
    work = run.run if isinstance(run, SandboxWorker) else run
    return mark(submission, planned, work, "secret", "key", sandboxed=True)


def verdicts(grade: Grade) -> dict[str, Verdict]:
    """Return the verdict of each part."""
    return {report.check: report.verdict for report in grade.reports}


def test_package_is_examined_instead_of_the_cells(tmp_path: Path, seven: Plan) -> None:
    """If the files of a part are in the package, the part's cells do not run."""
    hand_in(tmp_path, "s01", "07", answers={"07.4": "import os; os._exit(1)"})
    write_package(tmp_path, "s01/my_geometry", my_geometry())
    jobs = Jobs()
    grade = graded(tmp_path, seven, jobs)
    assert set(verdicts(grade).values()) == {Verdict.PASSED}
    assert [check for check, job in jobs.given.items() if not job.answers] == list(MINE)
    paths = {file.path for file in jobs.given["07.4"].files}
    assert paths == {f"src/my_geometry/{path}" for path in my_geometry()}
    assert jobs.given["07.9"].files == ()
    assert grade.notes[0] == (
        f"The checks of these parts examine the packages, not the cells of the notebook: {', '.join(MINE)}."
    )


def test_a_file_that_is_not_in_the_package(tmp_path: Path, seven: Plan) -> None:
    """If a file is missing in the package, the program runs the cell that writes this file."""
    files = {path: content for path, content in my_geometry().items() if path not in ("README.md", SERVER)}
    hand_in(tmp_path, "s01", "07", answers={"07.7": ""})
    write_package(tmp_path, "s01/my_geometry", files)
    jobs = Jobs()
    grade = graded(tmp_path, seven, jobs)
    assert jobs.given["07.4"].answers[-1].startswith("%%writefile")
    assert {file.path for file in jobs.given["07.4"].files} == {f"src/my_geometry/{path}" for path in files}
    readme = next(report for report in grade.reports if report.check == "07.7")
    assert readme.verdict is Verdict.NOT_ATTEMPTED
    assert "my_geometry in this submission has no README.md" in readme.note


def test_a_package_and_no_notebook(tmp_path: Path, seven: Plan) -> None:
    """Without a notebook, the program examines only the parts that need the package."""
    write_package(tmp_path, "s01/my_geometry", my_geometry())
    grade = graded(tmp_path, seven, Jobs())
    assert [check for check, each in verdicts(grade).items() if each is Verdict.PASSED] == list(MINE)
    assert grade.problem == ""
    assert {report.note for report in grade.reports if report.check not in MINE} == {NO_NOTEBOOK}


def test_a_notebook_that_cannot_be_read(tmp_path: Path, seven: Plan) -> None:
    """If the program cannot read the notebook, the program nevertheless examines the package."""
    hand_in(tmp_path, "s01", "07").write_text("{")
    write_package(tmp_path, "s01/my_geometry", my_geometry())
    grade = graded(tmp_path, seven, Jobs())
    assert [check for check, each in verdicts(grade).items() if each is Verdict.PASSED] == list(MINE)
    assert "not JSON" in grade.notes[-1]


def test_a_grade_belongs_to_one_state_of_the_package(tmp_path: Path) -> None:
    """If a file of the package is removed or loses a permission, the grade is stored with another key."""
    package = write_package(tmp_path, "s01/my_geometry", my_geometry())
    keys = set()
    for change in (lambda: None, lambda: (package / SERVER).chmod(0o644), (package / "README.md").unlink):
        change()
        keys.add(key_of(submissions(tmp_path)[0], Extras(), "none", sandboxed=True))
    assert len(keys) == 3


@pytest.mark.parametrize("path", ["../x", "/x", "a/../../x", "a//x", "./x", "", "a/" * 300 + "x"])
def test_a_path_that_leads_out_is_not_written(tmp_path: Path, path: str) -> None:
    """If the path of a file leads out of the folder, the program does not write this file."""
    with pytest.raises(ValueError, match="is not the path of a file"):
        work_file(path, b"x").write(tmp_path / "work")
    assert os.listdir(tmp_path) == []


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_the_solution_as_a_package_earns_full_marks(
    tmp_path: Path, seven: Plan, worker: SandboxWorker
) -> None:
    """A package with the solution gets all points."""
    write_package(tmp_path / "right", "s01/my_geometry", my_geometry())
    right = graded(tmp_path / "right", seven, worker)
    assert [report.check for report in right.reports if report.verdict is Verdict.PASSED] == list(MINE), right


def only_part(planned: Plan, check: str) -> Plan:
    """Return a plan that contains only one part."""
    return Plan(
        planned.chapter, planned.rebuilder, tuple(each for each in planned.parts if each.part.check == check)
    )


def test_a_wrong_server_in_a_package_loses_points(tmp_path: Path, seven: Plan, worker: SandboxWorker) -> None:
    """If the server in a package is wrong, the part that examines the server fails."""
    write_package(tmp_path, "s01/my_geometry", my_geometry({SERVER: NO_SERVER}))
    [report] = graded(tmp_path, only_part(seven, "07.4"), worker).reports
    assert report.verdict is Verdict.FAILED, report


def test_a_script_that_is_not_executable(tmp_path: Path, seven: Plan, worker: SandboxWorker) -> None:
    """If a script is not executable, its part fails."""
    package = write_package(tmp_path, "s01/my_geometry", my_geometry())
    (package / SERVER).chmod(0o644)
    [report] = graded(tmp_path, only_part(seven, "07.4"), worker).reports
    assert "the script is executable" in [each.text for each in report.assertions if not each.holds]


CPP = {
    "package.xml": """<package format="2"><name>boxes</name><version>1.0.0</version>
<description>Boxes.</description><maintainer email="you@example.com">You</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend><depend>roscpp</depend><depend>std_srvs</depend></package>
""",
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.0.2)
project(boxes)
find_package(catkin REQUIRED COMPONENTS roscpp std_srvs)
catkin_package()
add_executable(counter src/counter.cpp)
target_include_directories(counter PRIVATE ${catkin_INCLUDE_DIRS})
target_link_libraries(counter ${catkin_LIBRARIES})
""",
    "src/counter.cpp": """#include <ros/ros.h>
#include <std_srvs/Trigger.h>
int calls = 0;
bool count(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = true;
  response.message = std::to_string(++calls);
  return true;
}
int main(int argc, char** argv) {
  ros::init(argc, argv, "counter");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("count", count);
  ros::spin();
}
""",
}
PRIVATE = """
import time

from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.catkin_package import Package, built

@part("07.4.1", points=3, goal="Count calls.", needs=["file:src/boxes/src/counter.cpp"], deadline=170.0)
def counter(context: CheckContext) -> None:
    package = built(context, Package("boxes", {}), examined="src/counter.cpp", within=150.0)
    space = f"/{context.random.word()}"
    with package.start(f"rosrun boxes counter __ns:={space}"):
        deadline = time.monotonic() + 30.0
        while context.look().service(f"{space}/count") is None and time.monotonic() < deadline:
            time.sleep(0.1)
        count = context.service(f"{space}/count", "std_srvs/Trigger")
        for number in ("1", "2"):
            context.expect("it counts", expected=number, actual=count().message)
"""


@pytest.mark.timeout(300)
@pytest.mark.parametrize(("calls", "earned"), usual(1, {"++calls": ("++calls", 3), "calls": ("calls", 0)}))
def test_a_program_in_cpp(tmp_path: Path, sandbox: None, calls: str, earned: int) -> None:
    """A C++ program is compiled and run in the sandbox."""
    (tmp_path / "private_07.py").write_text(PRIVATE)
    tmp_path.chmod(0o755)
    files = {path: text.replace("++calls", calls).encode() for path, text in CPP.items()}
    before, after = around("07.4")
    job = PartJob("07.4.1", before, (), after, 1, 170.0, files=work_files(files, "boxes"))
    with SandboxWorker(private=str(tmp_path)) as worker:
        report = worker.run(job).report
    assert report is not None
    assert report.points == earned, report
