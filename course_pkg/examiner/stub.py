"""Whether an exercise is still as it was handed out: a body of `...`."""

from __future__ import annotations

import ast
import inspect
import textwrap
from types import CodeType, FunctionType

from course_pkg.examiner.plain import Value


def is_stub(value: Value) -> bool:
    """Return whether `value` is `...`, or a function or a class in which only `...` is written."""
    if isinstance(value, type):
        # A class is asked method by method: `inspect` finds no source of a class that a notebook defines.
        methods = [inspect.unwrap(method) for method in _methods(value)]
        return bool(methods) and all(is_stub(method) for method in methods)
    if isinstance(value, FunctionType):
        return _is_stub_function(value)
    return value is ...


def _methods(cls: type) -> list[FunctionType]:
    wrapped = (getattr(value, "__func__", getattr(value, "fget", value)) for value in vars(cls).values())
    return [value for value in wrapped if isinstance(value, FunctionType)]


def _is_stub_function(function: FunctionType) -> bool:
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(inspect.unwrap(function))))
    except (OSError, TypeError, SyntaxError):
        return _does_nothing(function.__code__)
    definition = tree.body[0] if tree.body else None
    if not isinstance(definition, ast.FunctionDef | ast.AsyncFunctionDef):
        return False  # a lambda
    return all(_is_placeholder(line) for line in definition.body)


def _is_placeholder(line: ast.stmt) -> bool:
    return (
        isinstance(line, ast.Expr)
        and isinstance(line.value, ast.Constant)
        and (line.value.value is ... or isinstance(line.value.value, str))
    )


def _does_nothing(code: CodeType) -> bool:
    """Judge by the code alone, for a function whose source is gone."""
    blank = _nothing.__code__
    return code.co_code == blank.co_code and not code.co_names


def _nothing() -> None: ...
