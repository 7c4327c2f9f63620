"""Stamps, digests and the lock."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from course_pkg.provision.stamps import Stamps, digest, locked, replace_text
from tests.support import eventually


def test_a_stamp_holds_until_it_is_cleared(tmp_path: Path) -> None:
    """What is not stamped, or was cleared, is not done."""
    stamps = Stamps(tmp_path / "done")
    assert stamps.read("step") is None
    stamps.write("step", "key")
    assert stamps.read("step") == "key"
    stamps.clear("step")
    stamps.clear("step")
    assert stamps.read("step") is None


def test_a_failed_write_leaves_the_old_text_and_no_litter(tmp_path: Path) -> None:
    """A reader never sees a part of a file, and a failure leaves nothing behind."""
    path = tmp_path / "file"
    replace_text(path, "old")
    with pytest.raises(UnicodeEncodeError):
        replace_text(path, "new \udc80")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_digest_tells_parts_apart() -> None:
    """Where one part ends and the next begins counts."""
    assert digest(["ab", "c"]) != digest(["a", "bc"])
    assert digest(["a", b"b"]) == digest([b"a", "b"])


def test_the_second_to_lock_says_that_it_waits_and_then_goes_on(tmp_path: Path) -> None:
    """Two set-ups at once: the second waits until the first is done."""
    waits, got = threading.Event(), threading.Event()

    def second() -> None:
        with locked(tmp_path / "lock", waits.set):
            got.set()

    with locked(tmp_path / "lock", lambda: pytest.fail("the first need not wait")):
        thread = threading.Thread(target=second)
        thread.start()
        assert waits.wait(10)
        assert not got.is_set()
    eventually(got.is_set)
    thread.join()
