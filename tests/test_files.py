"""Tests of `write_atomically`, which either writes a whole file or does not change the file."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.files import write_atomically


def test_a_failed_write_does_not_change_the_file(tmp_path: Path) -> None:
    """After a failed write, the file has its old text."""
    path = tmp_path / "file"
    write_atomically(path, "old")
    with pytest.raises(UnicodeEncodeError):
        write_atomically(path, "new \udc80")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
