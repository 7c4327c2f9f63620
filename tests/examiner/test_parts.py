"""Parts are found by their ids."""

from __future__ import annotations

import pytest

from course_pkg.errors import UnknownCheck
from course_pkg.examiner.parts import every_part, find, parts_of


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
        assert 0 < part.deadline <= 60
