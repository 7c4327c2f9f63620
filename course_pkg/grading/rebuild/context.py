"""Finds the cells that define the names in an answer.

An answer is run only with the cells that its check needs (see checking/fixtures.py). However, an answer can
also use names from other cells, such as an import in a cell above or a function of an earlier answer.
Therefore, the cells that define these names also run. These cells can use names that other cells define; then
the other cells run, too.
"""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass

# A cell with more than `LONGEST` characters is not parsed, because the parsing would take too much time.
LONGEST = 20_000
# A cell with magics and more than `MAGICAL` lines is not parsed, because IPython's time grows with the square
# of the number of lines.
MAGICAL = 300
# The syntax nodes in `SCOPES` have a separate scope: later cells cannot use the names that are assigned in
# them.
SCOPES = (
    *(ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda),
    *(ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp),
)
KNOWN = frozenset(dir(builtins)) | {"get_ipython", "display", "In", "Out", "_", "__name__"}


@dataclass(frozen=True)
class _Cell:
    """The names that a cell defines for later cells, and the names that the cell uses but does not define."""

    gives: frozenset[str]
    uses: frozenset[str]


def needed(answer: str, before: str, above: Sequence[str]) -> tuple[str, ...]:
    """Return the sources of the cells in `above` that the code `answer` needs, in their order.

    The code in `before` always runs, so the names that it defines need no other cell.
    """
    given = KNOWN | _read(before).gives
    cells = [_read(source) for source in above]
    chosen: set[int] = set()
    todo = [(_read(answer), len(above))]
    while todo:
        cell, end = todo.pop()
        for name in cell.uses - given:
            found = next((n for n in range(end - 1, -1, -1) if name in cells[n].gives), None)
            if found is not None and found not in chosen:
                chosen.add(found)
                todo.append((cells[found], found))
    return tuple(above[number] for number in sorted(chosen))


def _read(source: str) -> _Cell:
    tree = tree_of(source)
    nodes = list(ast.walk(tree))
    loaded = {node.id for node in nodes if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}
    arguments = {node.arg for node in nodes if isinstance(node, ast.arg)}
    return _Cell(_given(tree), frozenset(loaded - _bound(nodes) - arguments))


def tree_of(source: str) -> ast.Module:
    """Parse a cell in the same way as IPython, and return the syntax tree.

    If the cell is not Python, the tree is empty.
    """
    from IPython.core.inputtransformer2 import TransformerManager

    empty = ast.Module(body=[], type_ignores=[])
    if len(source) > LONGEST:
        return empty
    with suppress(SyntaxError, ValueError, RecursionError, MemoryError):
        return ast.parse(source)
    if source.count("\n") > MAGICAL:
        return empty
    with suppress(SyntaxError, ValueError, RecursionError, MemoryError):
        return ast.parse(TransformerManager().transform_cell(source))
    return empty


def _given(tree: ast.Module) -> frozenset[str]:
    """Return the names that a cell defines outside functions, classes and comprehensions."""
    nodes: list[ast.AST] = []
    todo: list[ast.AST] = list(tree.body)
    while todo:
        node = todo.pop()
        nodes.append(node)
        if not isinstance(node, SCOPES):
            todo += ast.iter_child_nodes(node)
    # Python deletes the name of a caught exception at the end of the `except` clause.
    return _bound(node for node in nodes if not isinstance(node, ast.ExceptHandler))


def _bound(nodes: Iterable[ast.AST]) -> frozenset[str]:
    """Return the names that the syntax nodes assign, import or define, and the names of caught exceptions."""
    names: set[str | None] = set()
    for node in nodes:
        if isinstance(node, ast.Import | ast.ImportFrom):
            names |= {alias.asname or alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.ExceptHandler):
            names.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
    return frozenset(name for name in names if name)
