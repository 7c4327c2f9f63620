"""The judge's hands inside the kernel: they look at, read and run what the student defined.

They decide nothing. What they say is believed only as far as the judge can see its effect.
"""

from __future__ import annotations

import difflib
import inspect
import io
import logging
import signal
import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from types import FunctionType
from typing import Any

from course_pkg.building.workspace import workspace_root
from course_pkg.examiner.bench import PRINTED, Bench
from course_pkg.examiner.plain import Plain, Value, plain
from course_pkg.examiner.stub import is_stub

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
        self._bench = Bench(self._file)
        self._held: dict[str, Any] = {}  # what `prepare` made, apart from the student's names
        self._answers: dict[str, Callable[..., dict[str, Any]]] = {
            "look": self._look,
            "read": self._read,
            "source": self._source,
            "prepare": self._prepare,
            "call": self._call,
            "folder": self._bench.folder,
            "run": self._bench.run,
            "start": self._bench.start,
            "poll": self._bench.poll,
            "stop": self._bench.stop,
        }

    def answer(self, question: Mapping[str, Any]) -> dict[str, Any]:
        """Return the answer to one question of the protocol (see link.py)."""
        what = {key: value for key, value in question.items() if key not in ("ask", "do")}
        try:
            answer = self._answers[question["do"]](**what)
        except (LookupError, AttributeError, TypeError, ValueError, OSError) as error:
            answer = {"wrong": f"{type(error).__name__}: {error}"}
        return {"answer": question.get("ask"), **answer}

    def close(self) -> None:
        """End what the judge had started here, and remove its folders."""
        self._bench.close()

    def _file(self, name: str) -> Path:
        """Return where a file of the student's lies: here, or else in the student's workspace."""
        here, there = self._folder / name, workspace_root() / name
        return there if there.exists() and not here.exists() else here

    def _find(self, name: str) -> Value:
        """Return what stands under `name`, which may have dots in it."""
        first, *rest = name.split(".")
        value = self._namespace[first] if first in self._namespace else self._held[first]
        for attribute in rest:
            value = getattr(value, attribute)
        return value

    def _look(self, name: str) -> dict[str, Any]:
        if name.startswith("file:"):
            return _look_at_file(self._file(name.removeprefix("file:")))
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
            return {"text": self._file(name.removeprefix("file:")).read_bytes().decode("utf-8", "replace")}
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


def _look_at_file(path: Path) -> dict[str, Any]:
    """Say what kind of file it is, or which there are in the same folder with names like it."""
    kind = _kind_of_file(path)
    beside = [each.name for each in path.parent.glob("*")] if kind == "missing" else []
    return {"kind": kind, "alike": difflib.get_close_matches(path.name, beside, n=2)}


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
