"""Reads the submissions: one for each chapter and student, and one for each unusable file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path

from course_pkg.authoring.notebook_store import NotebookStore
from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import Submission
from course_pkg.grading.intake.archive import Entry, leads_out, one_file, opened
from course_pkg.grading.intake.first_edition import RenumberedChapter, first_edition
from course_pkg.grading.intake.folders import handed_in_nothing, is_inside, report_folders
from course_pkg.grading.intake.naming import (
    METADATA,
    NOTEBOOK,
    TIMES,
    Claim,
    claims,
    gradescope_submitters,
    unwrapped,
    wrapping,
)
from course_pkg.grading.intake.packages import (
    MANIFEST,
    Found,
    Member,
    attached,
    is_generated,
    package_roots,
    read_package,
    root_of,
)
from course_pkg.grading.intake.reading import read_cells, slimmed
from course_pkg.grading.intake.references import References, plain

LATE = (
    "Canvas marks this submission as late, but does not show the number of late days. Give a table of "
    "late days (--late TABLE) or a table of submission times (--times TABLE)."
)
SHOWN = 3  # SHOWN is the maximum number of file names in a sentence.


@dataclass(frozen=True)
class _Found:
    """A submission; `rank` decides which of a student's submissions for a chapter is graded."""

    submission: Submission
    attempt: int
    modified: float

    @property
    def rank(self) -> tuple[bool, int, float, str]:
        return not self.submission.problem, self.attempt, self.modified, self.submission.origin


def submissions(
    source: Path, chapters: Sequence[str] = (), root: Path | None = None, without: Path | None = None
) -> list[Submission]:
    """Return the submissions for these chapters, or for all chapters, sorted by student and chapter.

    `source` is a folder with files such as `<student>/NN_topic.ipynb`, a zip of such a folder, a download
    from a platform (see naming.py), or one notebook. `root` is the checkout that contains the solutions.
    Files in the folder `without`, and in folders with the reports of earlier runs, are ignored. An unusable
    file, or a student's empty folder, becomes a submission with a `problem`. GradingError is raised only if
    `source` cannot be opened.
    """
    if source.is_file() and NOTEBOOK.fullmatch(source.name):
        return [submission_of(source, root=root)]
    # This call raises an error if `chapters` contains an unknown chapter.
    NotebookStore(root).solutions(chapters)
    references = References(root)
    reports = report_folders(source, without)
    with opened(source) as everything:
        entries = [each for each in everything if not is_inside(each.path, reports)]
        outer, submitters = _layout(entries, "" if source.is_dir() else source.stem)
        files = list(_unwrapped(entries, outer, submitters))
        packages, others = _packages(files)
        found = [each for file in others for each in _found(file, references)]
    wanted = [each for each in found if not chapters or each.submission.chapter in ("", *chapters)]
    decided = attached(list(_decided(wanted)), packages, chapters)
    if entries:
        decided += handed_in_nothing(source, [each.path for each in entries], outer, submitters, reports)
    return sorted(decided, key=lambda each: (each.student, each.chapter, each.origin))


def submission_of(path: Path, student: str = "", root: Path | None = None) -> Submission:
    """Return a submission with one notebook, and with the packages in the notebook's folder.

    If `student` is empty, the student's name is the name of the notebook's folder.
    """
    entry, name = one_file(path), path.resolve().parent.name
    claim = replace(claims([name, path.name], {})[0], student=clean.identity(student or name))
    taken = _taken(entry, claim, References(root)).submission
    packages = {taken.student: list(_beside(path))}
    return next(iter(attached([taken], packages, [taken.chapter]))) if taken.chapter else taken


def _beside(path: Path) -> Iterator[Found]:
    """Yield the packages in the folder of a notebook; other files in this folder are ignored."""
    for folder in sorted(path.parent.iterdir()):
        if (folder / MANIFEST).exists() and folder.is_dir() and not folder.is_symlink():
            with opened(folder) as entries:
                inside = [Member(each, (folder.name, *each.parts)) for each in entries]
                yield read_package(
                    (folder.name,), [each for each in inside if root_of(each.path, {(folder.name,)})]
                )


@dataclass(frozen=True)
class _File:
    """A file, its student, and the file's path relative to the folder with all submissions."""

    entry: Entry
    path: tuple[str, ...]
    owners: Sequence[Claim]


def _packages(files: Sequence[_File]) -> tuple[dict[str, list[Found]], list[_File]]:
    """Return the packages of each student, and the other submitted files."""
    packages: dict[str, list[Found]] = {}
    others: list[_File] = []
    for _, group in groupby(sorted(files, key=lambda each: each.path), lambda each: each.path[:1]):
        own = list(group)
        roots = package_roots([each.path[1:] for each in own if len(each.path) > 1])
        inside: dict[tuple[str, ...], list[_File]] = {}
        for file in own:
            root = root_of(file.path[1:], roots) if len(file.path) > 1 else None
            if root is not None:
                inside.setdefault(root, []).append(file)
            elif not (roots and is_generated(file.path[1:-1])):
                others.append(file)
        for root, members in inside.items():
            found = read_package(root, [Member(each.entry, each.path[1:]) for each in members])
            for owner in members[0].owners:
                packages.setdefault(owner.student, []).append(found)
    return packages, others


def _layout(entries: Sequence[Entry], archive: str) -> tuple[int, dict[str, list[str]]]:
    """Return how many folders enclose all students' folders, and the submitters in Gradescope's metadata."""
    outer = wrapping([entry.parts for entry in entries if not leads_out(entry.path)], archive)
    submitters: dict[str, list[str]] = {}
    for entry in entries:
        if _is_metadata(entry, outer):
            with suppress(GradingError):
                submitters |= gradescope_submitters(entry.read())
    return outer, submitters


def _is_metadata(entry: Entry, outer: int) -> bool:
    """Return whether Gradescope, and not a student, wrote the file.

    The metadata file from Gradescope is not in a student's folder.
    """
    return unwrapped(_inside(entry), outer) == (METADATA,)


def _unwrapped(entries: Sequence[Entry], outer: int, submitters: dict[str, list[str]]) -> Iterator[_File]:
    """Yield each file with its student; the path begins with the student's folder."""
    for entry in entries:
        path = unwrapped(_inside(entry), outer)
        if path != (TIMES,) and not (submitters and _is_metadata(entry, outer)):
            yield _File(entry, path, claims(path or ("?",), submitters))


def _inside(entry: Entry) -> tuple[str, ...]:
    """Return the folders and the name of a file; parts such as `..` are removed."""
    if not leads_out(entry.path):
        return entry.parts
    return tuple(part for part in entry.parts if part.strip("./\\") and ":" not in part)


def _found(file: _File, references: References) -> Iterator[_Found]:
    for owner in file.owners:
        yield _taken(file.entry, owner, references)


def _taken(entry: Entry, owner: Claim, references: References) -> _Found:
    """Read one file, and return the submission in this file.

    If the file cannot be graded, `problem` says why, and what the student or the instructor can do.
    """
    name = clean.line(entry.path.rpartition("/")[2] or "the archive", 120)
    blank = Submission(owner.student, "", b"", clean.line(entry.path, 500))
    try:
        made = _read(entry, owner, references, blank)
    except GradingError as error:
        chapter = references.by_name(owner.stem) if owner.stem else ""
        chapter = chapter if owner.student and chapter in references.chapters else ""
        made = replace(blank, chapter=chapter, problem=f"{name} was not graded: {error}.")
    if not owner.student and not made.problem:
        why = "the student is unknown; put the file into a folder with the name of the student"
        made = replace(made, chapter="", content=b"", problem=f"{name} was not graded: {why}.")
    return _Found(made, owner.attempt, entry.modified)


def _read(entry: Entry, owner: Claim, references: References, blank: Submission) -> Submission:
    if not owner.stem:
        _refuse_other(entry)
    cells = read_cells(entry.read())
    if found := first_edition(plain(owner.stem), cells, references.by_ids(cells)):
        return _of_first_edition(found, references, blank)
    named = references.by_name(owner.stem)
    chapter = references.by_cells(cells, named) or named
    if chapter not in references.chapters:
        known = ", ".join(references.chapters)
        raise GradingError(
            f"the course has no chapter {chapter}; its chapters are {known}; correct the number in the "
            "file's name"
            if chapter
            else (
                "neither the name of the file nor its cells show the chapter; give the file a name "
                "such as NN_topic.ipynb"
            )
        )
    notes = [LATE] if owner.marked_late else []
    if named and named != chapter:
        notes.append(f"The file's name contains chapter {named}, but its cells belong to chapter {chapter}.")
    return replace(blank, chapter=chapter, content=slimmed(cells), notes=tuple(notes))


def _of_first_edition(found: RenumberedChapter, references: References, blank: Submission) -> Submission:
    """Return a submission; `problem` says what has changed, and which notebook the student must submit."""
    name = clean.line(blank.origin.rpartition("/")[2], 120)
    problem = (
        f"{name} was not graded: this notebook belongs to the first edition of the course, where "
        f"{found.difference} Copy your answers into {references.name_of(found.now)}.ipynb, and hand "
        "in that notebook."
    )
    return replace(blank, chapter=found.now, problem=problem)


def _refuse_other(entry: Entry) -> None:
    """Raise GradingError for a file that is not a notebook; the message depends on the kind of file."""
    if entry.path.endswith(METADATA):
        raise GradingError(
            "the file does not contain the names of the students; export the submissions from "
            "Gradescope again"
        )
    ending = entry.path.rpartition(".")[2].lower()
    if ending in ("zip", "gz", "7z", "rar", "tar", "tgz"):
        raise GradingError(
            "the file is an archive inside the submissions; unpack the archive, and then delete it"
        )
    if entry.parts[-1:] == (MANIFEST,):
        raise GradingError("a package needs its own folder; move the file to STUDENT/PACKAGE/package.xml")
    raise GradingError(
        "the file is neither a notebook nor part of a package with a package.xml; if it contains answers, "
        "ask the student for the .ipynb file"
    )


def _decided(found: Sequence[_Found]) -> Iterator[Submission]:
    """Yield each student's last submission for each chapter; a note lists the earlier submissions."""

    def key(each: _Found) -> tuple[str, str, bool]:
        return each.submission.student, each.submission.chapter, bool(each.submission.chapter)

    for (_, chapter, _), group in groupby(sorted(found, key=key), key):
        ranked = sorted(group, key=lambda each: each.rank, reverse=True)
        if not chapter:
            yield from _without_chapter([each.submission for each in ranked])
            continue
        best, others = ranked[0].submission, [each.submission for each in ranked[1:]]
        if others:
            names = _listed([each.origin for each in others])
            note = (
                f"This chapter was handed in {len(ranked)} times: {best.origin} was graded, and "
                f"these files were not graded: {names}."
            )
            usable = tuple(each for each in reversed(others) if not each.problem)
            best = replace(best, notes=(*best.notes, note), attempts=usable)
        yield best


def _without_chapter(given: Sequence[Submission]) -> Iterator[Submission]:
    """Yield one submission with all unusable files of a student.

    Unusable files of a student usually have the same problem.
    """
    first, *others = sorted(given, key=lambda each: each.origin)
    if others:
        names = _listed([each.origin for each in others])
        first = replace(first, problem=f"{first.problem} These files were not graded either: {names}.")
    yield first


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more
