"""Finds answers that change a module or an imported class, and so change the behaviour of other code."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from course_pkg.grading.flags.observations import Observation, Program, unusual
from course_pkg.grading.flags.syntax import dotted
from course_pkg.grading.flags.work import Found, Group

TITLE = "Code that changes modules"
SETTERS = frozenset(["setattr", "delattr"])
METHODS = frozenset(["__setattr__", "__delattr__"])
PATCHERS = ("unittest.mock", "mock.", "importlib.reload")
UPDATES = frozenset(["update", "setdefault", "pop", "clear", "__setitem__"])


def find(group: Group) -> Iterator[Found]:
    """Yield a flag for each place where an answer sets an attribute of an imported object."""
    yield from unusual(group, "patches", _observe, whole_notebook=True)


def _observe(program: Program) -> Iterator[Observation]:
    for node in ast.walk(program.module):
        if isinstance(node, ast.Attribute | ast.Subscript) and not isinstance(node.ctx, ast.Load):
            if name := _changed(node, program):
                yield Observation(f"change {name}", node.lineno, f"The code changes {name}.")
        elif isinstance(node, ast.Call):
            yield from _called(node, program)
    yield from _replaced(program)


def _changed(node: ast.Attribute | ast.Subscript, program: Program) -> str:
    """Return the name of the imported object that an assignment changes, or ""."""
    if isinstance(node, ast.Attribute):
        return _name(node, program)
    inside = _name(node.value, program)
    if inside.endswith(".__dict__") or inside in ("sys.modules", "__builtins__"):
        return inside
    called = node.value.func if isinstance(node.value, ast.Call) else None
    if isinstance(called, ast.Name) and called.id in ("vars", "globals"):
        arguments = node.value.args if isinstance(node.value, ast.Call) else []
        return _name(arguments[0], program) if arguments else "globals()"
    return ""


def _name(node: ast.expr, program: Program) -> str:
    """Return the full name of an imported object, or "" for any other expression."""
    if isinstance(node, ast.Attribute) and not dotted(node, program.names):
        inside = _name(node.value, program)
        return f"{inside}.{node.attr}" if inside else ""
    if isinstance(node, ast.Name) and node.id == "__builtins__":
        return node.id
    return dotted(node, program.names)


def _called(node: ast.Call, program: Program) -> Iterator[Observation]:
    function = node.func
    full = dotted(function, program.names)
    if full.startswith(PATCHERS):
        yield Observation(full, node.lineno, f"The code calls {full}(), which replaces objects in modules.")
    sets = isinstance(function, ast.Name) and function.id in SETTERS
    sets = sets or (isinstance(function, ast.Attribute) and function.attr in METHODS)
    if sets and node.args and (name := _name(node.args[0], program)):
        yield Observation(f"change {name}", node.lineno, f"The code changes an attribute of {name}.")
    if isinstance(function, ast.Attribute) and function.attr in UPDATES:
        inside = _name(function.value, program)
        if inside.endswith(".__dict__") or inside == "sys.modules":
            yield Observation(f"change {inside}", node.lineno, f"The code changes {inside}.")


def _replaced(program: Program) -> Iterator[Observation]:
    """Yield an observation if the answer replaces an imported module, for example with `rospy = Fake()`."""
    modules = {name for name, full in program.names.items() if name == full}
    for node in program.module.body:
        targets = node.targets if isinstance(node, ast.Assign) else []
        for target in targets:
            if isinstance(target, ast.Name) and target.id in modules:
                words = f"The code assigns another object to {target.id}, which is the name of a module."
                yield Observation(f"replace {target.id}", node.lineno, words)
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name in modules:
            words = f"The code assigns another object to {node.name}, which is the name of a module."
            yield Observation(f"replace {node.name}", node.lineno, words)
