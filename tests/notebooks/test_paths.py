"""README, the first page and the chapters contain the same learning paths, titles and times."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.site.chapters import Chapter, chapter_of
from course_pkg.site.pages import LearningPath, learning_paths

README = (Path(__file__).parents[2] / "README.md").read_text("utf-8")
CHAPTERS = [chapter_of(path.stem, read(path)) for path in NotebookStore().solutions()]
PATHS = learning_paths(CHAPTERS)
NEEDED = re.compile(r"\((\d\d)_\w+\.ipynb\)")
RANGE = re.compile(r"\[(\d\d)\]\(\w+\.ipynb\) to \[(\d\d)\]")


def needed(chapter: Chapter) -> set[str]:
    """Return the numbers of the chapters that a chapter requires."""
    sentence = chapter.need.split(". ")[0]
    ranges = RANGE.findall(sentence)
    between = {f"{number:02}" for first, last in ranges for number in range(int(first), int(last) + 1)}
    known = {each.number for each in CHAPTERS}
    return {*NEEDED.findall(sentence), *(between & known)}


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.name)
def test_a_path_needs_no_chapter_outside_it(path: LearningPath) -> None:
    """Each chapter on a learning path needs only earlier chapters on this path."""
    for choice in path.choices:
        before: set[str] = set()
        for chapter in choice.chapters:
            assert needed(chapter) <= before, chapter.full_title
            before.add(chapter.number)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.name)
def test_the_readme_has_the_path_with_its_time(path: LearningPath) -> None:
    """For each learning path, README and the first page of the site contain the same times."""
    row = next(line for line in README.splitlines() if line.startswith(f"| {path.name} |"))
    assert [choice.hours for choice in path.choices if choice.hours not in row] == []
    assert path.afterwards in row


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda chapter: chapter.number)
def test_the_readme_has_the_chapter_with_its_time(chapter: Chapter) -> None:
    """README contains the title and the time of each notebook."""
    row = next(line for line in README.splitlines() if line.startswith(f"| {chapter.number} |"))
    assert f"[{chapter.title}](notebooks/{chapter.name}.ipynb)" in row
    assert f"| {chapter.minutes} min |" in row
