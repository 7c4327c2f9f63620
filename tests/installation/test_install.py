"""Tests of `course install` and `course uninstall`: the prefix, the versions and the links.

Only a slow test runs the build.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from course_pkg.errors import SetupError
from course_pkg.installation import install as installing
from course_pkg.installation.install import install
from course_pkg.installation.prefix import Prefix, users_of
from course_pkg.installation.uninstall import uninstall
from course_pkg.installed import RECORD
from tests.installation.installations import ROOT


@pytest.fixture
def prefix(tmp_path: Path) -> Prefix:
    """Return an installation folder (the prefix) in which version "1" is the current version."""
    made = Prefix(tmp_path / "prefix", tmp_path / "bin")
    made.claim()
    made.switch(_version(made, "1"))
    return made


def _version(prefix: Prefix, name: str) -> Path:
    folder = prefix.versions / name
    (folder / "course").mkdir(parents=True)
    program = folder / "course" / "course"
    program.write_text(f"#!/bin/sh\necho {name}\n")
    program.chmod(0o755)
    (folder / RECORD).write_text("{}")
    return folder


def test_an_upgrade_keeps_a_version_that_is_in_use(prefix: Prefix) -> None:
    """After an upgrade, the command `course` runs the new version.

    The installer removes an old version as soon as no process uses it.
    """
    old, new = prefix.versions / "1", _version(prefix, "2")
    command = prefix.bin / "course"
    assert subprocess.check_output([command], text=True) == "1\n"
    with subprocess.Popen(["sleep", "60"], env={"PYTHONPATH": f"{old}/course", "PATH": os.defpath}) as lab:
        prefix.switch(new)
        assert subprocess.check_output([command], text=True) == "2\n"
        assert list(users_of(old)) == [lab.pid]
        assert prefix.remove_unused({new}) == [old]
        lab.kill()
    assert prefix.remove_unused({new}) == []
    assert prefix.complete() == [new]


def test_an_uninstall_removes_what_the_installation_made(prefix: Prefix) -> None:
    """Even without the option --bin, uninstall() finds and removes the links to the command `course`.

    uninstall() does not remove files of other programs.
    """
    (prefix.bin / "other").touch()
    assert uninstall(prefix.path, force=False) == 0
    left = [path.name for path in prefix.path.parent.rglob("*") if path.is_symlink() or not path.is_dir()]
    assert left == ["other"]
    assert not prefix.path.exists()


def test_an_uninstall_waits_for_the_users(prefix: Prefix) -> None:
    """While a user works, `course uninstall` removes no files."""
    environment = {"PYTHONPATH": f"{prefix.versions / '1'}/course", "PATH": os.defpath}
    with subprocess.Popen(["sleep", "60"], env=environment) as lab:
        with pytest.raises(SetupError, match=f"processes {lab.pid}"):
            uninstall(prefix.path, force=False)
        lab.kill()
    assert (prefix.bin / "course").exists()


def test_unfit_prefixes_are_refused(tmp_path: Path) -> None:
    """If the prefix is unsuitable, the installer prints one message and changes nothing.

    A prefix is unsuitable if its path contains a space, or if the folder contains files or a command of
    another program.
    """
    (tmp_path / "foreign").mkdir()
    (tmp_path / "foreign" / "file").touch()
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "course").touch()
    before = sorted(tmp_path.rglob("*"))
    for prefix, bin_folder, message in (
        ("two words", "empty", "contains a space. Give --prefix a folder without spaces"),
        ("foreign", "empty", "`course install` did not make it, so nothing was changed"),
        ("new", "bin", "does not belong to this installation, so nothing was changed"),
    ):
        with pytest.raises(SetupError, match=message):
            install(tmp_path / prefix, tmp_path / bin_folder)
    with pytest.raises(SetupError, match="contains no installation"):
        uninstall(tmp_path / "foreign", force=False)
    assert sorted(tmp_path.rglob("*")) == before


def test_a_full_disk_leaves_the_current_version(
    prefix: Prefix, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """If the disk is full, the installer removes the new version, and `course` still starts the old one."""
    edition = tmp_path / "edition"
    edition.mkdir()
    for name in ("package.xml", "course"):
        (edition / name).write_bytes((ROOT / name).read_bytes())
    (edition / ".course-release.json").write_text('{"files": ["package.xml", "course"]}')

    def fail(_places: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(installing, "ensure", fail)
    monkeypatch.setattr(installing.Places, "of", lambda: installing.Places(edition, tmp_path / "cache"))
    with pytest.raises(SetupError, match=r"The disk of .*prefix is full"):
        install(prefix.path, None)
    assert prefix.complete() == [prefix.versions / "1"]
    assert subprocess.check_output([prefix.bin / "course"], text=True) == "1\n"
    assert not list(prefix.versions.glob("*/course/package.xml"))


def test_bash_completes_commands_and_options() -> None:
    """The script for bash completion is generated from the table of commands."""
    script = subprocess.check_output([ROOT / "course", "completion"], text=True)
    words = 'COMP_WORDS=(course {}); COMP_CWORD={}; _course; echo "${{COMPREPLY[@]}}"'
    for typed, number, expected in (("unins", 1, "uninstall"), ("install --pre", 2, "--prefix")):
        done = subprocess.check_output(["bash", "-c", script + words.format(typed, number)], text=True)
        assert done.split() == [expected]
