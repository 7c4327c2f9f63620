"""Finds misnamed, empty and unused files in an instructor's private folder (--private)."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from course_pkg.checking.parts import Part, exercise_of, parts_of
from course_pkg.errors import GradingError

POINTS = "points.json"
CHECKS = re.compile(r"private_(\d\d)\.py")
SIMILAR = re.compile(r"private.*|points?\b.*", re.IGNORECASE)
EXPECTED = f"private_NN.py, such as private_05.py, or {POINTS}"


def require_names(folder: Path, chapters: Sequence[str]) -> None:
    """Raise GradingError if a file in the folder `folder` is misnamed or empty, or if no file can be used.

    A message on stderr lists the unused files. `chapters` contains the chapters with checks.
    """
    try:
        files = sorted(path for path in folder.iterdir() if not path.name.startswith((".", "__")))
    except OSError as error:
        raise GradingError(
            f"{folder} cannot be read ({error.strerror}). Correct the permissions of this folder."
        ) from error
    used = [path for path in files if path.is_file() and _is_used(path, chapters)]
    if wrong := [path.name for path in files if path not in used and SIMILAR.match(path.name)]:
        raise GradingError(
            f"{folder} contains {', '.join(wrong)}, which cannot be used. The name of a file "
            f"has to be {EXPECTED}, where NN is one of {', '.join(chapters)}. Rename the file, or move the "
            "file to another folder."
        )
    if not used:
        raise GradingError(f"{folder} contains no file that can be used. Add {EXPECTED}.")
    if empty := [path.name for path in used if not path.read_bytes().strip()]:
        raise GradingError(
            f"{folder / empty[0]} is empty. Add the missing content to this file, or remove the file."
        )
    if others := [path.name for path in files if path not in used]:
        sys.stderr.write(
            f"These files were not used, because only {EXPECTED} are read: {', '.join(others)} in {folder}.\n"
        )


def require_parts(folder: Path) -> None:
    """Raise GradingError if a private module contains no part, or a part that belongs to no exercise."""
    for chapter, name in _modules(folder):
        declared = parts_of(chapter)
        public = {part.check for part in declared if part.check == exercise_of(part.check)}
        own = [part for part in declared if _is_from(part, folder / name)]
        if not own:
            raise GradingError(
                f"{folder / name} declares no part. Write a function with @part: the README shows an example."
            )
        for part in own:
            exercise = exercise_of(part.check)
            if part.check == exercise or exercise not in public:
                raise GradingError(
                    f"{folder / name} declares the part {part.check}, which belongs to no exercise "
                    f"of chapter {chapter}. Write the number of an exercise, a dot and another "
                    f"number, such as {chapter}.1.1."
                )


def _modules(folder: Path) -> Iterator[tuple[str, str]]:
    for path in sorted(folder.iterdir()):
        if found := CHECKS.fullmatch(path.name):
            yield found[1], path.name


def _is_used(path: Path, chapters: Sequence[str]) -> bool:
    found = CHECKS.fullmatch(path.name)
    return path.name == POINTS or (found is not None and found[1] in chapters)


def _is_from(part: Part, path: Path) -> bool:
    return Path(part.examine.__code__.co_filename).resolve() == path.resolve()
