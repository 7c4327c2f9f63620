"""What a grading run keeps in its folder, so that it can be killed at any moment and continued."""

from __future__ import annotations

import json
import os
import secrets
from dataclasses import replace
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.examiner.report import Verdict
from course_pkg.grading.grade import Grade, Submission, grade_from
from course_pkg.state import write_json

FOLDER = ".grading"
NOBODY = ""


def handed_in(grade: Grade, submission: Submission) -> Grade:
    """Return the grade of a notebook as that of who handed it in, and how."""
    return replace(
        grade,
        student=submission.student,
        origin=submission.origin,
        late=submission.late,
        notes=(*submission.notes, *grade.notes),
    )


class Store:
    """The grades that are done, by their keys: whole or not at all, and without names.

    The folder belongs to the instructor alone: the secret in it tells every input that a check draws.
    """

    def __init__(self, out: Path) -> None:
        self._folder = out / FOLDER
        try:
            self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            self.secret = _secret(self._folder / "secret")
        except OSError as error:
            raise GradingError(
                f"{out} cannot be written ({error.strerror}). Give another folder with --out."
            ) from error

    def find(self, key: str, submission: Submission) -> Grade | None:
        """Return the grade that is kept under `key`, as one of this submission; None where there is none."""
        try:
            grade = grade_from(json.loads((self._folder / f"{key}.json").read_text("utf-8")))
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return handed_in(grade, submission)

    def keep(self, grade: Grade) -> None:
        """Keep `grade` under its key, unless a part could not be examined: another run may do better."""
        if any(report.verdict is Verdict.UNDECIDED for report in grade.reports):
            return
        nameless = replace(grade, student=NOBODY, origin=NOBODY, late=0.0)
        try:
            write_json(self._folder / f"{grade.key}.json", nameless.as_dict())
        except OSError as error:
            raise GradingError(
                f"The grades cannot be written ({error.strerror}). Make room, and type the same command "
                "again: it goes on where it stopped."
            ) from error

    def forget(self) -> None:
        """Remove every grade that is kept."""
        for path in self._folder.glob("*.json"):
            path.unlink(missing_ok=True)


def _secret(path: Path) -> str:
    """Return the secret of this folder, made by whoever comes first."""
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    if not path.exists():
        draft.touch(mode=0o600)
        draft.write_text(secrets.token_hex(16), "ascii")
        try:
            os.link(draft, path)
        except FileExistsError:
            pass
        finally:
            draft.unlink()
    return path.read_text("ascii")
