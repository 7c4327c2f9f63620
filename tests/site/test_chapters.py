"""What the syllabus says of a chapter."""

from __future__ import annotations

import pytest

from course_pkg.authoring.shelf import Shelf, read
from course_pkg.site.chapters import Chapter, chapter_of, hours
from tests.authoring.books import book, exercise, text


def chapter(minutes: int) -> Chapter:
    """Return a chapter that takes so long."""
    return Chapter("05_x", "X", "", "", "", minutes, ())


def test_a_chapter_says_what_it_is_about() -> None:
    """Title, lead, the three labels, and the points of its exercises."""
    first = "# Ask\n\nWho waits?\n\n**You will** ask.\nTwice.\n\n**You need** time.\n\n**Time**: 45 minutes."
    found = chapter_of("05_ask", book(text(first), exercise("05.1", 2), exercise("05.2", 3)))
    assert found == Chapter("05_ask", "Ask", "Who waits?", "ask.\nTwice.", "time.", 45, (2, 3))
    assert (found.number, found.page, found.full_title) == ("05", "05_ask.html", "05 Ask")


def test_a_chapter_that_says_nothing_has_its_name() -> None:
    """As has one without a cell."""
    assert chapter_of("05_ask", book()).title == "05_ask"


@pytest.mark.parametrize("path", Shelf().solutions(), ids=lambda path: path.stem)
def test_every_chapter_says_all(path: object) -> None:
    """The landing page has no gap."""
    found = chapter_of("00_x", read(path))  # type: ignore[arg-type]
    assert all((found.lead, found.will, found.need, found.minutes, found.points))


@pytest.mark.parametrize(
    ("minutes", "words"), [(45, "45 minutes"), (120, "2 hours"), (75, "1 hour and 15 minutes")]
)
def test_times_add_up(minutes: int, words: str) -> None:
    """In hours, where it is one at least."""
    assert hours([chapter(minutes)]) == words
