"""Tests of whole runs of `course grade`."""

from __future__ import annotations

import csv
import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from course_pkg.grading.run.summary import NEED_A_LOOK
from course_pkg.ros.process.supervisor import descendants
from course_pkg.setup import Places
from tests.grading.roster.worksheets import ENGLISH
from tests.grading.submitted import WRONG, hand_in
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("sandbox")
TOTAL = "earned"
COURSE = Places.of().checkout / "course"


@pytest.fixture(scope="module")
def submissions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write four submissions: a right one, a wrong one, a copy of the right one, and a damaged file."""
    folder = tmp_path_factory.mktemp("submissions")
    hand_in(folder, "s01")
    hand_in(folder, "s02", answers={"05.1": WRONG})
    hand_in(folder, "s03")
    bad = folder / "s04" / "05_write_a_server.ipynb"
    bad.parent.mkdir()
    bad.write_text("{")
    return folder


def grade(submissions: Path, out: Path, *words: str | Path) -> subprocess.CompletedProcess[str]:
    """Run the command, and wait until it exits."""
    command = [COURSE, "grade", submissions, "--out", out, "--validate", "none", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=200, check=False)


def points(out: Path) -> dict[str, float]:
    """Return the sum of each student's points in grades.csv."""
    with (out / "grades.csv").open(encoding="utf-8-sig", newline="") as file:
        return {row["student"]: float(row[TOTAL]) for row in csv.DictReader(file)}


@pytest.fixture(scope="module")
def undisturbed(submissions: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Grade all submissions, and return the report folder."""
    out = tmp_path_factory.mktemp("grades")
    done = grade(submissions, out)
    assert done.returncode == NEED_A_LOOK, done.stderr
    assert done.stdout.splitlines()[-1] == "3 graded, 1 needs a look"
    assert not {"s01", "s02", "s03", "s04"} & set(done.stderr.replace(",", " ").split())
    return out


def test_students_get_the_right_points(undisturbed: Path) -> None:
    """Each student gets the expected points."""
    earned = points(undisturbed)
    assert earned["s01"] == earned["s03"] > earned["s02"] > earned["s04"] == 0
    record = json.loads((undisturbed / "results" / "s04" / "05.json").read_text())
    assert record["problem"]


def test_every_report_is_there(undisturbed: Path) -> None:
    """The run writes files for spreadsheets, platforms, students and the instructor."""
    names = {str(path.relative_to(undisturbed)) for path in undisturbed.rglob("*") if path.is_file()}
    assert {
        "grades.csv",
        "canvas.csv",
        "moodle.csv",
        "class.html",
        "junit.xml",
        "feedback/s01.html",
        "gradescope/s01/results.json",
        "results/s01/05.json",
    } <= names


def test_second_run_uses_the_stored_grades(submissions: Path, undisturbed: Path) -> None:
    """A second run of the same command uses the grades of the first run."""
    before = points(undisturbed)
    done = grade(submissions, undisturbed)
    assert "The grades of 4 of 4 notebooks come from an earlier run" in done.stderr
    assert points(undisturbed) == before


@pytest.mark.slow
@pytest.mark.parametrize("after", [1.5, 4.0])
def test_a_run_that_was_killed_goes_on(
    submissions: Path, undisturbed: Path, tmp_path: Path, after: float
) -> None:
    """After SIGKILL no process remains, and the next run gives the same grades."""
    with subprocess.Popen(
        [COURSE, "grade", submissions, "--out", tmp_path, "--validate", "none"], stderr=subprocess.DEVNULL
    ) as process:
        deadline = time.monotonic() + after
        eventually(lambda: time.monotonic() > deadline or process.poll() is not None, timeout=60)
        family = descendants(process.pid)
        process.send_signal(signal.SIGKILL)
    eventually(lambda: not any(os.path.exists(f"/proc/{pid}/exe") for pid in family), timeout=20)
    assert grade(submissions, tmp_path).returncode == NEED_A_LOOK
    assert points(tmp_path) == points(undisturbed)


@pytest.mark.slow
@pytest.mark.timeout(240)
def test_a_cluster_gives_the_same_grades(submissions: Path, undisturbed: Path, tmp_path: Path) -> None:
    """Dask workers in separate processes give the same grades."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        done = grade(submissions, tmp_path, "--scheduler", cluster.scheduler_address)
    assert done.returncode == NEED_A_LOOK, done.stderr
    assert points(tmp_path) == points(undisturbed)


def test_private_parts_count_and_are_not_shown(submissions: Path, tmp_path: Path) -> None:
    """The points of private checks count, but the students' pages do not show these checks."""
    private = tmp_path / "private"
    private.mkdir()
    (private / "private_05.py").write_text("""
from course_pkg.checking import CheckContext, part

@part("05.1.1", points=3, goal="A secret goal.", needs=["handle_geometry"])
def flat(context: CheckContext) -> None:
    response = context.service("/getGeometry", "course_pkg/geometry")(length=2.0, width=3.0, height=0.0)
    context.expect("a secret rule", expected=[6.0, 0.0], actual=[response.area, response.volume], near=1e-3)
""")
    (private / "points.json").write_text('{"05.2": 0, "05.1": 5}')
    out = tmp_path / "out"
    done = grade(submissions, out, "--private", str(private), "--fresh")
    assert done.returncode == NEED_A_LOOK, done.stderr
    record = json.loads((out / "results" / "s01" / "05.json").read_text())
    earned = {report["check"]: report["points"] for report in record["reports"]}
    assert (earned["05.1"], earned["05.1.1"], earned["05.2"]) == (5, 3, 0)
    lost = json.loads((out / "results" / "s02" / "05.json").read_text())
    assert "secret" in json.dumps(lost)
    shown = (out / "feedback" / "s02.html").read_text() + (
        out / "gradescope" / "s02" / "results.json"
    ).read_text()
    assert "secret" not in shown
    assert "secret" not in (out / "moodle.csv").read_text(encoding="utf-8-sig")


def test_without_walls_every_report_says_so(submissions: Path, tmp_path: Path) -> None:
    """With --unsafe-no-sandbox, each report contains a warning."""
    done = grade(submissions, tmp_path, "--unsafe-no-sandbox")
    assert done.returncode == NEED_A_LOOK, done.stderr
    assert points(tmp_path)["s01"] > points(tmp_path)["s02"]
    for name in ("feedback/s01.html", "class.html"):
        assert "without a sandbox" in (tmp_path / name).read_text()


def test_a_roster_and_a_worksheet(submissions: Path, undisturbed: Path, tmp_path: Path) -> None:
    """The terminal lists missing students, and the copy of the worksheet contains the grade."""
    out = tmp_path / "out"
    shutil.copytree(undisturbed, out)
    roster, sheet = tmp_path / "roster.csv", tmp_path / "sheet.csv"
    roster.write_text("username,email,name\ns01,jane@uni.example,Jane Doe\ns05,,Late Riser\n")
    sheet.write_text(ENGLISH)
    done = grade(submissions, out, "--roster", roster, "--moodle-worksheet", sheet)
    assert done.returncode == NEED_A_LOOK, done.stderr
    assert "Roster: 1 of 2 students handed in their work." in done.stdout
    assert "1 handed in nothing: Late Riser." in done.stdout
    assert "3 are not on the roster: s02; s03; s04." in done.stdout
    assert "1 of 4 participants have a grade in moodle_worksheet.csv" in done.stdout
    first, *_ = list(csv.DictReader((out / "moodle_worksheet.csv").read_text("utf-8-sig").splitlines(True)))
    assert (first["Full name"], first["Grade"]) == ("Jane Doe", "100")


def test_one_notebook_into_one_file(submissions: Path, tmp_path: Path) -> None:
    """`course grade-one` writes only the given file."""
    notebook = submissions / "s02" / "05_write_a_server.ipynb"
    out = tmp_path / "grade.json"
    subprocess.run(
        [COURSE, "grade-one", notebook, "--out", out], check=True, timeout=200, capture_output=True
    )
    record = json.loads(out.read_text())
    assert [report["verdict"] for report in record["reports"]].count("passed") == 4
    assert os.listdir(tmp_path) == ["grade.json"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["/nowhere"], "nowhere"),
        (["{here}", "--chapters", "99"], "99"),
        (["{here}", "--late", "late.csv"], "--late needs a policy"),
        (["{here}", "--late-per-day", "much"], "--late-per-day"),
        (["{here}", "--private", "/nowhere"], "not a folder"),
        (["{here}", "--roster", "/nowhere.csv"], "The roster nowhere.csv cannot be read"),
        (
            ["{here}", "--moodle-worksheet", "/nowhere.csv"],
            "The grading worksheet nowhere.csv cannot be read",
        ),
        (["{here}", "--out", "/proc/here"], "--out"),
        (["{here}", "--scheduler", "tcp://127.0.0.1:1"], "scheduler"),
    ],
)
def test_wrong_options_lead_to_one_message(
    submissions: Path, tmp_path: Path, words: list[str], said: str
) -> None:
    """If the options are wrong, the error message has no traceback and says what to do next."""
    given = [word.format(here=submissions) for word in words]
    command = [COURSE, "grade", *given, *([] if "--out" in given else ["--out", tmp_path / "out"])]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode != 0
    assert said in done.stderr
    assert "Traceback" not in done.stderr
