"""Tests of the zip from `course autograder`."""

from __future__ import annotations

import json
import subprocess
import zipfile
from pathlib import Path

import pytest

from course_pkg.errors import HandoutError
from course_pkg.handout.autograder.bundle import Options, write_autograder


def test_the_zip_contains_the_scripts_and_the_course(tmp_path: Path) -> None:
    """The zip contains the executable scripts and the course, but no answers, tests or notebooks."""
    private = tmp_path / "private"
    private.mkdir()
    (private / "points.json").write_text('{"05.1": 4}', "utf-8")
    out = tmp_path / "autograder.zip"
    assert write_autograder(Options(out, ("05",), private=private, minutes=20)) == 0
    with zipfile.ZipFile(out) as archive:
        names = set(archive.namelist())
        settings = json.loads(archive.read("settings.json"))
        for name in ("setup.sh", "run_autograder", "course/course"):
            assert archive.getinfo(name).external_attr >> 16 & 0o111
        for name in ("setup.sh", "run_autograder"):
            subprocess.run(["sh", "-n"], input=archive.read(name), check=True)
    assert settings["chapters"] == ["05"]
    assert settings["minutes"] == 20
    assert {"private/points.json", "course/solutions/05_write_a_server.ipynb", "course/package.xml"} <= names
    assert not [
        name for name in names if "/answers" in name or name.startswith(("course/tests", "course/notebooks"))
    ]


@pytest.mark.parametrize(("out", "minutes"), [("autograder.tar", 9.0), ("autograder.zip", 0.0)])
def test_wrong_options_write_nothing(tmp_path: Path, out: str, minutes: float) -> None:
    """A wrong file extension or time limit is an error."""
    with pytest.raises(HandoutError):
        write_autograder(Options(tmp_path / out, ("05",), minutes=minutes))
    assert not list(tmp_path.iterdir())
