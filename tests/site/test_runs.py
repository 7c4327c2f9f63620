"""Notebooks are run once for what they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import AuthoringError
from course_pkg.site.runs import Runs
from tests.authoring.books import code, text
from tests.site.shelves import runs, shelf

COUNT = "from pathlib import Path\nruns = Path({!r})\nruns.write_text(runs.read_text() + 'x')"


@pytest.fixture
def counter(tmp_path: Path) -> Path:
    """A file to which every run of a chapter adds a letter."""
    path = tmp_path / "runs.txt"
    path.write_text("")
    return path


def chapter(root: Path, counter: Path, prose: str = "Some prose.", last: str = "1 + 1") -> Path:
    """Write a chapter that counts its runs, and return its path."""
    shelf(
        root,
        _00_try=[text(prose, "prose"), code(COUNT.format(str(counter)), id="count"), code(last, id="last")],
    )
    return root / "solutions" / "00_try.ipynb"


def result(kept: Runs, path: Path) -> str:
    """Return what the last cell of a chapter shows."""
    return str(kept.of(path)["cells"][-1]["outputs"][0]["data"]["text/plain"])


def test_a_chapter_runs_again_only_for_new_code(tmp_path: Path, counter: Path) -> None:
    """Prose may change without one, and is new all the same; of two runs the later one is kept."""
    kept = runs(tmp_path / "cache")
    assert result(kept, chapter(tmp_path, counter)) == "2"
    path = chapter(tmp_path, counter, prose="Other prose.")
    assert result(runs(tmp_path / "cache"), path) == "2"
    assert kept.of(path)["cells"][1]["source"] == "Other prose."
    assert counter.read_text() == "x"
    assert result(kept, chapter(tmp_path, counter, last="1 + 2")) == "3"
    assert counter.read_text() == "xx"
    assert len(list((tmp_path / "cache").rglob("*.json"))) == 1


def test_another_package_runs_it_again(tmp_path: Path, counter: Path) -> None:
    """What a panel shows is the package's work; until then the latest run is there for who asks."""
    kept, path = runs(tmp_path / "cache"), chapter(tmp_path, counter)
    kept.of(path)
    other = runs(tmp_path / "cache")
    other._shared = "another package"
    assert other.latest(path) == kept.of(path)
    assert counter.read_text() == "x"
    other.of(path)
    assert counter.read_text() == "xx"


def test_a_run_that_fails_is_not_kept(tmp_path: Path, counter: Path) -> None:
    """It is told which cell stopped it, and there is no latest run to show."""
    kept, path = runs(tmp_path / "cache"), chapter(tmp_path, counter, last="1 / 0")
    with pytest.raises(AuthoringError, match="cell last stopped the run with ZeroDivisionError"):
        kept.of(path)
    assert kept.latest(path) is None
