"""What was handed in, as submissions: one a chapter and student, and one for whatever is unusable."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

from course_pkg.authoring.shelf import Shelf
from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import Submission
from course_pkg.grading.handed_in import Entry, leads_out, one_file, opened
from course_pkg.grading.naming import (
    METADATA,
    NOTEBOOK,
    Claim,
    claims,
    gradescope_submitters,
    unwrapped,
    wrapping,
)
from course_pkg.grading.reading import read_cells, slimmed
from course_pkg.grading.references import References

LATE = "Canvas marks it as late. By how many days, only the table of late days can say."
SHOWN = 3  # names of files that a sentence lists


@dataclass(frozen=True)
class _Found:
    """A submission, and what decides between two for one chapter."""

    submission: Submission
    attempt: int
    modified: float

    @property
    def rank(self) -> tuple[bool, int, float, str]:
        return not self.submission.problem, self.attempt, self.modified, self.submission.origin


def submissions(source: Path, chapters: Sequence[str] = (), root: Path | None = None) -> list[Submission]:
    """Return what was handed in for `chapters`, or for all of them, in the order of students and chapters.

    `source` is a folder `<student>/NN_topic.ipynb`, a zip of it, what a platform offers for download (see
    naming.py), or one notebook; `root` is the checkout with the solutions. Whatever cannot be used is a
    submission with a `problem`; GradingError is raised only when `source` can be neither listed nor opened.
    """
    if source.is_file() and NOTEBOOK.fullmatch(source.name):
        return [submission_of(source, root=root)]
    Shelf(root).solutions(chapters)  # which knows no other chapters, and says so
    references = References(root)
    with opened(source) as entries:
        archive = "" if source.is_dir() else source.stem
        found = [each for entry in _unwrapped(entries, archive) for each in _found(*entry, references)]
    wanted = [each for each in found if not chapters or each.submission.chapter in ("", *chapters)]
    return sorted(_decided(wanted), key=lambda each: (each.student, each.chapter, each.origin))


def submission_of(path: Path, student: str = "", root: Path | None = None) -> Submission:
    """Return the submission in one notebook; the student's name is that of its folder unless it is given."""
    entry, name = one_file(path), path.resolve().parent.name
    claim = replace(claims([name, path.name], {})[0], student=clean.identity(student or name))
    return _taken(entry, claim, References(root)).submission


def _unwrapped(entries: Sequence[Entry], archive: str) -> Iterator[tuple[Entry, list[Claim]]]:
    """Yield each file with whose it is, the folders around all of them left away."""
    outer = wrapping([entry.parts for entry in entries if not leads_out(entry.path)], archive)
    paths = [unwrapped(_inside(entry), outer) for entry in entries]
    submitters: dict[str, list[str]] = {}
    listed = [entry for entry, path in zip(entries, paths, strict=True) if path == (METADATA,)]
    for entry in listed:  # none that lies in a student's own folder
        with suppress(GradingError):
            submitters |= gradescope_submitters(entry.read())
    for entry, path in zip(entries, paths, strict=True):
        if entry not in listed or not submitters:
            yield entry, claims(path or ("?",), submitters)


def _inside(entry: Entry) -> tuple[str, ...]:
    """Return the folders and the name of a file; of a path that leads out, what might tell whose it is."""
    if not leads_out(entry.path):
        return entry.parts
    return tuple(part for part in entry.parts if part.strip("./\\") and ":" not in part)


def _found(entry: Entry, owners: Sequence[Claim], references: References) -> Iterator[_Found]:
    for owner in owners:
        yield _taken(entry, owner, references)


def _taken(entry: Entry, owner: Claim, references: References) -> _Found:
    """Read one file; say in its problem what is wrong, where it is, and what to do."""
    name = clean.line(entry.path.rpartition("/")[2] or "the archive", 120)
    blank = Submission(owner.student, "", b"", clean.line(entry.path, 500))
    try:
        made = _read(entry, owner, references, blank)
    except GradingError as error:
        chapter = references.by_name(owner.stem) if owner.stem else ""
        chapter = chapter if owner.student and chapter in references.chapters else ""
        made = replace(blank, chapter=chapter, problem=f"{name} was not graded: {error}.")
    if not owner.student and not made.problem:
        why = "nothing tells whose it is; put it into a folder named for the student"
        made = replace(made, chapter="", content=b"", problem=f"{name} was not graded: {why}.")
    return _Found(made, owner.attempt, entry.modified)


def _read(entry: Entry, owner: Claim, references: References, blank: Submission) -> Submission:
    if not owner.stem:
        _refuse_other(entry)
    cells = read_cells(entry.read())
    named = references.by_name(owner.stem)
    chapter = references.by_cells(cells, named) or named
    if chapter not in references.chapters:
        known = ", ".join(references.chapters)
        raise GradingError(
            f"there is no chapter {chapter}, only {known}; name the file for its chapter"
            if chapter
            else "neither its name nor its cells tell which chapter it is; name it as NN_topic.ipynb"
        )
    notes = [LATE] if owner.marked_late else []
    if named and named != chapter:
        notes.append(f"The file's name says chapter {named}, its cells are those of chapter {chapter}.")
    return replace(blank, chapter=chapter, content=slimmed(cells), notes=tuple(notes))


def _refuse_other(entry: Entry) -> None:
    """Say what else a file is; a path that leads out, or a link, is told as such."""
    if entry.path.endswith(METADATA):
        raise GradingError("it does not say who handed in what; have Gradescope export it once more")
    ending = entry.path.rpartition(".")[2].lower()
    if ending in ("zip", "gz", "7z", "rar", "tar", "tgz"):
        raise GradingError("it is an archive within the submissions; put the notebook in it in its place")
    raise GradingError(
        "it is no notebook, and only notebooks are graded; if answers are in it, the .ipynb is needed"
    )


def _decided(found: Sequence[_Found]) -> Iterator[Submission]:
    """Yield one submission a chapter and student, the last one handed in; the others stand in its notes."""

    def key(each: _Found) -> tuple[str, str, bool]:
        return each.submission.student, each.submission.chapter, bool(each.submission.chapter)

    for (_, chapter, _), group in groupby(sorted(found, key=key), key):
        ranked = sorted(group, key=lambda each: each.rank, reverse=True)
        if not chapter:
            yield from _without_chapter([each.submission for each in ranked])
            continue
        best, others = ranked[0].submission, [each.submission.origin for each in ranked[1:]]
        if others:
            note = f"Handed in {len(ranked)} times: {best.origin} was taken, and not {_listed(others)}."
            best = replace(best, notes=(*best.notes, note))
        yield best


def _without_chapter(given: Sequence[Submission]) -> Iterator[Submission]:
    """Yield one submission for all files of a student that are none: a folder of them is one problem."""
    first, *others = sorted(given, key=lambda each: each.origin)
    if others:
        names = _listed([each.origin for each in others])
        first = replace(first, problem=f"{first.problem} Not graded either: {names}.")
    yield first


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more
