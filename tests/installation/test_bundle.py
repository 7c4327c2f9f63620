"""Tests of the installer for machines without internet: the index for apt, and the install script."""

from __future__ import annotations

import hashlib
import subprocess
from pathlib import Path

import pytest

from course_pkg.errors import SetupError
from course_pkg.installation.bundle import install_script, package_index, write_bundle


def test_apt_finds_a_package_of_the_bundle(tmp_path: Path) -> None:
    """The package index of the bundle contains the package's name, file name, size and checksum."""
    control = tmp_path / "source" / "DEBIAN" / "control"
    control.parent.mkdir(parents=True)
    control.write_text(
        "Package: tiny\nVersion: 1\nArchitecture: all\nMaintainer: nobody\nDescription: for a test\n"
    )
    subprocess.run(["dpkg-deb", "--build", tmp_path / "source", tmp_path / "tiny.deb"], check=True)
    index = package_index(tmp_path)
    content = (tmp_path / "tiny.deb").read_bytes()
    assert "Package: tiny\n" in index
    assert f"Filename: ./tiny.deb\nSize: {len(content)}\n" in index
    assert f"SHA256: {hashlib.sha256(content).hexdigest()}\n" in index


def test_the_script_is_correct_shell(tmp_path: Path) -> None:
    """The install script is a valid shell script, names each package, and contains no internet address."""
    script = install_script(["python3", "g++"])
    subprocess.run(["sh", "-n"], input=script, text=True, check=True)
    assert "--no-install-recommends python3 g++\n" in script
    assert "http" not in script


def test_a_folder_with_files_is_refused(tmp_path: Path) -> None:
    """If the folder for the bundle contains files, the command writes nothing."""
    (tmp_path / "file").write_text("mine")
    with pytest.raises(SetupError, match="is not an empty folder, so nothing was written"):
        write_bundle(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
