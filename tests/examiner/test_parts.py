"""Parts are found by their ids."""

from __future__ import annotations

import importlib
import pkgutil

import pytest

from course_pkg.errors import UnknownCheck
from course_pkg.examiner import checks
from course_pkg.examiner.parts import Part, every_part, find, parts_of

COMPILED = "11."  # a compiler runs before the check begins, on a machine that may be busy


def test_an_unknown_id_gets_the_closest_ones() -> None:
    """A typing slip is answered with what was probably meant."""
    with pytest.raises(UnknownCheck, match=r"no check '5\.1'.*'05\.1'"):
        find("5.1")


def test_ids_are_unique_and_belong_to_their_chapter() -> None:
    """An id names one part, and its chapter is where it is declared."""
    ids = [part.check for part in every_part()]
    assert len(ids) == len(set(ids))
    assert all(part.check.startswith("05.") for part in parts_of("05"))


def test_every_part_says_what_it_is_worth() -> None:
    """Points, a goal of one sentence, what it needs, and a deadline that a student would wait for."""
    for part in every_part():
        assert part.points > 0
        assert part.goal.endswith(".")
        assert part.needs
        assert 0 < part.deadline <= (120 if part.check.startswith(COMPILED) else 60)


def test_no_part_of_a_chapter_in_several_modules_is_forgotten() -> None:
    """A chapter may be a package: it names every part that one of its modules declares."""
    modules = [
        importlib.import_module(found.name)
        for found in pkgutil.walk_packages(checks.__path__, f"{checks.__name__}.")
    ]
    declared = {
        value.check for module in modules for value in vars(module).values() if isinstance(value, Part)
    }
    assert declared == {part.check for part in every_part()}
    assert len(modules) > len({part.check[:2] for part in every_part()})
