"""Tests of the list of parts, and of the imports between chapters."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path

import pytest

from course_pkg import chapters
from course_pkg.checking.parts import Part, every_part, find, folder_of, folders_for, parts_of
from course_pkg.checking.parts import chapters as numbers
from course_pkg.checking.processes.client import TIMEOUT
from course_pkg.errors import UnknownCheck
from course_pkg.waiting import MOST
from tests.selection import chapter_paths

COMPILED = ("13.", "14.")  # In these chapters, a compiler runs before the check.
# These are the maximum deadlines in s, without and with a compiler. A check that compiles six programs needs
# 25 s of CPU time. A check needs more time during grading, because two submissions run on each core.
USUAL, BUILT = 60, 180


def test_an_unknown_id_gets_the_closest_ones() -> None:
    """The error message for an unknown id contains similar ids."""
    with pytest.raises(UnknownCheck, match=r"no check '5\.1'.*'05\.1'"):
        find("5.1")


def test_ids_are_unique_and_belong_to_their_chapter() -> None:
    """Each id belongs to exactly one part and is declared in the right chapter."""
    ids = [part.check for part in every_part()]
    assert len(ids) == len(set(ids))
    assert all(part.check.startswith("05.") for part in parts_of("05"))


def test_every_part_has_points_and_a_goal() -> None:
    """Each part has points, a goal, a deadline, and names that the student's code must define."""
    for part in every_part():
        assert part.points > 0
        assert part.goal.endswith(".")
        assert part.needs
        builds = part.package_files or part.check.startswith(COMPILED)
        assert 0 < part.deadline <= (BUILT if builds else USUAL)


def test_no_part_of_a_chapter_in_several_modules_is_forgotten() -> None:
    """The package of a chapter exports all parts from its modules."""
    checks = [f"{chapters.__name__}.{folder_of(number).name}.checks" for number in numbers()]
    modules = [
        importlib.import_module(found.name)
        for package in map(importlib.import_module, checks)
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    ] + [importlib.import_module(name) for name in checks]
    declared = {
        value.check for module in modules for value in vars(module).values() if isinstance(value, Part)
    }
    assert declared == {part.check for part in every_part()}
    assert len(modules) > len({part.check[:2] for part in every_part()})


def test_a_chapter_depends_on_those_that_it_imports_from() -> None:
    """Chapter 14 imports 09, and chapter 09 imports 07, so chapter 14 depends on 09 and 07."""
    needed = {number: [folder.name[2:4] for folder in folders_for(number)] for number in numbers()}
    assert needed["14"] == ["07", "09", "14"]
    assert needed["15"] == ["07", "15"]
    assert needed["05"] == ["05"]
    assert folders_for("99") == folders_for("my") == []


def test_imports_are_followed_in_each_form(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The search finds an import in a subfolder's module and inside a function."""
    texts = {
        "ch01_one": "def f():\n    from course_pkg.chapters.ch02_two.checks import g\n",
        "ch02_two": "import course_pkg.chapters.ch03_three\n# from course_pkg.chapters.ch05_five import h\n",
        "ch03_three": "from course_pkg.chapters import ch04_four\n",
        "ch04_four": "from course_pkg.chapters.ch01_one import f\nimport course_pkg.chapters.ch77_gone\n",
        "ch05_five": "",
    }
    for name, text in texts.items():
        (tmp_path / name / "checks").mkdir(parents=True)
        (tmp_path / name / "__init__.py").touch()
        (tmp_path / name / "checks" / "some.py").write_text(text)
    monkeypatch.setattr(chapters, "__path__", [str(tmp_path)])
    assert [folder.name for folder in folders_for("02")] == list(texts)[:4]
    assert [folder.name for folder in folders_for("05")] == ["ch05_five"]


def test_tests_of_a_chapter_depend_on_what_it_imports() -> None:
    """After a change of chapter 07, `course test --changed` runs the tests of chapter 14."""
    names = {Path(path).name[:4] for path in chapter_paths("14")}
    assert names == {"ch07", "ch09", "ch14", "14_d"}
    assert {Path(path).name[:4] for path in chapter_paths("05")} == {"ch05", "05_w"}
    assert set(chapter_paths("")) > set(chapter_paths("14")) | set(chapter_paths("05"))


def test_check_client_waits_longer_than_every_deadline() -> None:
    """The kernel's time limit for the result is longer than the deadline of every check."""
    assert max(part.deadline for part in every_part()) * MOST < TIMEOUT
