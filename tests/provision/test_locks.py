"""One list of libraries, pyproject.toml's: the locks and environment.yml say the same."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from course_pkg.provision.lock import UV
from course_pkg.provision.python import lock_file

ROOT = Path(__file__).parents[2]
PIN = re.compile(r"^([a-z0-9-]+)==([^ ;]+)(?: ; .*?)?(?: \\)?$", re.MULTILINE)


def pinned(extra: str) -> dict[str, str]:
    """Return the version of each library in a lock."""
    return dict(PIN.findall(lock_file(extra).read_text()))


def declared(heading: str) -> dict[str, str]:
    """Return what pyproject.toml pins in the list after `heading` (Python 3.10 has no TOML reader)."""
    text = (ROOT / "pyproject.toml").read_text()
    block = text[text.index(heading) :].split("]", 1)[0]
    return dict(re.findall(r'"([a-z0-9-]+)==([^"]+)"', block))


@pytest.mark.parametrize(("extra", "heading"), [("course", "\ndependencies = ["), ("test", "\ntest = [")])
def test_the_lock_is_made_from_pyproject(extra: str, heading: str) -> None:
    """Each library that pyproject.toml names is in the lock, at that version."""
    wanted = declared(heading)
    assert wanted
    assert wanted.items() <= pinned(extra).items(), "type: ./course lock"


def test_the_tests_run_with_what_students_have() -> None:
    """The lock of the tests holds every library of the course's lock, at the same version."""
    assert pinned("course").items() <= pinned("test").items()


@pytest.mark.parametrize("extra", ["course", "test", "uv"])
def test_every_file_is_known_by_its_hash_and_by_no_host(extra: str) -> None:
    """Each library has hashes, so that it may come from any mirror; no registry is named."""
    text = lock_file(extra).read_text()
    assert "://" not in text
    for block in re.split(r"\n(?=[a-z])", text.split("\n", 1)[1].strip()):
        assert "--hash=sha256:" in block, block.splitlines()[0]


def test_uv_is_the_version_that_the_code_names() -> None:
    """The lock of uv holds what `course lock` was told to pin."""
    assert pinned("uv") == dict([UV.split("==")])


def test_conda_gets_the_same_libraries() -> None:
    """environment.yml pins what pyproject.toml does, no more and no less."""
    text = (ROOT / "environment.yml").read_text()
    pins = dict(re.findall(r"^  - ([a-z0-9-]+)=([0-9][^\s]*)$", text, re.MULTILINE))
    for name in ("python", "ros-distro-mutex"):
        del pins[name]
    assert pins == declared("\ndependencies = [")
