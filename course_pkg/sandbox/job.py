"""What crosses the boundary of the sandbox: the job of checking one part, and how it ended."""

from __future__ import annotations

import base64
import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from course_pkg.checking.report import Report, report_from
from course_pkg.types.fields import Plain
from course_pkg.waiting import at_this_load

SETUP_TIMEOUT = 25.0  # s for the cells before and after the answer, in which nodes may start
ANSWER_TIMEOUT = 20.0  # s for a student's cell

LONGEST_PATH = 500  # characters

Record = dict[str, Plain]  # of a check runner: its report, and the seed of its inputs


@dataclass(frozen=True)
class WorkFile:
    """A file of a package that a student handed in; `content` is in base64."""

    path: str  # relative, with / between the folders
    content: str
    executable: bool

    @property
    def data(self) -> bytes:
        """The content itself."""
        return base64.b64decode(self.content)

    def below(self, folder: str) -> WorkFile:
        """Return the same file in `folder`."""
        return replace(self, path=f"{folder}/{self.path}")

    def write(self, folder: Path) -> None:
        """Write the file below `folder`. Raises ValueError for a path that leads out of it."""
        parts = self.path.split("/")
        if not all(parts) or {".", ".."}.intersection(parts) or len(self.path) > LONGEST_PATH:
            raise ValueError(f"{self.path[:LONGEST_PATH]!r} is no path of a file in a folder.")
        target = folder.joinpath(*parts)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(self.data)
        target.chmod(0o755 if self.executable else 0o644)


def work_file(path: str, data: bytes, *, executable: bool = False) -> WorkFile:
    """Return the file `path` with the content `data`."""
    return WorkFile(path, base64.b64encode(data).decode("ascii"), executable)


@dataclass(frozen=True)
class PartJob:
    """One part: the cells to run, and the check to run after them.

    `before` and `after` are the reference's cells; `answers` are the student's, the part's own cell the last.
    `files` are in the work folder before any cell runs: packages that the student handed in.
    """

    check: str
    before: str
    answers: tuple[str, ...]
    after: str
    seed: int
    deadline: float  # s, of the check itself
    setup_timeout: float = SETUP_TIMEOUT
    answer_timeout: float = ANSWER_TIMEOUT
    files: tuple[WorkFile, ...] = ()

    @property
    def limit(self) -> float:
        """The time (s) after which every process of this part is ended."""
        return at_this_load(self.setup_timeout + self.answer_timeout * len(self.answers) + self.deadline)

    def as_json(self) -> str:
        """Return the job on one line."""
        return json.dumps(asdict(self))


def job_from(text: str | bytes) -> PartJob:
    """Return the job that `text`, made by `as_json`, describes."""
    fields = json.loads(text)
    files = tuple(WorkFile(**each) for each in fields["files"])
    return PartJob(**{**fields, "answers": tuple(fields["answers"]), "files": files})


@dataclass(frozen=True)
class PartResult:
    """How a part ended: the check runner's record, if it made one, and the messages of the student's side."""

    record: Record | None
    ending: str  # why there is no record; empty where there is one
    messages: tuple[dict[str, str], ...] = ()  # errors of cells, for feedback; never believed
    took: float = 0.0  # s
    lost: bool = False  # True if the sandbox worker itself failed: then nothing is known about the answer

    @property
    def report(self) -> Report | None:
        """The check runner's report, where there is a record."""
        if self.record is None:
            return None
        fields = Report.__dataclass_fields__
        return report_from({key: value for key, value in self.record.items() if key in fields})

    def as_json(self) -> str:
        """Return the result on one line."""
        return json.dumps(asdict(self))


def result_from(text: str | bytes) -> PartResult:
    """Return the result that `text`, made by `as_json`, describes."""
    fields = json.loads(text)
    return PartResult(**{**fields, "messages": tuple(fields["messages"])})
