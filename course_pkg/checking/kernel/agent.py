"""The kernel agent: it reads and runs the student's code when the check runner requests this.

Student code can forge a reply. The check runner therefore trusts a reply only if the runner itself observes
the effect, such as a message.
"""

from __future__ import annotations

import ast
import builtins
import difflib
import inspect
import io
import logging
import sys
import textwrap
import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from types import CodeType, FunctionType

from course_pkg.checking.commands.workbench import PRINTED, CommandFolders
from course_pkg.checking.kernel.handler_errors import HandlerErrors
from course_pkg.checking.kernel.object_proxy import ObjectProxies
from course_pkg.checking.kernel.older_code import LaterRun, OlderCode
from course_pkg.checking.kernel.time_limit import TimeLimit, TimesUp
from course_pkg.checking.plain_values import Reply, Value, plain
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.workspace import own_workspace

# Student code that runs later can replace names in `builtins`, but not these classes.
BUILT_IN = {name: each for name, each in vars(builtins).items() if isinstance(each, type)}


class PrintedText(io.TextIOBase):
    """Replaces stdout and stderr, and stores the beginning of the printed text."""

    def __init__(self) -> None:
        self.text = ""

    def writable(self) -> bool:
        """Return True, because this object accepts text."""
        return True

    def write(self, text: str) -> int:
        """Store the text; the total length is limited to `PRINTED` characters."""
        self.text += text[: max(PRINTED - len(self.text), 0)]
        return len(text)


class KernelAgent:
    """Replies to the check runner's requests about names in the kernel and about the student's files."""

    def __init__(
        self,
        namespace: Mapping[str, Value],
        folder: Path | None = None,
        later_run: LaterRun = lambda _source: None,
    ) -> None:
        self._namespace = namespace
        self._older = OlderCode(namespace, later_run)
        self._folder = folder or Path.cwd()
        self._commands = CommandFolders(self._file)
        self._handler_errors = HandlerErrors()
        self._handler_errors.open()
        # The names that `prepare` and `place` define are separate from the student's names.
        self._prepared: dict[str, Value] = {}
        self._proxies: ObjectProxies | None = None
        self._handlers: dict[str, Callable[..., Reply]] = {
            "look": self._look,
            "served": self._served,
            "traceback": self._traceback,
            "read": self._read,
            "source": self._source,
            "prepare": self._prepare,
            "place": self._place,
            "call": self._call,
            "folder": self._commands.folder,
            "run": self._commands.run,
            "start": self._commands.start,
            "poll": self._commands.poll,
            "stop": self._commands.stop,
            "ports": self._commands.ports,
            "programs": self._commands.programs,
        }

    def reply(self, request: Mapping[str, Json]) -> Reply:
        """Return the reply to one request of the protocol (see channel.py)."""
        arguments = {key: value for key, value in request.items() if key not in ("ask", "do")}
        try:
            reply = self._handlers[str(request["do"])](**arguments)
        except (LookupError, AttributeError, TypeError, ValueError, OSError) as error:
            reply = {"wrong": f"{type(error).__name__}: {error}"}
        return {"answer": request.get("ask"), **reply}

    def close(self) -> None:
        """End the commands of the check in this kernel, delete the check's folders, and close the proxies."""
        self._handler_errors.close()
        if self._proxies is not None:
            self._proxies.close()
        self._commands.close()

    def _file(self, name: str) -> Path:
        """Return the path of a student's file in the notebook's folder, or else in the workspace."""
        here, there = self._folder / name, own_workspace() / name
        return there if there.exists() and not here.exists() else here

    def _find(self, name: str) -> Value:
        """Return the value of the name `name`, which may be a dotted name, such as "robot.speed".

        A student's name cannot replace a name that the check has prepared.
        """
        first, *rest = name.split(".")
        value = self._prepared[first] if first in self._prepared else self._namespace[first]
        for attribute in rest:
            value = getattr(value, attribute)
        return value

    def _look(self, name: str) -> Reply:
        if name.startswith("file:"):
            return _look_at_file(self._file(name.removeprefix("file:")))
        if name not in self._namespace:
            own = [known for known, value in self._namespace.items() if _defined_here(known, value)]
            return {"kind": "missing", "alike": [*difflib.get_close_matches(name, own, n=2)]}
        value = self._namespace[name]
        if is_blank(value):
            return {"kind": "blank", "alike": []}
        kinds = {FunctionType: "function", type: "class"}
        kind = kinds.get(type(value), "value")
        return {"kind": kind, "alike": [], "older": self._older.of_value(name, value)}

    def _served(self, name: str) -> Reply:
        return {"older": self._older.of_service(name)}

    def _traceback(self) -> Reply:
        return {"text": self._handler_errors.take()}

    def _read(self, name: str) -> Reply:
        return {"value": plain(self._find(name))}

    def _source(self, name: str) -> Reply:
        if name.startswith("file:"):
            return {"text": self._file(name.removeprefix("file:")).read_bytes().decode("utf-8", "replace")}
        return {"text": inspect.getsource(self._find(name))}

    def _call(self, name: str, args: list[Json], kwargs: dict[str, Json], within: float) -> Reply:
        printed = PrintedText()
        started = time.monotonic()
        values = [self._argument(value) for value in args]
        named = {key: self._argument(value) for key, value in kwargs.items()}
        with redirect_stdout(printed), redirect_stderr(printed), _ros_console(printed):
            result = _result(lambda: self._find(name)(*values, **named), within)
        return {**result, "printed": printed.text, "took": time.monotonic() - started}

    def _argument(self, value: Json) -> Value:
        return self._find(str(value["its"])) if isinstance(value, dict) and value.keys() == {"its"} else value

    def _prepare(self, code: str, within: float) -> Reply:
        """Run the check's own `code`; the names that `code` defines can be arguments of later calls."""
        result = _result(lambda: exec(code, self._prepared), within)  # noqa: S102 -- it is the course's code
        return {"error": result.get("error")}

    def _place(self, name: str, port: int, key: str, item: dict[str, Json]) -> Reply:
        """Define the name `name` as a proxy for an object of the check runner."""
        if self._proxies is None:
            self._proxies = ObjectProxies(port, key)
        self._prepared[name] = self._proxies.proxy(item)
        return {}


@contextmanager
def _ros_console(stream: io.TextIOBase) -> Iterator[None]:
    """Let rospy's log print to `stream`, not to the streams that existed at the start of rospy."""
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


def _result(function: Callable[[], Value], timeout: float) -> Reply:
    """Call a function, interrupt it after `timeout` s, and return {"value": …} or {"error": …}.

    The call runs in the main thread, because an alarm can interrupt only the main thread. If a call in
    another thread did not end, it could disturb the next check.
    """
    try:
        return {"value": TimeLimit(timeout).call(lambda: plain(function()))}
    except TimesUp:
        return {
            "error": {"type": "TimesUp", "bases": [], "text": f"the call did not end within {timeout:g} s"}
        }
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # noqa: BLE001 -- an exercise may call sys.exit(), which is a result, too
        return {"error": _described(error)}


def _described(error: BaseException) -> Json:
    called = traceback.walk_tb(error.__traceback__)
    # Use only the lines of cells. The module name `__main__` belongs only to the code of cells.
    lines = [line for frame, line in called if frame.f_globals.get("__name__") == "__main__"]
    return {
        "type": _class_name(type(error)),
        "bases": [_class_name(base) for base in type(error).__mro__[1:]],
        "text": str(error)[:4000],
        "line": lines[-1] if lines else None,
    }


def _class_name(cls: type) -> str:
    """Return the name of a class, with its module if another class of Python or rospy has the same name."""
    name = cls.__name__
    known = BUILT_IN.get(name) or getattr(sys.modules.get("rospy"), name, cls)
    return name if known is cls else f"{cls.__module__}.{name}"


def _defined_here(name: str, value: Value) -> bool:
    """Return whether the student may have defined `name`; imported names and IPython's names do not count."""
    return not name.startswith("_") and (
        not isinstance(value, FunctionType | type) or value.__module__ == "__main__"
    )


def is_blank(value: Value) -> bool:
    """Return whether an exercise is unchanged: its value is `...`, or the body of its function is `...`."""
    if isinstance(value, type):
        # `inspect` cannot find the source of a class in a notebook, so each method is examined instead.
        methods = [inspect.unwrap(method) for method in _methods(value)]
        return bool(methods) and all(is_blank(method) for method in methods)
    if isinstance(value, FunctionType):
        return _is_blank_function(value)
    return value is ...


def _methods(cls: type) -> list[FunctionType]:
    wrapped = (getattr(value, "__func__", getattr(value, "fget", value)) for value in vars(cls).values())
    return [value for value in wrapped if isinstance(value, FunctionType)]


def _is_blank_function(function: FunctionType) -> bool:
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(inspect.unwrap(function))))
    except (OSError, TypeError, SyntaxError):
        return _does_nothing(function.__code__)
    definition = tree.body[0] if tree.body else None
    if not isinstance(definition, ast.FunctionDef | ast.AsyncFunctionDef):
        return False  # The function is a lambda.
    return all(_is_placeholder(line) for line in definition.body)


def _is_placeholder(line: ast.stmt) -> bool:
    return (
        isinstance(line, ast.Expr)
        and isinstance(line.value, ast.Constant)
        and (line.value.value is ... or isinstance(line.value.value, str))
    )


def _does_nothing(code: CodeType) -> bool:
    """Return whether the compiled code of a function does nothing.

    is_blank() calls this function if it cannot read the source of a student's function.
    """
    blank = _nothing.__code__
    return code.co_code == blank.co_code and not code.co_names


def _nothing() -> None: ...


def _look_at_file(path: Path) -> Reply:
    """Return the kind of a file ("file", "blank" or "missing"), and similar names if the file is missing."""
    kind = _kind_of_file(path)
    beside = [each.name for each in path.parent.glob("*")] if kind == "missing" else []
    return {"kind": kind, "alike": [*difflib.get_close_matches(path.name, beside, n=2)]}


def _kind_of_file(path: Path) -> str:
    if not path.is_file():
        return "missing"
    text = path.read_text("utf-8", errors="replace")
    comments = ("#", "<!--", "//")
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return "blank" if [line for line in lines if not line.startswith(comments)] == ["..."] else "file"
