"""Removes the answer from an exercise cell.

Three rules remove the answer. The rest of the cell does not change.

1. `...` replaces the body of a function or method; a docstring is kept.
2. `name = value` at the top level becomes `name = ...`. A line such as `counter = Counter()` does not change
   if the same cell defines `Counter`, because the line contains no part of the answer.
3. The line `%%writefile` at the top of a cell does not change. If the cell writes a Python file, rules 1 and
   2 apply to the file. In any other file, only the comment lines at the top remain, and `...` replaces the
   other lines.

In some exercises, students repair a text. The student's cell then contains the wrong text, which is the
attribute `start` of the part (see checking/parts.py). The check fails if the text is unchanged.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from typing import NamedTuple

from course_pkg.checking.parts import start_of
from course_pkg.errors import AuthoringError

COMMENT = ("#", "//", "<!--")
PYTHON_MAGICS = ("%%time", "%%timeit", "%%capture")
MAGIC = re.compile(r"(?P<before>\s*(?:[\w, ]+=\s*)?)(?P<magic>[%!].*|[\w.]+\?{1,2}\s*)$")
Function = ast.FunctionDef | ast.AsyncFunctionDef


class Edit(NamedTuple):
    """A replacement: `text` replaces the bytes from `start` to `end` (without the byte at `end`)."""

    start: int
    end: int
    text: bytes


def handed_out(exercise: str, source: str) -> str:
    """Return the source of the exercise cell in the student's notebook.

    `exercise` is the id of the part, such as "05.1", and `source` is the source of the solution. Raises
    AuthoringError if no rule applies to the solution.
    """
    return start_of(exercise).strip("\n") or blank(source)


def blank(source: str) -> str:
    """Return the source of an exercise cell without the answer.

    Raises AuthoringError if no rule applies to the cell.
    """
    first, newline, rest = source.partition("\n")
    if not first.startswith("%%"):
        return _blank_python(source)
    magic, _, path = first.partition(" ")
    if magic in PYTHON_MAGICS or (magic == "%%writefile" and path.strip().endswith(".py")):
        return first + newline + _blank_python(rest)
    if magic == "%%writefile":
        return first + newline + _blank_text(rest)
    raise AuthoringError(
        f"An exercise cell cannot begin with {magic}, because the course cannot remove the answer from "
        "such a cell."
    )


def _blank_text(text: str) -> str:
    kept = []
    for line in text.split("\n"):
        if not line.lstrip().startswith(COMMENT):
            break
        kept.append(line)
    return "\n".join([*kept, "..."])


def _blank_python(source: str) -> str:
    cell = _Cell(source)
    edits = sorted(cell.edits(), reverse=True)
    data = cell.data
    for start, end, text in edits:
        data = data[:start] + text + data[end:]
    return data.decode()


class _Cell:
    """The source of a cell as bytes, and its syntax tree.

    The source is stored as bytes, because `ast` counts columns in bytes.
    """

    def __init__(self, source: str) -> None:
        self.data = source.encode()
        self._lines = self.data.splitlines(keepends=True)
        self._starts = [0]
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line))
        self._text, self._tree = _parsed(source)
        self._defined = {node.name for node in self._tree.body if isinstance(node, Function | ast.ClassDef)}

    def edits(self) -> Iterator[Edit]:
        """Yield the replacements for rules 1 and 2 in the docstring of this module."""
        for node in self._tree.body:
            yield from self._rule_1(node)
            if isinstance(node, ast.Assign | ast.AnnAssign):
                yield from self._rule_2(node)

    def _rule_1(self, node: ast.stmt) -> Iterator[Edit]:
        if isinstance(node, ast.ClassDef):
            for inner in node.body:
                yield from self._rule_1(inner)
        if isinstance(node, Function):
            kept = self._end_of_kept(node)
            yield Edit(kept, self._end_of_body(node), self._placeholder(node, kept))

    def _rule_2(self, node: ast.Assign | ast.AnnAssign) -> Iterator[Edit]:
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        dots = [_dots(target) for target in targets]
        if node.value is None or not all(dots) or self._wires_up(node.value):
            return
        last = node.annotation if isinstance(node, ast.AnnAssign) else targets[-1]
        equals = self.data.index(b"=", self._end(last))
        yield Edit(equals + 1, self._end(node), b" " + max(dots, key=len).encode())

    def _wires_up(self, value: ast.expr) -> bool:
        called = value.func if isinstance(value, ast.Call) else None
        return isinstance(called, ast.Name) and called.id in self._defined

    def _end_of_kept(self, node: Function) -> int:
        """Return the position after the signature, the docstring, and a comment that follows them."""
        documented = ast.get_docstring(node, clean=False) is not None
        end = self._end(node.body[0]) if documented else self._end_of_signature(node)
        rest = self.data[end:].split(b"\n", 1)[0]
        return end + len(rest) if rest.strip().startswith(b"#") else end

    def _end_of_signature(self, node: Function) -> int:
        """Return the position after the colon that ends the signature.

        The signature ends with the first colon that is outside of brackets and annotations.
        """
        after = (node.returns or node).end_lineno or 0, self._column(node.returns) if node.returns else 0
        depth = 0
        for token in tokenize.generate_tokens(io.StringIO(self._text).readline):
            if token.start < (node.lineno, 0) or token.type != tokenize.OP:
                continue
            depth += (token.string in "([{") - (token.string in ")]}")
            if token.string == ":" and depth == 0 and (not node.returns or token.start >= after):
                return self._offset(*token.end)
        raise AuthoringError(f"The signature of {node.name} has no colon at its end.")

    def _end_of_body(self, node: Function) -> int:
        """Return the position after the body and after the indented comments that follow the body."""
        last = node.body[-1].end_lineno or node.lineno
        for number in range(last, len(self._lines)):
            line = self._lines[number]
            if line.strip() and not self._is_comment_inside(line, node):
                break
            last = number + 1 if line.strip() else last
        return self._starts[last - 1] + len(self._lines[last - 1].rstrip(b"\r\n"))

    def _is_comment_inside(self, line: bytes, node: Function) -> bool:
        return line.lstrip().startswith(b"#") and len(line) - len(line.lstrip()) > node.col_offset

    def _placeholder(self, node: Function, kept: int) -> bytes:
        first = node.body[0]
        line = self._lines[first.lineno - 1][: first.col_offset]
        if line.strip():  # The body is on the same line as the signature.
            return b"; ..." if kept == self._end(first) else b" ..."
        return b"\n" + line + b"..."

    def _end(self, node: ast.AST) -> int:
        return self._starts[node.end_lineno - 1] + node.end_col_offset  # type: ignore[attr-defined,no-any-return]

    def _column(self, node: ast.expr) -> int:
        """Return the column after the syntax node `node`, counted in characters.

        `tokenize` counts characters, but `ast` counts bytes.
        """
        line = self._lines[(node.end_lineno or 1) - 1]
        return len(line[: node.end_col_offset].decode())

    def _offset(self, line: int, column: int) -> int:
        text = self._lines[line - 1].decode()
        return self._starts[line - 1] + len(text[:column].encode())


def _dots(target: ast.expr) -> str:
    """Return the text that replaces the values of an assignment: one `...` for each name in `target`.

    Return "" if `target` contains anything except names.
    """
    if isinstance(target, ast.Starred):
        return _dots(target.value)
    if isinstance(target, ast.Tuple | ast.List):
        inner = [_dots(item) for item in target.elts]
        nested = [f"({text})" if "," in text else text for text in inner]
        return ", ".join(nested) + ("," if len(inner) == 1 else "") if all(inner) else ""
    return "..." if isinstance(target, ast.Name) else ""


def _parsed(source: str) -> tuple[str, ast.Module]:
    """Parse the text `source`; return the text that was parsed, and its syntax tree.

    If `source` is not valid Python, first replace each part that only IPython understands with a name of the
    same length. Raises AuthoringError if the text after these replacements is not valid Python.
    """
    try:
        return source, ast.parse(source)
    except SyntaxError:
        masked = "\n".join(_masked(line) for line in source.split("\n"))
    try:
        return masked, ast.parse(masked)
    except SyntaxError as error:
        raise AuthoringError(f"Line {error.lineno} is not valid Python: {error.msg}.") from error


def _masked(line: str) -> str:
    """Return a line in which underscores replace an IPython magic, a shell command or `name?`.

    The length of the line in bytes does not change.
    """
    found = MAGIC.match(line)
    if not found:
        return line
    return found["before"] + "_" * len(found["magic"].encode())
