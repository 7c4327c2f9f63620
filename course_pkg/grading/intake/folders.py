"""Folders that are not submissions: empty folders of students, and folders with reports."""

from __future__ import annotations

import os
import sys
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.grade import NOTHING, Submission
from course_pkg.grading.intake.archive import is_litter, leads_out
from course_pkg.grading.intake.naming import WRAPPING, Submitters, claims, unwrapped
from course_pkg.grading.store import FOLDER

# DEPTH is the maximum depth of a student's folder. A platform can put this folder into one or two other
# folders.
DEPTH = 3
PROBLEM = f"{NOTHING}: the folder {{}} contains no file."


def handed_in_nothing(
    source: Path, files: Sequence[str], outer: int, submitters: Submitters, reports: Sequence[str] = ()
) -> list[Submission]:
    """For each student with an empty folder, return a submission with a `problem`.

    `source` is a folder or a zip, and `files` contains the paths in it. `outer` is 1 if one folder contains
    all students' folders, and 0 otherwise. `reports` contains the paths of folders with reports; these
    folders are skipped.
    """
    filled = {PurePosixPath(path).parts[:depth] for path in files for depth in range(1, DEPTH + 1)}
    found: dict[str, Submission] = {}
    for parts in sorted(_folders(source)):
        inner = unwrapped(parts, outer)
        wraps = len(parts) <= outer or (len(inner) == 1 and WRAPPING.fullmatch(inner[0]))
        if parts in filled or len(inner) != 1 or wraps or _leads_to(parts, reports):
            continue
        for claim in claims((*inner, ""), submitters):
            folder = clean.line("/".join(parts), 200)
            found[claim.student] = Submission(claim.student, "", b"", folder, problem=PROBLEM.format(folder))
    with_files = {
        claim.student
        for path in files
        for claim in claims(unwrapped(PurePosixPath(path).parts, outer) or ("?",), submitters)
    }
    return [each for student, each in found.items() if student not in with_files]


def require_other_folder(source: Path, out: Path) -> None:
    """Raise GradingError if `out` is `source`, or a non-empty folder inside `source`.

    Otherwise, the reports would be mixed with the submissions. If `out` contains the results of an earlier
    run, no error is raised.
    """
    if not source.is_dir() or not out.is_dir() or (out / FOLDER).is_dir():
        return
    same = out.resolve() == source.resolve()
    if same or (_path_inside(source, out) and any(out.iterdir())):
        raise GradingError(
            f"--out {out} already contains files of the submissions. Give a new folder for the reports."
        )


def report_folders(source: Path, out: Path | None) -> list[str]:
    """Return the folders in `source` that contain reports: the folder `out`, and the folders of earlier runs.

    In the returned paths, a / separates the names. A message on stderr lists the folders of earlier runs.
    """
    own = _path_inside(source, out)
    others = []
    if source.is_dir():
        marks = (f"{FOLDER}/secret", "class.html", "grades.csv")
        found = (path for path in sorted(source.iterdir()) if all((path / mark).is_file() for mark in marks))
        others = [path.name for path in found if path.name != own]
    if others:
        sys.stderr.write(
            "These folders were not read, because they contain the reports of an earlier run: "
            f"{', '.join(others)}\n"
        )
    return [*filter(None, [own]), *others]


def is_inside(path: str, folders: Sequence[str]) -> bool:
    """Return whether the file at this path is in one of the folders; a / separates the names."""
    return any(path.startswith(f"{folder}/") for folder in folders)


def _path_inside(source: Path, folder: Path | None) -> str:
    """Return the path of the folder relative to `source`, or "" if the folder is not inside `source`."""
    try:
        inside = folder.resolve().relative_to(source.resolve()) if folder else Path()
    except ValueError:
        return ""
    return "" if inside == Path() else inside.as_posix()


def _leads_to(parts: tuple[str, ...], folders: Sequence[str]) -> bool:
    """Return whether a folder is equal to a folder in `folders`, contains one, or is inside one."""
    inner = (PurePosixPath(folder).parts for folder in folders)
    return any(parts[: len(each)] == each[: len(parts)] for each in inner)


def _folders(source: Path) -> Iterator[tuple[str, ...]]:
    """Yield the path of each folder in `source`, with at most `DEPTH` names; links are not followed."""
    if source.is_dir():
        yield from _below(source, ())
        return
    with zipfile.ZipFile(source) as archive:
        names = [name.replace("\\", "/") for name in archive.namelist() if name.endswith(("/", "\\"))]
    for name in names:
        parts = PurePosixPath(name).parts
        if not leads_out(name) and not is_litter(parts):
            yield from {parts[:depth] for depth in range(1, min(len(parts), DEPTH) + 1)}


def _below(folder: Path, parts: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    try:
        inside = [item for item in os.scandir(folder) if item.is_dir(follow_symlinks=False)]
    except OSError:  # opened() reports this error.
        return
    for item in inside:
        if not is_litter((item.name,)):
            yield (*parts, item.name)
            if len(parts) + 1 < DEPTH:
                yield from _below(Path(item.path), (*parts, item.name))
