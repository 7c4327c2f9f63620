"""Tests of the whole site without a browser."""

from __future__ import annotations

import re
import statistics
import subprocess
import sys
from contextlib import suppress
from gzip import compress
from pathlib import Path

import pytest

from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.errors import SiteError
from course_pkg.site.build import Folder, Settings, write_site
from course_pkg.site.check import faults
from tests.authoring.books import code, exercise, text
from tests.site.notebook_stores import runs, store


def test_the_course_has_no_fault(course: Path) -> None:
    """`faults` finds no fault in the course's site."""
    assert faults(course) == []


def test_every_chapter_has_a_page_and_a_notebook_to_download(course: Path) -> None:
    """Each chapter has a page, a notebook to download, and links to the previous and next chapter."""
    for path in NotebookStore().solutions():
        page = (course / f"{path.stem}.html").read_text("utf-8")
        assert f'href="notebooks/{path.name}" download' in page
        assert (course / "notebooks" / path.name).read_bytes() == path.read_bytes()
        assert ('rel="prev"' in page) == (path != NotebookStore().solutions()[0])
        assert ('rel="next"' in page) == (path != NotebookStore().solutions()[-1])


def test_pages_are_small(course: Path, panels: Path) -> None:
    """The files that all pages share have at most 170 kB (compressed).

    A page with all panels has at most 60 kB. Without pictures, half of the chapters' pages have at most 60
    kB.
    """
    loaded = [path for path in (course / "assets").iterdir() if path.suffix in (".js", ".css")]
    shared = sum(len(compress(path.read_bytes())) for path in loaded if path.name != "texts.js")
    assert shared <= 170_000
    pages = [path.read_text("utf-8") for path in course.glob("[0-9]*.html")]
    assert statistics.median(len(re.sub(r'src="data:[^"]*"', "", page)) for page in pages) <= 60_000
    assert (panels / "00_panels.html").stat().st_size <= 60_000


def test_a_chapter_that_fails_does_not_stop_the_other_chapters(tmp_path: Path) -> None:
    """The build reports a chapter that fails, and the chapter's page shows the stored outputs."""
    chapters = {"_00_good": [code("1 + 1")], "_01_bad": [text("Some prose."), code("1 / 0", id="boom")]}
    troubles = write_site(Settings(tmp_path / "site"), store(tmp_path, **chapters), runs(tmp_path / "cache"))
    assert troubles == [
        "01_bad: The run failed: 01_bad: the run stopped at cell boom: ZeroDivisionError: division by zero"
    ]
    assert '<pre class="out">2</pre>' in (tmp_path / "site" / "00_good.html").read_text("utf-8")
    bad = (tmp_path / "site" / "01_bad.html").read_text("utf-8")
    assert "This page shows stored outputs." in bad
    assert "Some prose." in bad


def test_a_students_site_contains_no_answer(tmp_path: Path) -> None:
    """The pages, the search texts and the notebooks contain no answers."""
    books = store(tmp_path, _05_ask=[exercise("05.1", source="def secret_answer():\n    return 42")])
    given = tmp_path / "notebooks" / "05_ask.ipynb"
    given.write_text(given.read_text("utf-8").replace("return 42", "..."), "utf-8")
    write_site(Settings(tmp_path / "site", student=True, execute=False), books, runs(tmp_path / "cache"))
    written = [path for path in (tmp_path / "site").rglob("*") if path.is_file()]
    assert [path for path in written if b"return 42" in path.read_bytes()] == []
    assert [path.name for path in written if b"secret_answer" in path.read_bytes()] != []


def test_a_page_links_to_binder_if_its_address_is_given(tmp_path: Path) -> None:
    """The page has a link to Binder only if Binder's address is given."""
    books = store(tmp_path, _05_ask=[])
    for address in ("", "https://binder.example/v2/gh/a/b/main"):
        write_site(
            Settings(tmp_path / "site", execute=False, binder=address), books, runs(tmp_path / "cache")
        )
        page = (tmp_path / "site" / "05_ask.html").read_text("utf-8")
        assert ("Open in Binder" in page) == bool(address)
    assert f'href="{address}?labpath=notebooks%2F05_ask.ipynb"' in page


def test_the_same_course_makes_the_same_site(tmp_path: Path) -> None:
    """Two builds of the same course write the same bytes."""
    books, kept = store(tmp_path, _05_ask=[code("1")]), runs(tmp_path / "cache")
    for name in ("one", "two"):
        write_site(Settings(tmp_path / name, execute=False), books, kept)
    one, two = (
        {str(path.relative_to(tmp_path / name)): path.read_bytes() for path in (tmp_path / name).rglob("*.*")}
        for name in ("one", "two")
    )
    assert one == two


@pytest.mark.timeout(300)
def test_the_command_writes_checks_and_prints(tmp_path: Path) -> None:
    """The command `course site` prints the paths of the book and of the start page."""
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
    if "has no Chromium" in result.stderr:
        pytest.skip("no Chromium on this machine")
    book, index = result.stdout.split()
    assert Path(book).read_bytes()[:5] == b"%PDF-"
    assert index == str(tmp_path / "index.html")


def write(path: Path, *names: str) -> None:
    """Write a site that consists of files with the given names."""
    with Folder(path) as folder:
        for name in names:
            folder.write(name, name)


def names(path: Path) -> set[str]:
    """Return the paths of all files of the site, except the list of files."""
    return {str(file.relative_to(path)) for file in path.rglob("*") if file.is_file() and file.suffix} - {""}


def test_old_files_of_an_earlier_site_are_removed(tmp_path: Path) -> None:
    """A new site removes the page of a deleted chapter."""
    write(tmp_path / "site", "a.html", "assets/b.js")
    write(tmp_path / "site", "a.html", "c.html")
    assert names(tmp_path / "site") == {"a.html", "c.html"}


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    """The builder refuses a folder that contains other files, and does not change this folder."""
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(SiteError, match="contains files that do not belong to a site"):
        write(tmp_path, "a.html")
    assert names(tmp_path) == {"thesis.txt"}


def test_a_file_that_a_user_added_to_a_site_stays(tmp_path: Path) -> None:
    """A new site does not remove a file that a user has added."""
    write(tmp_path / "site", "a.html")
    (tmp_path / "site" / "own.txt").write_text("mine")
    write(tmp_path / "site", "b.html")
    assert names(tmp_path / "site") == {"b.html", "own.txt"}


def test_a_site_that_fails_half_way_removes_nothing(tmp_path: Path) -> None:
    """After a failed build, the previous pages still exist."""
    write(tmp_path / "site", "a.html", "b.html")
    with suppress(ZeroDivisionError), Folder(tmp_path / "site") as folder:
        folder.write("a.html", "new")
        raise ZeroDivisionError
    assert names(tmp_path / "site") == {"a.html", "b.html"}
    write(tmp_path / "site", "a.html")
    assert names(tmp_path / "site") == {"a.html"}


def test_a_file_in_place_of_the_folder_is_refused(tmp_path: Path) -> None:
    """If --out is a file, the error message contains the option --out."""
    (tmp_path / "file").write_text("")
    with pytest.raises(SiteError, match="Give another folder with --out"):
        write(tmp_path / "file", "a.html")
