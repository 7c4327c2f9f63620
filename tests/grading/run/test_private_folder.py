"""Tests of a private folder with wrong, empty or unused files."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import GradingError
from course_pkg.grading.run.private_folder import require_names
from tests.grading.handing_in import folder

CHAPTERS = ["05", "06"]


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ({}, "contains no file that can be used"),
        ({"README.md": b"x"}, "contains no file that can be used"),
        ({"private/private_05.py": b"x"}, "contains private, which cannot be used"),
        ({"private_05.py": b"x", "private_5.py": b"x"}, "contains private_5.py, which"),
        ({"Private_05.py": b"x"}, "contains Private_05.py, which"),
        ({"private_05.py.txt": b"x"}, "contains private_05.py.txt, which"),
        ({"private_99.py": b"x"}, "contains private_99.py, .*one of 05, 06"),
        ({"point.json": b"{}"}, "contains point.json, which"),
        ({"private_05.py": b" \n"}, "private_05.py is empty"),
        ({"private_05.py": b"x", "points.json": b""}, "points.json is empty"),
    ],
)
def test_a_wrong_folder_is_refused(tmp_path: Path, files: dict[str, bytes], said: str) -> None:
    """If a file name is wrong, the error message contains this name and the valid names."""
    with pytest.raises(GradingError, match=said):
        require_names(folder(tmp_path, files), CHAPTERS)


def test_another_file_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """If a file's name is not similar to any valid name, the program ignores the file and prints its name."""
    require_names(folder(tmp_path, {"private_05.py": b"x", "notes.md": b"", ".git/config": b""}), CHAPTERS)
    assert "notes.md" in capsys.readouterr().err
    require_names(folder(tmp_path / "a", {"points.json": b"{}"}), CHAPTERS)
    assert not capsys.readouterr().err
