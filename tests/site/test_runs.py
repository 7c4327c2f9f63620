"""Tests that a chapter runs again after a change of its code or of the package."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Notebook
from course_pkg.site.runs import Runs
from tests.authoring.books import code, text
from tests.site.notebook_stores import runs, store

COUNT = "from pathlib import Path\nruns = Path({!r})\nruns.write_text(runs.read_text() + 'x')"


@pytest.fixture
def counter(tmp_path: Path) -> Path:
    """Return an empty file, to which each run of a chapter adds a letter."""
    path = tmp_path / "runs.txt"
    path.write_text("")
    return path


def chapter(root: Path, counter: Path, prose: str = "Some prose.", last: str = "1 + 1") -> Path:
    """Write a chapter that adds a letter to the file `counter` in each run, and return its path."""
    store(
        root,
        _00_try=[text(prose, "prose"), code(COUNT.format(str(counter)), id="count"), code(last, id="last")],
    )
    return root / "solutions" / "00_try.ipynb"


def executed(kept: Runs, path: Path) -> Notebook:
    """Run a chapter if its last run is out of date, and return the last run."""
    assert kept.update([path]) == {}
    notebook = kept.latest(path)
    assert notebook is not None
    return notebook


def result(kept: Runs, path: Path) -> str:
    """Return the output of a chapter's last cell."""
    return str(executed(kept, path)["cells"][-1]["outputs"][0]["data"]["text/plain"])


def test_a_chapter_runs_again_only_for_new_code(tmp_path: Path, counter: Path) -> None:
    """If only prose changes, the chapter does not run again; if code changes, it runs again."""
    kept = runs(tmp_path / "cache")
    assert result(kept, chapter(tmp_path, counter)) == "2"
    path = chapter(tmp_path, counter, prose="Other prose.")
    assert result(runs(tmp_path / "cache"), path) == "2"
    assert executed(kept, path)["cells"][1]["source"] == "Other prose."
    assert counter.read_text() == "x"
    assert result(kept, chapter(tmp_path, counter, last="1 + 2")) == "3"
    assert counter.read_text() == "xx"
    assert len(list((tmp_path / "cache").rglob("*.json"))) == 1


def test_a_chapter_runs_again_after_a_change_of_the_package(tmp_path: Path, counter: Path) -> None:
    """If the package has changed, latest() returns the old run until update() runs the chapter again."""
    kept, path = runs(tmp_path / "cache"), chapter(tmp_path, counter)
    executed(kept, path)
    other = runs(tmp_path / "cache")
    other._shared = "another package"
    assert other.latest(path) == executed(kept, path)
    assert counter.read_text() == "x"
    executed(other, path)
    assert counter.read_text() == "xx"


def test_a_chapter_runs_again_after_a_change_of_a_chapter_that_it_imports(
    tmp_path: Path, counter: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If a file is added to a folder on which a chapter depends, the next update runs the chapter again."""
    imported = tmp_path / "imported"
    imported.mkdir()
    monkeypatch.setattr("course_pkg.site.runs.folders_for", lambda number: [imported][: number == "00"])
    kept, path = runs(tmp_path / "cache"), chapter(tmp_path, counter)
    executed(kept, path)
    (imported / "checks.py").write_text("")
    executed(kept, path)
    assert counter.read_text() == "xx"


def test_a_run_that_fails_is_not_kept(tmp_path: Path, counter: Path) -> None:
    """The error message for a failed run contains the failed cell, and `latest` returns None."""
    kept, path = runs(tmp_path / "cache"), chapter(tmp_path, counter, last="1 / 0")
    errors = kept.update([path])
    assert "the run stopped at cell last: ZeroDivisionError" in str(errors[path])
    assert kept.latest(path) is None


def test_chapters_run_at_the_same_time_in_separate_folders(tmp_path: Path) -> None:
    """Two chapters run at the same time in separate folders."""
    meet = (
        "import time, pathlib, os, tempfile\n"
        f"mine, other = [pathlib.Path({str(tmp_path)!r}, name) for name in NAMES]\n"
        "mine.touch()\n"
        "deadline = time.monotonic() + 60\n"
        "while not other.exists() and time.monotonic() < deadline:\n    time.sleep(0.01)\n"
        "assert other.exists()\n"
        "[os.getcwd(), tempfile.gettempdir(), os.environ['COURSE_STATE'], os.environ['ROS_LOG_DIR'],"
        " os.environ.get('ROS_MASTER_URI')]"
    )
    cells = {
        name: [code(meet.replace("NAMES", repr(names)))]
        for name, names in (("_00_one", ("a", "b")), ("_01_two", ("b", "a")))
    }
    paths = store(tmp_path, **cells).solutions()
    kept = runs(tmp_path / "cache")
    assert kept.update(paths) == {}
    seen = [set(ast.literal_eval(result(kept, path))) for path in paths]
    assert len(seen[0]) == len(seen[1]) == 5
    assert seen[0] & seen[1] == {None}
