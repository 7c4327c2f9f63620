"""Whether an exercise is still as it was handed out: a body of `...`."""

from __future__ import annotations

import ast
import inspect
import textwrap
from types import CodeType, FunctionType

from course_pkg.examiner.plain import Value

Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


def is_stub(value: Value) -> bool:
    """Return whether `value` is `...`, or a function or a class in which only `...` is written."""
    if value is ...:
        return True
    if not isinstance(value, (FunctionType, type)):
        return False
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(inspect.unwrap(value))))
    except (OSError, TypeError, SyntaxError):
        return isinstance(value, FunctionType) and _does_nothing(value.__code__)
    definition = tree.body[0] if tree.body else None
    return isinstance(definition, Definition) and is_blank(definition)


def is_blank(definition: Definition) -> bool:
    """Return whether `definition` holds nothing but a docstring and `...`, at every depth."""
    rest = [line for line in definition.body if not _is_placeholder(line)]
    if not isinstance(definition, ast.ClassDef):
        return not rest
    methods = [line for line in rest if isinstance(line, Definition)]
    return bool(methods) and all(is_blank(method) for method in methods)


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
