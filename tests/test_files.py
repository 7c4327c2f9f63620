"""Files that are written completely or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.files import write_atomically


def test_a_failed_write_leaves_the_old_text_and_no_litter(tmp_path: Path) -> None:
    """A reader never gets a part of a file, and a failure leaves no file."""
    path = tmp_path / "file"
    write_atomically(path, "old")
    with pytest.raises(UnicodeEncodeError):
        write_atomically(path, "new \udc80")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
