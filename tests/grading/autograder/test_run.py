"""`course autograde` writes results.json in a folder with Gradescope's layout."""

from __future__ import annotations

import json
import os
import textwrap
from pathlib import Path

import pytest

from course_pkg.grading.autograder.run import OUT_OF_TIME, autograde
from course_pkg.grading.autograder.settings import Settings, days_late
from course_pkg.types.fields import Plain
from tests.grading.handing_in import NAMES, folder, handed_out, raw, zipped
from tests.grading.submitted import WRONG, hand_in
from tests.support import usual

VISIBLE = {"hidden", "after_due_date", "after_published", "visible"}
NOBODY = {
    "a file with another name": ("homework.txt", b"my answers"),
    "a damaged notebook": (NAMES["05"], b"{"),
}


def graded(root: Path, files: dict[str, bytes], **settings: float | tuple[str, ...]) -> dict[str, Plain]:
    """Create Gradescope's folders with a submission, run the grader, and return the grader's results."""
    known = Settings(**{"chapters": ("05",), "minutes": 5.0, **settings})  # type: ignore[arg-type]
    folder(root, {"source/settings.json": known.as_json().encode()})
    (root / "submission").mkdir(exist_ok=True)
    folder(root / "submission", files)
    assert autograde(root) == 0
    results: dict[str, Plain] = json.loads((root / "results" / "results.json").read_text("utf-8"))
    return results


def blank(chapter: str = "05") -> bytes:
    """Return the students' notebook of a chapter."""
    return raw(handed_out(chapter))


def test_without_a_notebook_each_part_is_listed_without_points(tmp_path: Path) -> None:
    """Without a notebook, the output contains the name of the missing file, and each part has 0 points."""
    results = graded(tmp_path, {})
    assert results["score"] == 0
    assert f"{NAMES['05']} was not handed in." in str(results["output"])
    tests = results["tests"]
    assert isinstance(tests, list)
    assert tests
    for test in tests:
        assert isinstance(test, dict)
        assert test["score"] == 0 < int(str(test["max_score"]))
        assert test["status"] in ("passed", "failed")
        assert test["visibility"] in VISIBLE
    assert results["stdout_visibility"] in VISIBLE


@pytest.mark.parametrize("case", NOBODY)
def test_a_file_that_cannot_be_graded_has_a_message(tmp_path: Path, case: str) -> None:
    """If the submitted file is not a notebook, the output contains the file's name."""
    name, content = NOBODY[case]
    results = graded(tmp_path, {name: content})
    assert results["score"] == 0
    assert name in str(results["output"])


def test_a_notebook_of_another_chapter_has_a_message(tmp_path: Path) -> None:
    """A notebook of another chapter is not graded, and the message contains both chapters."""
    output = str(graded(tmp_path, {NAMES["06"]: blank("06")})["output"])
    assert f"{NAMES['06']} belongs to chapter 06" in output
    assert NAMES["05"] in output


def test_a_zip_inside_the_submission_has_a_message(tmp_path: Path) -> None:
    """A zip file inside the submission is not opened, and the results contain a message."""
    inside = zipped(tmp_path / "work.zip", {NAMES["05"]: blank()}).read_bytes()
    assert "archive" in str(graded(tmp_path / "root", {"work.zip": inside})["output"])


def test_links_and_pipes_are_not_read(tmp_path: Path) -> None:
    """The program refuses links in a submission, and a named pipe does not block the run."""
    (tmp_path / "submission").mkdir()
    (tmp_path / "secret.ipynb").write_bytes(blank())
    (tmp_path / "submission" / NAMES["05"]).symlink_to(tmp_path / "secret.ipynb")
    os.mkfifo(tmp_path / "submission" / "pipe.ipynb")
    assert "link" in str(graded(tmp_path, {})["output"])


def test_two_notebooks_of_two_chapters_are_both_graded(tmp_path: Path) -> None:
    """If a submission contains notebooks of two chapters, the results contain both chapters."""
    results = graded(tmp_path, {NAMES["05"]: blank(), NAMES["06"]: blank("06")}, chapters=("05", "06"))
    tests = results["tests"]
    assert isinstance(tests, list)
    assert {str(test["number"])[:2] for test in tests if isinstance(test, dict)} == {"05", "06"}
    assert "was not handed in" not in str(results["output"])


def test_broken_settings_still_give_results(tmp_path: Path) -> None:
    """If settings.json is damaged, the results contain a message and no points."""
    folder(tmp_path, {"source/settings.json": b"{"})
    assert autograde(tmp_path) == 0
    results = json.loads((tmp_path / "results" / "results.json").read_text("utf-8"))
    assert results["score"] == 0
    assert "damaged" in results["output"]


def test_the_time_limit_ends_the_run_with_results(tmp_path: Path) -> None:
    """After the time limit, the remaining parts get no points, and their output contains OUT_OF_TIME."""
    work = hand_in(tmp_path / "work", "mia", answers={"05.1": WRONG}).read_bytes()
    results = graded(tmp_path / "root", {NAMES["05"]: work}, minutes=0.0)
    assert results["score"] == 0
    assert OUT_OF_TIME in str(results["tests"])


@pytest.mark.usefixtures("sandbox")
def test_an_answer_earns_points_and_is_late(tmp_path: Path) -> None:
    """A right answer that is one day late gets fewer points."""
    answers = dict.fromkeys([f"05.{number}" for number in range(2, 9)], "")
    work = hand_in(tmp_path / "work", "mia", answers=answers).read_bytes()
    metadata = {
        "created_at": "2026-11-02T12:00:00.5-07:00",
        "users": [{"name": "Mia", "assignment": {"due_date": "2026-11-01T23:59:00-07:00"}}],
        "assignment": {"due_date": "2026-10-01T23:59:00-07:00"},
    }
    root = folder(tmp_path / "root", {"submission_metadata.json": json.dumps(metadata).encode()})
    late = days_late(root / "submission_metadata.json")
    assert late is not None
    assert 0.5 < late < 0.51
    assert graded(root, {NAMES["05"]: work}, late_per_day=50.0)["score"] == 1.0


NOT_EXAMINED = {
    "a reply that asks for a restart": """
        import course_pkg.checking.kernel.agent as agent
        original = agent.KernelAgent.reply
        agent.KernelAgent.reply = lambda *both: {**original(*both), "older": "Restart the kernel."}
    """,
    "no master": """
        import os, xmlrpc.client
        xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).shutdown("/chapter_05", "because")
    """,
    "a process that has ended": "import os; os._exit(0)",
}


@pytest.mark.usefixtures("sandbox")
@pytest.mark.parametrize("attack", usual(1, NOT_EXAMINED))
def test_an_answer_that_prevents_its_check_has_failed(tmp_path: Path, attack: str) -> None:
    """If an answer stops its check, the part earns no points, but the maximum of the part does not change."""
    answers = dict.fromkeys([f"05.{number}" for number in range(2, 9)], "")
    answers["05.1"] = textwrap.dedent(attack) + WRONG
    work = hand_in(tmp_path / "work", "mia", answers=answers).read_bytes()
    results = graded(tmp_path / "root", {NAMES["05"]: work})
    tests = results["tests"]
    assert isinstance(tests, list)
    (found,) = [each for each in tests if isinstance(each, dict) and each["number"] == "05.1"]
    assert results["score"] == 0
    assert (found["score"], found["max_score"], found["status"]) == (0, 2, "failed")
    assert "There are no points" in str(found["output"])
    assert "not examined" not in str(found["output"])
