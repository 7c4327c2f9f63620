"""The site as a whole, without a browser."""

from __future__ import annotations

import statistics
import subprocess
import sys
from gzip import compress
from pathlib import Path

import pytest

from course_pkg.authoring.shelf import Shelf
from course_pkg.site.build import write_site
from course_pkg.site.check import faults
from course_pkg.site.settings import Settings
from tests.authoring.books import code, exercise, text
from tests.site.shelves import runs, shelf


def test_the_course_has_no_fault(course: Path) -> None:
    """Every link leads somewhere, every figure has words."""
    assert faults(course) == []


def test_every_chapter_has_a_page_and_can_be_taken_along(course: Path) -> None:
    """The page, the notebook beside it, and the ways from one to the next."""
    for path in Shelf().solutions():
        page = (course / f"{path.stem}.html").read_text("utf-8")
        assert f'href="notebooks/{path.name}" download' in page
        assert (course / "notebooks" / path.name).read_bytes() == path.read_bytes()
        assert ('rel="prev"' in page) == (path != Shelf().solutions()[0])
        assert ('rel="next"' in page) == (path != Shelf().solutions()[-1])


def test_pages_are_light(course: Path, panels: Path) -> None:
    """What pages share is at most 170 KB over the wire; what is a page's own, 60 KB as it lies there."""
    loaded = [path for path in (course / "assets").iterdir() if path.suffix in (".js", ".css")]
    shared = sum(len(compress(path.read_bytes())) for path in loaded if path.name != "texts.js")
    assert shared <= 170_000
    chapters = [path.stat().st_size for path in course.glob("[0-9]*.html")]
    assert statistics.median(chapters) <= 60_000
    assert (panels / "00_panels.html").stat().st_size <= 60_000


def test_a_chapter_that_fails_takes_no_other_along(tmp_path: Path) -> None:
    """It is said, its page shows what was stored and says so, and the others are as they ran."""
    chapters = {"_00_good": [code("1 + 1")], "_01_bad": [text("Some prose."), code("1 / 0", id="boom")]}
    troubles = write_site(Settings(tmp_path / "site"), shelf(tmp_path, **chapters), runs(tmp_path / "cache"))
    assert troubles == [
        "01_bad: The run failed: 01_bad: cell boom stopped the run with ZeroDivisionError: division by zero"
    ]
    assert '<pre class="out">2</pre>' in (tmp_path / "site" / "00_good.html").read_text("utf-8")
    bad = (tmp_path / "site" / "01_bad.html").read_text("utf-8")
    assert "This page shows what was stored." in bad
    assert "Some prose." in bad


def test_a_students_site_holds_no_answer(tmp_path: Path) -> None:
    """Neither the pages, nor the search, nor the notebook that can be taken along."""
    books = shelf(tmp_path, _05_ask=[exercise("05.1", source="def secret_answer():\n    return 42")])
    given = tmp_path / "notebooks" / "05_ask.ipynb"
    given.write_text(given.read_text("utf-8").replace("return 42", "..."), "utf-8")
    write_site(Settings(tmp_path / "site", student=True, execute=False), books, runs(tmp_path / "cache"))
    written = [path for path in (tmp_path / "site").rglob("*") if path.is_file()]
    assert [path for path in written if b"return 42" in path.read_bytes()] == []
    assert [path.name for path in written if b"secret_answer" in path.read_bytes()] != []


def test_binder_is_offered_where_its_address_is_known(tmp_path: Path) -> None:
    """And opens the notebook that students get; otherwise there is no link."""
    books = shelf(tmp_path, _05_ask=[])
    for address in ("", "https://binder.example/v2/gh/a/b/main"):
        write_site(
            Settings(tmp_path / "site", execute=False, binder=address), books, runs(tmp_path / "cache")
        )
        page = (tmp_path / "site" / "05_ask.html").read_text("utf-8")
        assert ("Open in Binder" in page) == bool(address)
    assert f'href="{address}?labpath=notebooks%2F05_ask.ipynb"' in page


def test_the_same_course_makes_the_same_site(tmp_path: Path) -> None:
    """To the byte, so that a site can be kept under version control."""
    books, kept = shelf(tmp_path, _05_ask=[code("1")]), runs(tmp_path / "cache")
    for name in ("one", "two"):
        write_site(Settings(tmp_path / name, execute=False), books, kept)
    one, two = (
        {str(path.relative_to(tmp_path / name)): path.read_bytes() for path in (tmp_path / name).rglob("*.*")}
        for name in ("one", "two")
    )
    assert one == two


@pytest.mark.timeout(300)
def test_the_command_writes_checks_and_prints(tmp_path: Path) -> None:
    """It says where the page is that a reader opens, and where the book is."""
    command = [
        sys.executable,
        "-m",
        "course_pkg.cli",
        "site",
        "--stored",
        "--check",
        "--pdf",
        "--out",
        str(tmp_path),
    ]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if "No Chromium" in result.stderr:
        pytest.skip("no Chromium on this machine")
    book, index = result.stdout.split()
    assert Path(book).read_bytes()[:5] == b"%PDF-"
    assert index == str(tmp_path / "index.html")
