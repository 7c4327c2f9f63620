"""Stamps, digests and the lock."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from course_pkg.setup.stamps import Stamps, digest, locked
from tests.support import eventually


def test_a_stamp_holds_until_it_is_cleared(tmp_path: Path) -> None:
    """A step without a stamp, or with a deleted one, is not done."""
    stamps = Stamps(tmp_path / "done")
    assert stamps.read("step") is None
    stamps.write("step", "key")
    assert stamps.read("step") == "key"
    stamps.clear("step")
    stamps.clear("step")
    assert stamps.read("step") is None


def test_a_digest_tells_parts_apart() -> None:
    """The digest depends on the borders between the parts."""
    assert digest(["ab", "c"]) != digest(["a", "bc"])
    assert digest(["a", b"b"]) == digest([b"a", "b"])


def test_the_second_to_lock_says_that_it_waits_and_then_goes_on(tmp_path: Path) -> None:
    """Of two set-ups at the same time, the second waits for the first."""
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
