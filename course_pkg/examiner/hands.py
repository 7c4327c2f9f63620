"""The judge's hands inside the kernel: they look at, read and run what the student defined.

They decide nothing. What they say is believed only as far as the judge can see its effect.
"""

from __future__ import annotations

import difflib
import inspect
import io
import logging
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from types import FunctionType
from typing import IO, Any

from course_pkg.examiner.plain import Plain, Value, plain
from course_pkg.examiner.stub import is_stub

PRINTED = 65536  # characters kept of what is printed
AGAIN = 0.2  # s between alarms, for code that swallows the first


class TimesUp(BaseException):
    """The time of a student's function is over; no `except Exception` of theirs keeps it."""


class Printed(io.TextIOBase):
    """Stands in for stdout and stderr and keeps the beginning of what is written."""

    def __init__(self) -> None:
        self.text = ""

    def writable(self) -> bool:
        """Say yes, as a stream for print() must."""
        return True

    def write(self, text: str) -> int:
        """Keep `text` while there is room."""
        if len(self.text) < PRINTED:
            self.text += text[: PRINTED - len(self.text)]
        return len(text)


class Hands:
    """Answers the judge's questions about the names in `namespace`."""

    def __init__(self, namespace: Mapping[str, Any], folder: Path | None = None) -> None:
        self._namespace = namespace
        self._folder = folder or Path.cwd()
        self._held: dict[str, Any] = {}  # what `prepare` made, apart from the student's names
        self._answers: dict[str, Callable[..., dict[str, Any]]] = {
            "look": self._look,
            "read": self._read,
            "source": self._source,
            "prepare": self._prepare,
            "call": self._call,
            "run": self._run,
        }

    def answer(self, question: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer to one question of the protocol (see link.py)."""
        what = {key: value for key, value in question.items() if key not in ("ask", "do")}
        try:
            answer = self._answers[question["do"]](**what)
        except (LookupError, AttributeError, TypeError, ValueError, OSError) as error:
            answer = {"wrong": f"{type(error).__name__}: {error}"}
        return {"answer": question.get("ask"), **answer}

    def _find(self, name: str) -> Value:
        """Return what stands under `name`, which may have dots in it."""
        first, *rest = name.split(".")
        value = self._namespace[first] if first in self._namespace else self._held[first]
        for attribute in rest:
            value = getattr(value, attribute)
        return value

    def _look(self, name: str) -> dict[str, Any]:
        if name.startswith("file:"):
            return {"kind": _kind_of_file(self._folder / name.removeprefix("file:")), "alike": []}
        if name not in self._namespace:
            mine = [known for known in self._namespace if not known.startswith("_")]
            return {"kind": "missing", "alike": difflib.get_close_matches(name, mine, n=2)}
        value = self._namespace[name]
        if is_stub(value):
            return {"kind": "stub", "alike": []}
        kinds = {FunctionType: "function", type: "class"}
        return {"kind": kinds.get(type(value), "value"), "alike": []}

    def _read(self, name: str) -> dict[str, Any]:
        return {"value": plain(self._find(name))}

    def _source(self, name: str) -> dict[str, Any]:
        if name.startswith("file:"):
            return {"text": (self._folder / name.removeprefix("file:")).read_text("utf-8")}
        return {"text": inspect.getsource(self._find(name))}

    def _call(self, name: str, args: list[Any], kwargs: dict[str, Any], within: float) -> dict[str, Any]:
        printed = Printed()
        started = time.monotonic()
        values = [self._argument(value) for value in args]
        named = {key: self._argument(value) for key, value in kwargs.items()}
        with redirect_stdout(printed), redirect_stderr(printed), _ros_console(printed):
            outcome = _outcome(lambda: self._find(name)(*values, **named), within)
        return {**outcome, "printed": printed.text, "took": time.monotonic() - started}

    def _argument(self, value: Plain) -> Value:
        return self._find(value["its"]) if isinstance(value, dict) and value.keys() == {"its"} else value

    def _prepare(self, code: str, within: float) -> dict[str, Any]:
        """Run the judge's own `code`; the names that it makes can be arguments of later calls."""
        outcome = _outcome(lambda: exec(code, self._held), within)  # noqa: S102 -- the judge is trusted here
        return {"error": outcome.get("error")}

    def _run(self, argv: list[str], files: list[str], within: float) -> dict[str, Any]:
        """Run a command in a folder of its own that holds copies of the student's `files`."""
        with tempfile.TemporaryDirectory(prefix="course-run-") as folder:
            for name in files:
                shutil.copy(self._folder / name, folder)
            command = [sys.executable if argv[0] == "python" else argv[0], *argv[1:]]
            return _finished(command, folder, within)


@contextmanager
def _ros_console(stream: io.TextIOBase) -> Iterator[None]:
    """Have rospy's log print to `stream`; its handler keeps the streams that it found when it was made."""
    handlers = [
        handler
        for handler in logging.getLogger("rosout").handlers
        if hasattr(handler, "_stdout") and hasattr(handler, "_stderr")
    ]
    kept = [(handler._stdout, handler._stderr) for handler in handlers]
    for handler in handlers:
        handler._stdout = handler._stderr = stream
    try:
        yield
    finally:
        for handler, (out, err) in zip(handlers, kept, strict=True):
            handler._stdout, handler._stderr = out, err


def _outcome(function: Callable[[], Any], timeout: float) -> dict[str, Any]:
    """Return {"value": …} or {"error": …} of a call that is broken off after `timeout` s.

    It runs on the main thread, and an alarm breaks it off: on a thread of its own it could only be
    abandoned, and would go on asking and answering on the graph while the next check looks there.
    """
    try:
        with _alarm(timeout):
            return {"value": plain(function())}
    except TimesUp:
        return {"error": {"type": "TimesUp", "bases": [], "text": f"not done after {timeout:g} s"}}
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # noqa: BLE001 -- sys.exit() in an exercise is an outcome like any other
        return {"error": _described(error)}


@contextmanager
def _alarm(timeout: float) -> Iterator[None]:
    def ring(*_: object) -> None:
        raise TimesUp

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, timeout, AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def _described(error: BaseException) -> dict[str, Any]:
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__)]
    return {
        "type": type(error).__name__,
        "bases": [base.__name__ for base in type(error).__mro__[1:]],
        "text": str(error)[:4000],
        "line": lines[-1] if lines else None,
    }


def _kind_of_file(path: Path) -> str:
    if not path.is_file():
        return "missing"
    text = path.read_text("utf-8", errors="replace")
    lines = [
        line
        for line in text.splitlines()
        if line.strip() and not line.lstrip().startswith(("#", "<!--", "//"))
    ]
    return "stub" if [line.strip() for line in lines] == ["..."] else "file"


def _finished(command: list[str], folder: str, timeout: float) -> dict[str, Any]:
    started = time.monotonic()
    with (
        tempfile.TemporaryFile() as out,
        tempfile.TemporaryFile() as err,
        subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err, start_new_session=True
        ) as process,
    ):
        try:
            status: int | None = process.wait(timeout)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            _end_group(process.pid)
        took = time.monotonic() - started
        return {"status": status, "out": _text(out), "err": _text(err), "took": took}


def _end_group(leader: int) -> None:
    """End what the command left running in its own session."""
    try:
        os.killpg(leader, signal.SIGKILL)
    except ProcessLookupError:
        return


def _text(stream: IO[bytes]) -> str:
    stream.seek(0)
    return stream.read(PRINTED).decode("utf-8", errors="replace")
