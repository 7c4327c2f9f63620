"""Tests of the chapter list and the learning paths."""

from __future__ import annotations

import pytest

from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.site.chapters import Chapter, chapter_of, hours
from course_pkg.site.pages import learning_paths
from tests.authoring.books import book, exercise, text


def chapter(minutes: int) -> Chapter:
    """Return a chapter that takes the given number of minutes."""
    return Chapter("05_x", "X", "", "", "", minutes, ())


def test_a_chapter_is_read_from_its_notebook() -> None:
    """The chapter has the title, the introduction, the requirements and the points of its notebook."""
    first = "# Ask\n\nWho waits?\n\n**You will** ask.\nTwice.\n\n**You need** time.\n\n**Time**: 45 minutes."
    found = chapter_of("05_ask", book(text(first), exercise("05.1", 2), exercise("05.2", 3)))
    assert found == Chapter("05_ask", "Ask", "Who waits?", "ask.\nTwice.", "time.", 45, (2, 3))
    assert (found.number, found.page, found.full_title) == ("05", "05_ask.html", "05 Ask")


def test_an_empty_chapter_has_its_name_as_title() -> None:
    """If a chapter is empty, its title is the name of its file."""
    assert chapter_of("05_ask", book()).title == "05_ask"


@pytest.mark.parametrize("path", NotebookStore().solutions(), ids=lambda path: path.stem)
def test_the_information_of_every_chapter_is_complete(path: object) -> None:
    """Each chapter has an introduction, goals, requirements, a time and points."""
    found = chapter_of("00_x", read(path))  # type: ignore[arg-type]
    assert all((found.lead, found.will, found.need, found.minutes, found.points))


@pytest.mark.parametrize(
    ("minutes", "words"), [(45, "45 minutes"), (120, "2 hours"), (75, "1 hour and 15 minutes")]
)
def test_times_add_up(minutes: int, words: str) -> None:
    """If a sum of times is one hour or more, it is shown in hours and minutes."""
    assert hours([chapter(minutes)]) == words


def test_a_path_has_all_its_chapters_and_its_total_time() -> None:
    """The time of a path is the sum of the times of its chapters."""
    known = [chapter_of(path.stem, read(path)) for path in NotebookStore().solutions()]
    lab, turtles, whole = learning_paths(known)
    assert [each.number for each in lab.choices[0].chapters] == ["00", "05", "06", "07"]
    assert lab.choices[0].hours == hours(lab.choices[0].chapters)
    assert turtles.choices[0].chapters[-1].number == "09"
    assert len(turtles.choices) == 2
    assert list(whole.choices[0].chapters) == known
