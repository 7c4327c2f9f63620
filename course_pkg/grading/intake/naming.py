"""Finds the student of a file.

An instructor or a platform has put the student's name into the name of a folder or file.

A file that an instructor has collected has the path SUBMISSIONS/<student>/NN_topic.ipynb; subfolders are
allowed. A file from Moodle has the path Full Name_12345_assignsubmission_file_/NN_topic.ipynb, or it is a
single file without a folder. A file from Canvas has the name lastfirst_LATE_123_456_NN_topic-2.ipynb. LATE
marks a late submission, and -2 means the third attempt. A file from Gradescope has the path
assignment_9_export/submission_456/NN_topic.ipynb, and submission_metadata.yml contains the students' names. A
file from nbgrader has the path submitted/<student>/<assignment>/NN_topic.ipynb.

A catkin package is a folder next to the notebooks: <student>/<package>/package.xml (see packages.py).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import yaml

from course_pkg.errors import GradingError
from course_pkg.grading import clean

MOODLE = re.compile(r"(?P<name>.+?)_(?P<id>\d+)_assignsubmission_(?:file|onlinetext)_?(?P<rest>.*)")
CANVAS = re.compile(
    r"(?P<name>[^_]+(?:_[^_\d][^_]*)*?)(?P<late>_LATE)?_(?P<id>\d{1,19})_(?P<submission>\d{2,19})_(?P<rest>.+)"
)
GRADESCOPE = re.compile(r"submission_\d+")
METADATA = "submission_metadata.yml"
TIMES = "times.csv"  # `course collect` writes this file next to the students' folders.
WRAPPING = re.compile(r"(submitted|submissions?|abgaben|download|assignment_\d+_export)", re.IGNORECASE)
AGAIN = re.compile(r"(?:-(?P<canvas>\d+)|\s*\((?P<browser>\d+)\))$")
# Some systems add .txt or .json to the name of a notebook.
NOTEBOOK = re.compile(r"(?P<stem>.*)\.ipynb(?:\.txt|\.json)?", re.IGNORECASE)
# For each folder in Gradescope's export, Submitters contains the students who submitted.
Submitters = Mapping[str, Sequence[str]]


@dataclass(frozen=True)
class Claim:
    """A file, and the student to whom the file belongs according to its path."""

    student: str  # `student` is the student's name, or "" if the path does not contain it.
    stem: str  # `stem` is the file name that the student gave the notebook, or "" for any other file.
    attempt: int = 0  # `attempt` is the number of the attempt; the first attempt is 0.
    marked_late: bool = False


def claims(parts: Sequence[str], submitters: Submitters) -> list[Claim]:
    """Return the students of a file: one student, or all members of a group.

    The student's name is read only from the first folder, or from the file name if there is no folder. The
    platform or the instructor chose this name. Students choose all other names in the path, and could use
    another student's name.
    """
    *folders, name = parts
    first = folders[0] if folders else name
    if folders and GRADESCOPE.fullmatch(first):
        return [_claim(student, name) for student in submitters.get(first, [first])]
    if found := MOODLE.fullmatch(first):
        return [_claim(f"{found['name']}_{found['id']}", name if folders else found["rest"])]
    if not folders and (found := CANVAS.fullmatch(name)):
        return [_claim(f"{found['name']}_{found['id']}", found["rest"], late=bool(found["late"]))]
    return [_claim(first if folders else "", name)]


def number_of(student: str, origins: Iterable[str], platform: re.Pattern[str]) -> tuple[str, str]:
    """Return the name and the number that a platform (MOODLE or CANVAS) uses for a student.

    The name and the number are "" if they are not known.

    The number is read only from names that the platform chose. For example, a student with the name `s_17`
    has no number.
    """
    for origin in origins:
        for part in origin.split("/"):
            found = platform.fullmatch(part)
            if found and clean.identity(f"{found['name']}_{found['id']}") == student:
                return found["name"], found["id"]
    return "", ""


def unwrapped(parts: Sequence[str], outer: int) -> tuple[str, ...]:
    """Return a path without the first `outer` folders, and without a folder that the platform added."""
    inner = tuple(parts[outer:]) if len(parts) > outer else tuple(parts)
    return inner[1:] if len(inner) > 1 and WRAPPING.fullmatch(inner[0]) else inner


def _claim(student: str, name: str, *, late: bool = False) -> Claim:
    found = NOTEBOOK.fullmatch(name)
    if not found:
        return Claim(clean.identity(student), "", marked_late=late)
    again = AGAIN.search(found["stem"])
    attempt = int((again["canvas"] or again["browser"])[:6]) if again else 0
    return Claim(clean.identity(student), found["stem"] or "notebook", attempt, late)


def wrapping(paths: Iterable[Sequence[str]], archive: str) -> int:
    """Return 1 if one folder contains all students' folders, and 0 otherwise.

    `archive` is the name of the zip without .zip, or "" for a folder.
    """
    inside = [path for path in paths if path]
    outer = {path[0] for path in inside if len(path) > 1 or NOTEBOOK.fullmatch(path[0])}
    if len(outer) != 1 or any(len(path) == 1 and NOTEBOOK.fullmatch(path[0]) for path in inside):
        return 0
    name = outer.pop()
    if WRAPPING.fullmatch(name) or (archive and name.lower() == archive.lower()):
        return 1
    packages = {path[1] for path in inside if len(path) == 3 and path[2] == "package.xml"}
    below = {path[1] for path in inside if len(path) > 2} - packages
    several = len(below) > 1 and not any(re.match(r"\d\d(\D|$)", each) for each in below)
    platform = all(MOODLE.fullmatch(path[1]) or CANVAS.fullmatch(path[1]) for path in inside if len(path) > 1)
    return int(platform or bool(archive and several))


def gradescope_submitters(content: bytes) -> dict[str, list[str]]:
    """Return the submitters (numbers, email addresses or names) for each folder of a Gradescope export."""
    return {
        folder: [_submitter(each) or folder for each in record.get(":submitters") or [{}]]
        for folder, record in gradescope_records(content).items()
        if isinstance(record.get(":submitters", []), list)
    }


def gradescope_records(content: bytes) -> dict[str, dict[str, Any]]:
    """Return the metadata of each folder in a Gradescope export.

    Raises GradingError if the metadata cannot be read.

    The metadata are YAML; the keys are Ruby symbols, such as `:email`. Every scalar is read as a string, and
    YAML tags are ignored.
    """
    loader = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
    try:
        known = yaml.load(content, Loader=loader)  # noqa: S506 -- a base loader makes only strings, lists, dicts
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as error:
        raise GradingError(
            f"{METADATA} cannot be read ({clean.line(error, 120)}); export the submissions again"
        ) from error
    records = known.items() if isinstance(known, dict) else ()
    return {str(folder): record for folder, record in records if isinstance(record, dict)}


def _submitter(record: object) -> str:
    if not isinstance(record, dict):
        return ""
    values = [record.get(key) for key in (":sid", ":email", ":name")]
    return next((value for value in values if isinstance(value, str) and value not in ("", "~", "null")), "")
