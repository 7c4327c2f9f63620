"""Finds answers that use internal code of the course or inspect other code in their process."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from course_pkg.grading.flags.observations import Observation, Program, unusual
from course_pkg.grading.flags.syntax import docstrings, dotted, is_python, is_too_long
from course_pkg.grading.flags.work import Found, Group
from course_pkg.grading.grade import Flag

TITLE = "Code that inspects other code"
MODULES = frozenset(
    [
        "_thread",
        "code",
        "codeop",
        "ctypes",
        "dis",
        "faulthandler",
        "gc",
        "importlib",
        "inspect",
        "marshal",
        "pdb",
        "pkgutil",
        "runpy",
        "trace",
        "traceback",
        "tracemalloc",
        "zipimport",
    ]
)
OBJECTS = frozenset(
    [
        "os.environ",
        "os.environb",
        "os.getenv",
        "os.putenv",
        "os.unsetenv",
        "sys._current_frames",
        "sys._getframe",
        "sys.addaudithook",
        "sys.exc_info",
        "sys.meta_path",
        "sys.modules",
        "sys.path",
        "sys.path_hooks",
        "sys.setprofile",
        "sys.settrace",
        "threading.setprofile",
        "threading.settrace",
    ]
)
CALLS = frozenset(["__import__", "compile", "eval", "exec", "globals"])
ATTRIBUTES = frozenset(
    [
        "__bases__",
        "__builtins__",
        "__closure__",
        "__code__",
        "__defaults__",
        "__globals__",
        "__self__",
        "__subclasses__",
        "__traceback__",
        "cell_contents",
        "cr_frame",
        "f_back",
        "f_builtins",
        "f_globals",
        "f_locals",
        "gi_frame",
        "tb_frame",
        "tb_next",
        "user_global_ns",
        "user_ns",
    ]
)
PUBLIC = re.compile(r"course_pkg(\.(srv|msg)\b.*)?")  # These packages contain only message and service types.
# IPython converts lines that begin with ! or % into calls of the methods in COMMANDS.
COMMANDS = frozenset(["system", "getoutput", "run_line_magic", "run_cell_magic"])
MODULE = re.compile(r"course_pkg(\.[a-z_]+)+")


def find(group: Group) -> Iterator[Found]:
    """Yield a flag for each place where an answer uses internal code of the course or inspects other code."""
    for work, answer in group.answers():
        if is_python(answer) and is_too_long(answer):
            words = "The code is too long, so it was not searched for suspicious lines."
            yield work, Flag("internals", answer.where, words)
    yield from unusual(group, "internals", _observe, whole_notebook=True)


def _observe(program: Program) -> Iterator[Observation]:
    ignored = docstrings(program.module)
    for node in ast.walk(program.module):
        line = getattr(node, "lineno", 0)
        for name in _imported(node):
            if _is_internal(name):
                yield Observation(name, line, f"The code imports {name}.")
        if isinstance(node, ast.Attribute):
            name = dotted(node, program.names)
            if name in OBJECTS or _is_internal(name):
                yield Observation(name, line, f"The code uses {name}.")
            elif _is_shell(node.value) and node.attr not in COMMANDS:
                yield Observation(f"shell {node.attr}", line, f"The code uses get_ipython().{node.attr}.")
            elif node.attr in ATTRIBUTES:
                yield Observation(node.attr, line, f"The code uses the attribute {node.attr}.")
        elif isinstance(node, ast.Name) and program.names.get(node.id) in OBJECTS:
            yield Observation(program.names[node.id], line, f"The code uses {program.names[node.id]}.")
        elif isinstance(node, ast.Name) and node.id == "__builtins__":
            yield Observation(node.id, line, f"The code uses {node.id}.")
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in CALLS:
            yield Observation(node.func.id, line, f"The code calls {node.func.id}().")
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in ignored:
            yield from _named(node.value, line)


def _imported(node: ast.AST) -> list[str]:
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom) and node.module:
        return [f"{node.module}.{alias.name}" for alias in node.names]
    return []


def _is_shell(node: ast.expr) -> bool:
    """Return whether an expression is a call of get_ipython()."""
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "get_ipython"


def _is_internal(name: str) -> bool:
    """Return whether `name` is a module for inspecting code, or a part of the course."""
    first = name.partition(".")[0]
    return first in MODULES or (first == "course_pkg" and not PUBLIC.fullmatch(name))


def _named(text: str, line: int) -> Iterator[Observation]:
    """Yield an observation for each string that is the name of an internal module or attribute."""
    if MODULE.fullmatch(text) and not PUBLIC.fullmatch(text):
        yield Observation(text, line, f"The code contains the name {text}.")
    elif text in ATTRIBUTES:
        yield Observation(text, line, f"The code contains the name of the attribute {text}.")
