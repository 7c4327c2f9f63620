"""The statements of a C++ program, in the same normal form as Python statements."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from pygments.lexers.c_cpp import CppLexer
from pygments.token import Comment, Keyword, Name, String, Text, _TokenType

from course_pkg.grading.flags.statements import Statement

LEADS = ("&", "*", ">", "auto")  # These tokens can occur between a type and the name that it declares.
OPENS, CLOSES, ENDS = "{", "}", ";"


@dataclass(frozen=True)
class _Token:
    kind: _TokenType
    text: str
    line: int


def cpp_statements(source: str) -> list[Statement]:
    """Return the statements of a C++ program.

    A line that begins with # is a statement. A semicolon or a brace ends any other statement.
    """
    every = list(_tokens(source))
    directives = {token.line for token in every if token.text.lstrip().startswith("#")}
    tokens = [token for token in every if token.line not in directives]
    own = {token.text for before, token, after in _neighbours(tokens) if _declares(before, token, after)}
    made = [
        _statement([token for token in every if token.line == line], set(), -1) for line in sorted(directives)
    ]
    open_blocks: list[int] = []
    current: list[_Token] = []
    for token in tokens:
        if token.text in (OPENS, CLOSES, ENDS):
            if current:
                made.append(_statement(current, own, open_blocks[-1] if open_blocks else -1))
                current = []
            if token.text == OPENS:
                open_blocks.append(len(made) - 1)
            elif token.text == CLOSES and open_blocks:
                open_blocks.pop()
        else:
            current.append(token)
    return made


def _tokens(source: str) -> Iterator[_Token]:
    line = 1
    for kind, text in CppLexer(stripnl=False, ensurenl=False).get_tokens(source):
        directive = kind in Comment.Preproc or kind in Comment.PreprocFile
        if text.strip() and (directive or not (kind in Comment or kind in Text)):
            yield _Token(kind, text, line)
        line += text.count("\n")


def _neighbours(tokens: list[_Token]) -> Iterator[tuple[_Token | None, _Token, _Token | None]]:
    for place, token in enumerate(tokens):
        before = tokens[place - 1] if place else None
        yield before, token, tokens[place + 1] if place + 1 < len(tokens) else None


def _declares(before: _Token | None, token: _Token, after: _Token | None) -> bool:
    """Return whether the program declares the name `token`: a declared name comes directly after a type."""
    if before is None or after is None or token.kind not in Name or after.text in (":", "<"):
        return False
    typed = before.kind in Keyword.Type or before.kind in Name or before.text in LEADS
    return typed and after.text in ("(", "=", ";", ",", ")", "{", "[")


def _statement(tokens: list[_Token], own: set[str], parent: int) -> Statement:
    made = Statement("", tokens[0].line, parent)
    forms = []
    before = ""
    for token in tokens:
        if token.kind in String:
            form = "S" if before != "S" else ""
        elif token.kind in Name and token.text in own and before not in (".", ":"):
            form = "V"
            made.uses.add((0, token.text))
            made.binds.add((0, token.text))
        else:
            form = token.text
        forms += [form] if form else []
        before = form or before
    made.form = " ".join(forms)
    return made
