"""The syntax tree of an answer in Python, and the imported objects to which its names refer."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping

from course_pkg.grading.flags.work import Answer
from course_pkg.grading.rebuild.context import LONGEST, tree_of

# The parser raises the errors in `UNREADABLE` for code that is nested too deeply, or contains a huge number.
UNREADABLE = (RecursionError, ValueError, MemoryError)
Function = ast.FunctionDef | ast.AsyncFunctionDef


def is_python(answer: Answer) -> bool:
    """Return whether an answer is a cell that runs as Python, or a file with a Python program."""
    if not answer.path:
        return True
    return answer.path.endswith(".py") or "python" in _body(answer).lstrip("\n").partition("\n")[0]


def is_too_long(answer: Answer) -> bool:
    """Return whether an answer is too long to be parsed."""
    return len(answer.source) > LONGEST


def tree(answer: Answer) -> ast.Module:
    """Return the syntax tree of an answer; line numbers are the line numbers of the cell or file.

    The tree is empty if the answer is not Python, too long, or too deeply nested.
    """
    return tree_of(_body(answer)) if is_python(answer) else ast.Module(body=[], type_ignores=[])


def line_of(answer: Answer, number: int) -> str:
    """Return the line `number` of the answer, without indentation."""
    lines = answer.source.splitlines()
    return lines[number - 1].strip() if 0 < number <= len(lines) else ""


def imports(trees: Iterable[ast.Module]) -> dict[str, str]:
    """Return the full name for each imported name, such as "std_srvs.srv.Trigger" for "Trigger"."""
    found: dict[str, str] = {}
    for each in trees:
        for node in ast.walk(each):
            if isinstance(node, ast.Import):
                for alias in node.names:
                    first = alias.name.partition(".")[0]
                    found[alias.asname or first] = alias.name if alias.asname else first
            elif isinstance(node, ast.ImportFrom) and node.module:
                for alias in node.names:
                    found[alias.asname or alias.name] = f"{node.module}.{alias.name}"
    return found


def aliases(module: ast.Module, known: Mapping[str, str]) -> dict[str, str]:
    """Return the mapping `known`, plus the names in `module` that refer to imported objects.

    For example, after `file = Path("x")`, the result contains "pathlib.Path" for "file". A search then finds
    calls of the path's methods.
    """
    names = {**known, **imports([module])}
    assigned = [node for node in ast.walk(module) if isinstance(node, ast.Assign)]
    for node in assigned:
        full = dotted(node.value, names)
        if isinstance(node.value, ast.Call) and dotted(node.value.func, names).startswith("pathlib."):
            full = dotted(node.value.func, names)
        if full:
            names |= {target.id: full for target in node.targets if isinstance(target, ast.Name)}
    return names


def dotted(node: ast.expr, names: Mapping[str, str]) -> str:
    """Return the full name of an imported object, such as "threading.Lock", or "" for other expressions."""
    attributes: list[str] = []
    while isinstance(node, ast.Attribute):
        attributes.append(node.attr)
        node = node.value
    if not isinstance(node, ast.Name) or node.id not in names:
        return ""
    return ".".join([names[node.id], *reversed(attributes)])


def docstrings(module: ast.Module) -> set[int]:
    """Return the ids (see id()) of the nodes that are docstrings."""
    first = [statement for body in _bodies(module) for statement in body[:1]]
    return {id(each.value) for each in first if isinstance(each, ast.Expr) and is_text(each)}


def is_text(statement: ast.stmt) -> bool:
    """Return whether a statement consists of a constant, such as a docstring or `...`."""
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _bodies(module: ast.Module) -> Iterator[list[ast.stmt]]:
    for node in ast.walk(module):
        if isinstance(node, ast.Module | ast.ClassDef | Function):
            yield node.body


def _body(answer: Answer) -> str:
    """Return the source with an empty line in place of a cell magic (%%…) in the first line."""
    if answer.path and answer.source.lstrip().startswith("%%"):
        return "\n" + answer.source.lstrip().partition("\n")[2]
    return answer.source
