"""The files that a grading run stores in its folder. The next run uses them, even if this run was killed."""

from __future__ import annotations

import json
import os
import secrets
from dataclasses import replace
from pathlib import Path

from course_pkg.checking.report import Verdict
from course_pkg.errors import GradingError
from course_pkg.grading.grade import Grade, Submission, grade_from
from course_pkg.state import write_json

FOLDER = ".grading"
NOBODY = ""


def handed_in(grade: Grade, submission: Submission) -> Grade:
    """Return the grade with the data of the submission, such as the student's name."""
    return replace(
        grade,
        student=submission.student,
        origin=submission.origin,
        late=submission.late,
        handed_in=submission.digest,
        notes=(*submission.notes, *grade.notes),
    )


class Store:
    """The finished grades; each grade has a key.

    Each file is written completely or not at all, and no file contains a student's name.

    Only the instructor can read the stored files, because they contain the seed of the checks' random inputs.
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
        """Return the grade that is stored under this key, or None if no grade is stored under this key.

        The returned grade also contains the data of the submission, such as the student's name.
        """
        grade = self.load(key)
        return handed_in(grade, submission) if grade else None

    def load(self, key: str) -> Grade | None:
        """Return the grade that is stored under this key, or None if no readable grade is stored.

        The returned grade contains no student's name.
        """
        try:
            return grade_from(json.loads((self._folder / f"{key}.json").read_text("utf-8")))
        except (OSError, ValueError, KeyError, TypeError):
            return None

    def keep(self, grade: Grade) -> None:
        """Store the grade under its key. If a part could not be examined, do not store the grade.

        The next run then examines this part again.
        """
        if any(report.verdict is Verdict.UNDECIDED for report in grade.reports):
            self.drop(grade.key)
            return
        nameless = replace(grade, student=NOBODY, origin=NOBODY, late=0.0)
        try:
            write_json(self._folder / f"{grade.key}.json", nameless.as_dict())
        except OSError as error:
            raise GradingError(
                f"The grades cannot be written ({error.strerror}). Free some disk space, and type "
                "the same command again. Then the run continues."
            ) from error

    def drop(self, key: str) -> None:
        """Remove the grade that is stored under this key; the next run then grades this notebook again."""
        (self._folder / f"{key}.json").unlink(missing_ok=True)

    def forget(self) -> None:
        """Remove all stored grades."""
        for path in self._folder.glob("*.json"):
            path.unlink(missing_ok=True)


def _secret(path: Path) -> str:
    """Return the secret of a results folder; if there is no secret, create one."""
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
