"""Tests of the set-up's stamps (files that mark finished steps), digests and lock."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from course_pkg.setup.stamps import Stamps, digest, locked
from tests.support import eventually


def test_a_stamp_holds_until_it_is_cleared(tmp_path: Path) -> None:
    """After write(), the step counts as done until clear() is called."""
    stamps = Stamps(tmp_path / "done")
    assert stamps.read("step") is None
    stamps.write("step", "key")
    assert stamps.read("step") == "key"
    stamps.clear("step")
    stamps.clear("step")
    assert stamps.read("step") is None


def test_a_digest_depends_on_the_borders_of_its_parts() -> None:
    """The digests of ["ab", "c"] and ["a", "bc"] are different."""
    assert digest(["ab", "c"]) != digest(["a", "bc"])
    assert digest(["a", b"b"]) == digest([b"a", "b"])


def test_the_second_set_up_waits_for_the_lock(tmp_path: Path) -> None:
    """If two set-ups run at the same time, the second set-up waits and prints a message."""
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
