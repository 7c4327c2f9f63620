"""Tests of the student's record of results."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from course_pkg.checking.record import FOLDER, StudentRecord
from course_pkg.state import locked
from tests.checking.test_check import SERVE, output

PASSED = {"check": "05.1", "verdict": "passed", "points": 2}
FAILED = {"check": "05.1", "verdict": "not yet", "points": 0}
MANY = """
import sys
from pathlib import Path
from course_pkg.checking.record import StudentRecord
record = StudentRecord(Path(sys.argv[1]))
for number in range(30):
    assert record.store("05.1", {"check": "05.1", "verdict": "passed"}) == ""
"""
FULL = """
import sys
from pathlib import Path
from course_pkg.checking.record import StudentRecord
folder = Path(sys.argv[1])
record = StudentRecord(folder)
assert record.store("05.1", {"check": "05.1", "verdict": "passed"}) == ""
before = (folder / "05.1.json").read_text()
try:
    (folder / "filling").write_bytes(bytes(1 << 20))
except OSError:
    pass
print(record.store("05.1", {"check": "05.1", "verdict": "not yet", "printed": "x" * 5000}))
assert (folder / "05.1.json").read_text() == before
"""


@pytest.fixture
def record(tmp_path: Path) -> StudentRecord:
    """Return an empty record; its folder does not exist yet."""
    return StudentRecord(tmp_path / "state" / "results")


def test_a_pass_stays_a_pass(record: StudentRecord) -> None:
    """If a check fails after an earlier pass, the record still contains the pass."""
    assert record.store("05.1", FAILED) == ""
    first, _ = record.read(["05.1"])
    assert (first["05.1"].verdict, first["05.1"].passed, first["05.1"].checks) == ("not yet", "", 1)
    record.store("05.1", PASSED)
    passed = record.read(["05.1"])[0]["05.1"].passed
    assert passed
    record.store("05.1", FAILED)
    found, message = record.read(["05.1", "05.2"])
    assert list(found) == ["05.1"]
    assert (found["05.1"].verdict, found["05.1"].passed, found["05.1"].checks) == ("not yet", passed, 3)
    assert message == ""


@pytest.mark.parametrize(
    "content", ["", "{", "[]", '{"check": "05.1"}', '{"check": "05.2"}', "\udcff", "9" * 5000, "[" * 100_000]
)
def test_a_damaged_file_is_kept_and_named(record: StudentRecord, content: str) -> None:
    """A damaged file of the record is not deleted, and the report contains a message about the file."""
    record.folder.mkdir(parents=True)
    path = record.folder / "05.1.json"
    damaged = content.encode("utf-8", "surrogateescape")
    path.write_bytes(damaged)
    found, message = record.read(["05.1", "05.2"])
    assert found == {}
    assert "05.1" in message
    assert "Run the checks of these parts again" in message
    message = record.store("05.1", PASSED)
    assert "The earlier result of this part could not be read" in message
    assert (record.folder / "05.1.damaged-1.json").read_bytes() == damaged
    assert record.read(["05.1"])[0]["05.1"].passed
    assert record.store("05.1", PASSED) == ""


def test_second_damaged_file_replaces_no_file(record: StudentRecord) -> None:
    """Each damaged file gets a name that no other damaged file has."""
    record.folder.mkdir(parents=True)
    path = record.folder / "05.1.json"
    path.write_text("first")
    record.store("05.1", PASSED)
    path.unlink()
    path.mkdir()
    assert "damaged-2" in record.store("05.1", PASSED)
    assert (record.folder / "05.1.damaged-1.json").read_text() == "first"
    assert (record.folder / "05.1.damaged-2.json").is_dir()


def test_many_damaged_files_are_one_message(record: StudentRecord) -> None:
    """If many files are damaged, the report contains one short message."""
    record.folder.parent.mkdir()
    record.folder.write_text("a file in the place of the folder")
    checks = [f"05.{number}" for number in range(1, 100)]
    _, message = record.read(checks)
    assert "05.1, 05.2, 05.3, 05.4, 05.5 and 94 more: Not a directory" in message
    assert len(message) < 400
    assert "cannot be written" in record.store("05.1", PASSED)


def test_kernels_that_check_at_the_same_time_lose_nothing(record: StudentRecord) -> None:
    """Three programs store 30 results each, and the record contains all 90 results."""
    programs = [subprocess.Popen([sys.executable, "-c", MANY, record.folder]) for _ in range(3)]
    assert [program.wait(60) for program in programs] == [0, 0, 0]
    assert record.read(["05.1"])[0]["05.1"].checks == 90
    assert sorted(path.name for path in record.folder.iterdir()) == [".lock", "05.1.json"]


def test_lock_that_is_not_released_leads_to_a_message(record: StudentRecord) -> None:
    """If another program does not release the lock, the report contains a message."""
    with locked(record.folder), pytest.raises(TimeoutError), locked(record.folder, timeout=0.0):
        pass
    with locked(record.folder):
        message = record.store("05.1", PASSED)
    assert "cannot be written (another program keeps it locked)" in message
    assert record.store("05.1", PASSED) == ""


def test_full_disk_leads_to_a_message(tmp_path: Path) -> None:
    """If the disk is full, the report contains a message, and the earlier result stays in the record."""
    if not shutil.which("bwrap"):
        pytest.skip("bubblewrap makes the small disk")
    small = ["bwrap", "--dev-bind", "/", "/", "--size", "8192", "--tmpfs", str(tmp_path)]
    done = subprocess.run(
        [*small, sys.executable, "-c", FULL, str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "cannot be written (No space left on device). Solve this problem" in done.stdout


@pytest.mark.usefixtures("master")
def test_a_check_reports_a_problem_with_its_record_and_still_counts(tmp_path: Path) -> None:
    """If the record cannot be written, the report contains a message and the check's result."""
    (tmp_path / FOLDER).mkdir()
    (tmp_path / FOLDER / "05.1.json").write_text('{"check": "05')
    out = output(SERVE + '    print(check("05.1"))\n    print(check("05.1"))', tmp_path)
    assert out.count("05.1 passed: 2 of 2 points") == 2
    assert out.count("could not be read") == 1
    assert json.loads((tmp_path / FOLDER / "05.1.json").read_text())["checks"] == 2


@pytest.mark.usefixtures("master")
def test_check_without_a_record_still_passes(tmp_path: Path) -> None:
    """If the state folder cannot be created, the check passes, and the report contains the folder's path."""
    (tmp_path / "file").write_text("")
    out = output(SERVE + '    print(check("05.1"))', tmp_path / "file")
    assert out.startswith("05.1 passed: 2 of 2 points")
    assert "This result was not stored" in " ".join(out.split())
    assert os.listdir(tmp_path) == ["file"]
