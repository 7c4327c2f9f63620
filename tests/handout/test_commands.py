"""Tests of the command lines of `course release` and `course collect`."""

from __future__ import annotations

import pytest

from course_pkg.cli import parse


def test_chapters_have_two_digits() -> None:
    """`course release` and `course collect` accept `--chapters 5, 6` for the chapters 05 and 06."""
    assert parse(["release", "out", "--chapters", "5, 6"]).chapters == ("05", "06")
    assert parse(["collect", "ros-course", "out", "--chapters", "5"]).chapters == ("05",)


def test_a_path_and_chapters_exclude_each_other(capsys: pytest.CaptureFixture[str]) -> None:
    """`--path` and `--chapters` cannot be used together."""
    with pytest.raises(SystemExit):
        parse(["release", "out", "--chapters", "05", "--path", "The lab session"])
    assert "not allowed with argument" in capsys.readouterr().err
