"""The data that enter and leave the sandbox: a job for one part, and its result."""

from __future__ import annotations

import base64
import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from course_pkg.checking.report import Report, report_from
from course_pkg.types.fields import Plain
from course_pkg.waiting import at_this_load

# Each cell before or after the answer has this time limit in s. The limit is long because such a cell may
# start nodes.
SETUP_TIMEOUT = 25.0
ANSWER_TIMEOUT = 20.0  # A student's cell has this time limit in s.

LONGEST_PATH = 500  # A path has at most this number of characters.

# The record of a check runner contains its report, and the seed of its random inputs.
Record = dict[str, Plain]


@dataclass(frozen=True)
class WorkFile:
    """A file of a package that a student submitted; `content` is in base64."""

    path: str  # The path is relative, with / between the folders.
    content: str
    executable: bool

    @property
    def data(self) -> bytes:
        """The decoded content of the file."""
        return base64.b64decode(self.content)

    def below(self, folder: str) -> WorkFile:
        """Return a copy of this object; its path begins with the folder `folder`."""
        return replace(self, path=f"{folder}/{self.path}")

    def write(self, folder: Path) -> None:
        """Write the file into this folder.

        Raises ValueError if its path is invalid or leads out of the folder.
        """
        parts = self.path.split("/")
        if not all(parts) or {".", ".."}.intersection(parts) or len(self.path) > LONGEST_PATH:
            raise ValueError(f"{self.path[:LONGEST_PATH]!r} is not the path of a file inside a folder.")
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

    `before` and `after` are cells of the reference notebook. `answers` are the student's cells; the last cell
    is the answer of this part. In a sandbox, the processes of the part cannot read the paths in `hidden`.
    """

    check: str
    before: str
    answers: tuple[str, ...]
    after: str
    seed: int
    deadline: float  # The check itself has this time limit in s.
    setup_timeout: float = SETUP_TIMEOUT
    answer_timeout: float = ANSWER_TIMEOUT
    files: tuple[WorkFile, ...] = ()
    hidden: tuple[str, ...] = ()

    @property
    def limit(self) -> float:
        """The time limit for this part in s; at this limit, all processes of the part are ended."""
        return at_this_load(self.setup_timeout + self.answer_timeout * len(self.answers) + self.deadline)

    def as_json(self) -> str:
        """Return the job as one line of JSON."""
        return json.dumps(asdict(self))


def job_from(text: str | bytes) -> PartJob:
    """Return the job from the output of as_json()."""
    fields = json.loads(text)
    files = tuple(WorkFile(**each) for each in fields["files"])
    lists = {name: tuple(fields[name]) for name in ("answers", "hidden")}
    return PartJob(**{**fields, **lists, "files": files})


@dataclass(frozen=True)
class PartResult:
    """The result of a part: the check runner's record, if any, and the student process's messages."""

    record: Record | None
    ending: str  # The reason why there is no record, or "".
    # The cells' error messages may be false, so they are only used as feedback.
    messages: tuple[dict[str, str], ...] = ()
    took: float = 0.0  # The part took this time in s.
    # The value is true if the sandbox worker itself failed. The result of the answer is then unknown.
    lost: bool = False

    @property
    def report(self) -> Report | None:
        """The check runner's report, or None if the check runner has sent no record."""
        if self.record is None:
            return None
        fields = Report.__dataclass_fields__
        return report_from({key: value for key, value in self.record.items() if key in fields})

    def as_json(self) -> str:
        """Return the result as one line of JSON."""
        return json.dumps(asdict(self))


def result_from(text: str | bytes) -> PartResult:
    """Return the result from the output of as_json()."""
    fields = json.loads(text)
    return PartResult(**{**fields, "messages": tuple(fields["messages"])})
