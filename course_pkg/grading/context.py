"""Which other cells of a notebook an answer needs, told from the names in them.

An answer is run with what its check needs (see examiner/answers.py) and nothing else. A student may have used
more: an import of a cell above, or a function from an earlier answer. So the cells that first give such
names come along, and what they need in turn.
"""

from __future__ import annotations

import ast
import builtins
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

LONGEST = 20_000  # characters of a cell that is looked at: nobody writes more, and parsing takes its time
MAGICAL = 300  # lines of one with magics, for which IPython takes a time that grows with their square
KNOWN = frozenset(dir(builtins)) | {"get_ipython", "display", "In", "Out", "_", "__name__"}


@dataclass(frozen=True)
class _Cell:
    """The names that a cell gives to what comes after it, and those that it looks up and does not give."""

    gives: frozenset[str]
    uses: frozenset[str]


def needed(answer: str, before: str, above: Sequence[str]) -> tuple[str, ...]:
    """Return those of the sources `above` that `answer` needs, in their order; `before` is run anyway."""
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
    tree = _tree(source)
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name)]
    loaded = {node.id for node in names if isinstance(node.ctx, ast.Load)}
    own = {node.id for node in names if isinstance(node.ctx, ast.Store)}
    arguments = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
    gives = _given(tree)
    return _Cell(gives, frozenset(loaded - own - arguments) - gives)


def _tree(source: str) -> ast.Module:
    """Return the tree of a cell, as IPython reads it; of one that is no Python, an empty tree."""
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
    """Return the names that stand at the end of a cell; those inside of a function or a class are its own."""
    names = set()
    for statement in tree.body:
        opens = isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
        for node in [statement] if opens else ast.walk(statement):
            if isinstance(node, ast.Import | ast.ImportFrom):
                names |= {alias.asname or alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                names.add(node.name)
            elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                names.add(node.id)
    return frozenset(names)
