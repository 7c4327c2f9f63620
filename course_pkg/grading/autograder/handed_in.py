"""A student's work: a submission for each chapter, and messages about files that are not graded."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from course_pkg.checking.parts import notebook_of
from course_pkg.grading import clean
from course_pkg.grading.grade import Submission
from course_pkg.grading.intake.submissions import submissions

# The submission is copied to a folder with this name. Gradescope already knows the student's name, so the
# folder's name does not contain it.
STUDENT = "student"


def handed_in(folder: Path, chapters: Sequence[str]) -> tuple[list[Submission], list[str]]:
    """Return a submission for each of these chapters, and messages about files that are not graded."""
    with tempfile.TemporaryDirectory(prefix="course-autograder-") as copied:
        if folder.is_dir():
            shutil.copytree(folder, Path(copied, STUDENT), symlinks=True, ignore=_special)
        found = [each for each in submissions(Path(copied)) if not each.nothing]
    by_chapter = {each.chapter: each for each in found if each.chapter in chapters}
    expected = ", ".join(map(notebook_of, chapters))
    messages = [each.problem for each in found if not each.chapter]
    messages += [
        f"{clean.line(each.origin.rpartition('/')[2], 120)} belongs to chapter {each.chapter}, which is not "
        f"part of this assignment."
        for each in found
        if each.chapter and each.chapter not in chapters
    ]
    if not by_chapter:
        messages.append(
            f"There is no notebook to grade. Hand in {expected}. The autograder does not open "
            "a zip file that is inside another zip file."
        )
    return [by_chapter.get(chapter, _missing(chapter)) for chapter in chapters], messages


def _missing(chapter: str) -> Submission:
    problem = f"{notebook_of(chapter)} was not handed in."
    return Submission(STUDENT, chapter, b"", "", problem=problem)


def _special(folder: str, names: Sequence[str]) -> list[str]:
    """Return the names of pipes, sockets and devices in this folder, because reading them could block."""
    paths = [Path(folder, name) for name in names]
    return [path.name for path in paths if not (path.is_symlink() or path.is_file() or path.is_dir())]
