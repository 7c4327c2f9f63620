"""The folder that a site is written to."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest

from course_pkg.errors import SiteError
from course_pkg.site.folder import Folder


def write(path: Path, *names: str) -> None:
    """Write a site of these files."""
    with Folder(path) as folder:
        for name in names:
            folder.write(name, name)


def names(path: Path) -> set[str]:
    """Return the files in a folder, but for the list that it keeps."""
    return {str(file.relative_to(path)) for file in path.rglob("*") if file.is_file() and file.suffix} - {""}


def test_what_an_earlier_site_left_goes(tmp_path: Path) -> None:
    """A page of a chapter that is no more would still be found by the search of a stick."""
    write(tmp_path / "site", "a.html", "assets/b.js")
    write(tmp_path / "site", "a.html", "c.html")
    assert names(tmp_path / "site") == {"a.html", "c.html"}


def test_what_is_no_site_is_left_alone(tmp_path: Path) -> None:
    """A folder with other files in it is refused before anything is written."""
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(SiteError, match="holds files that are no site"):
        write(tmp_path, "a.html")
    assert names(tmp_path) == {"thesis.txt"}


def test_what_was_put_beside_a_site_stays(tmp_path: Path) -> None:
    """Only files that a site wrote are removed by a site."""
    write(tmp_path / "site", "a.html")
    (tmp_path / "site" / "own.txt").write_text("mine")
    write(tmp_path / "site", "b.html")
    assert names(tmp_path / "site") == {"b.html", "own.txt"}


def test_a_site_that_fails_half_way_removes_nothing(tmp_path: Path) -> None:
    """The pages of the one before are still there, and the next site finds them."""
    write(tmp_path / "site", "a.html", "b.html")
    with suppress(ZeroDivisionError), Folder(tmp_path / "site") as folder:
        folder.write("a.html", "new")
        raise ZeroDivisionError
    assert names(tmp_path / "site") == {"a.html", "b.html"}
    write(tmp_path / "site", "a.html")
    assert names(tmp_path / "site") == {"a.html"}


def test_a_file_in_the_way_is_named(tmp_path: Path) -> None:
    """With what to do about it."""
    (tmp_path / "file").write_text("")
    with pytest.raises(SiteError, match="Name another with --out"):
        write(tmp_path / "file", "a.html")
