"""The input for all kinds of flags: all students' answers to one chapter, and the course's own code."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import code_cells, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.grading.grade import Flag, Package, Submission
from course_pkg.grading.plan import Plan
from course_pkg.grading.rebuild.wanted import written_path

ENDINGS = (".py", ".cpp", ".cc", ".h", ".hpp")  # Only files with these endings are read from a package.
LARGEST = 100_000  # A file with more characters than this is not read.


@dataclass(frozen=True)
class Answer:
    """The code of one exercise cell, or one file of a package."""

    where: str  # `where` is the part, such as "05.1", or the path of the file below src.
    source: str = field(repr=False)

    @cached_property
    def path(self) -> str:
        """The path of the file that contains the answer, or that the answer's cell writes.

        The path is "" if there is no file.
        """
        return written_path(self.source) if self.where[:1].isdigit() else self.where

    @property
    def name(self) -> str:
        """The path of the answer's file, or the id of the part if there is no file.

        The name is the same in both cases: a cell writes the file, or a package contains the file.
        """
        return self.path.removeprefix("src/") or self.where


@dataclass(frozen=True)
class Work:
    """The work that one student handed in for one chapter."""

    student: str
    origin: str
    answers: tuple[Answer, ...]


@dataclass(frozen=True)
class Group:
    """The work of all students on one chapter."""

    chapter: str
    works: tuple[Work, ...]
    solution: Mapping[str, Answer]  # The course's own answers; the keys are the names of the answers.
    # `blanks` contains the unchanged exercise cells that students get; the keys are the same as in
    # `solution`.
    blanks: Mapping[str, str]
    shown: tuple[str, ...]  # The code of all cells of the chapter's notebook that are not exercises.

    def answers(self) -> Iterator[tuple[Work, Answer]]:
        """Yield each answer with the work that contains it."""
        for work in self.works:
            for answer in work.answers:
                yield work, answer


Found = tuple[Work, Flag]  # The function `find` of each kind of flag yields such tuples.


def group_of(chapter: str, submissions: Sequence[Submission], plan: Plan) -> Group:
    """Return the answers in these submissions; all of them are for the chapter `chapter`."""
    notebook = read(NotebookStore().solutions([chapter])[0])
    cells = code_cells(notebook)
    parts = {part: cell["source"] for cell in cells if (part := exercise_of(cell))}
    solution = {part: Answer(part, source) for part, source in parts.items()}
    return Group(
        chapter,
        tuple(_work(submission, plan) for submission in submissions),
        {answer.name: answer for answer in solution.values()},
        {answer.name: handed_out(part, answer.source) for part, answer in solution.items()},
        tuple(cell["source"] for cell in cells if not exercise_of(cell)),
    )


def _work(submission: Submission, plan: Plan) -> Work:
    answers = [answer for package in submission.packages for answer in _files(package)]
    if submission.content and not submission.problem:
        rebuilt = plan.rebuilder.rebuild(submission.content)
        in_packages = {answer.name for answer in answers}
        cells = [Answer(part, source) for part, source in rebuilt.answers.items()]
        answers += [
            cell for cell in cells if cell.where not in rebuilt.untouched and cell.name not in in_packages
        ]
    return Work(submission.student, submission.origin, tuple(answers))


def _files(package: Package) -> Iterator[Answer]:
    for file in package.files:
        text = _text(file.data)
        first = text.partition("\n")[0]
        if file.path.endswith(ENDINGS) or (first.startswith("#!") and "python" in first):
            yield Answer(f"{package.name}/{file.path}", text)


def _text(content: bytes) -> str:
    text = content.decode("utf-8", "replace").replace("\r\n", "\n")
    return text if len(text) <= LARGEST else ""
