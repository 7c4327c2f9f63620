"""Processor time is read from outside of a process."""

from __future__ import annotations

import os
import subprocess
import sys
import time

import pytest

from course_pkg.shop import effort


def test_work_is_seen_from_outside() -> None:
    """A process that works has used more than one that waits; what this one knows of itself is the same."""
    own = effort.processor_time(os.getpid())
    assert own == pytest.approx(time.process_time(), abs=0.5)
    deadline = own + 0.1
    while time.process_time() < deadline:
        pass
    assert effort.processor_time(os.getpid()) >= deadline


def test_without_a_clock_ps_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the system has no such clock, `ps` tells."""

    def none(_: int) -> float:
        raise OSError

    monkeypatch.setattr(time, "clock_gettime", none)
    assert effort.processor_time(os.getpid()) == pytest.approx(time.process_time(), abs=2.0)


def test_a_process_that_is_gone() -> None:
    """It is said so."""
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait(10)
    with pytest.raises(ProcessLookupError):
        effort.processor_time(ended.pid)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("0:00.05", 0.05),
        ("00:00:07", 7.0),
        ("01:02:03", 3723.0),
        ("2-00:00:01", 172801.0),
        ("12:34.5", 754.5),
    ],
)
def test_reading_what_ps_says(text: str, seconds: float) -> None:
    """Linux says [days-]hours:minutes:seconds, macOS minutes:seconds with hundredths."""
    assert effort.read_time(text) == pytest.approx(seconds)
