"""Fingerprints of code: features that do not depend on names, on comments, or on the order of statements.

There are three kinds of features. The first kind is a statement, with the block that contains it. The second
kind is a pair of statements: one statement sets a name, and the other statement uses this name. The third
kind is the set of all statements of a function or class. The order of statements is ignored: a student who
copies an answer can reorder functions and independent statements.
"""

from __future__ import annotations

import ast
import hashlib
import io
import re
import tokenize
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from course_pkg.grading.flags.statements import Name, Statement, statements_of
from course_pkg.grading.flags.syntax import UNREADABLE, is_python, tree
from course_pkg.grading.flags.tokens import cpp_statements
from course_pkg.grading.flags.work import Answer

# A function, a class or another block with at least `BLOCK` statements is one feature.
BLOCK = 3
# A name in more than `PAIRS` pairs is ignored, because a name that occurs often is not characteristic.
PAIRS = 400
LONG = 12  # A characteristic string has at least this many characters.
LINE = 500  # Comments and strings in longer lines of C++ are ignored.
TEXT = re.compile(r'"([^"]+)"')
COMMENT = re.compile(r"//\s*(.+)|/\*(.+?)\*/")


@dataclass(frozen=True)
class Fingerprint:
    """The features of one answer."""

    statements: int
    code: frozenset[str] = field(default=frozenset())
    # `words` contains the comments and strings of the program, and the names that the program defines.
    words: frozenset[str] = field(default=frozenset())
    # `lines` contains the normal form and the line number of each statement.
    lines: tuple[tuple[str, int], ...] = ()


def fingerprint(answer: Answer) -> Fingerprint:
    """Return the features of an answer, or no features if the answer is not valid Python or C++."""
    try:
        return _fingerprint(answer)
    except UNREADABLE:
        return Fingerprint(0)


def _fingerprint(answer: Answer) -> Fingerprint:
    if is_python(answer):
        module = tree(answer)
        made, words = statements_of(module), set(_python_words(answer.source, module))
    elif answer.path.endswith((".cpp", ".cc", ".h", ".hpp")):
        made, words = cpp_statements(answer.source), set(_cpp_words(answer.source))
    else:
        return Fingerprint(0)
    words |= {f"name {name}" for statement in made for _, name in statement.binds}
    lines = tuple(zip(_single(made), (each.line for each in made), strict=True))
    return Fingerprint(len(made), frozenset(_features(made)), frozenset(words), lines)


def _features(made: list[Statement]) -> Iterator[str]:
    """Yield the features of an answer; a second occurrence of a feature counts as another feature."""
    counts: Counter[str] = Counter()
    for feature in [*_single(made), *_pairs(made), *_blocks(made)]:
        counts[feature] += 1
        yield feature if counts[feature] == 1 else f"{feature} {counts[feature]}"


def _single(made: list[Statement]) -> Iterator[str]:
    for each in made:
        outer = made[each.parent].form.partition("(")[0] if each.parent >= 0 else ""
        yield _digest(f"{outer}>{each.form}")


def _pairs(made: list[Statement]) -> Iterator[str]:
    """Yield each pair of statements in which one statement assigns a name and the other reads it."""
    binds: dict[Name, list[int]] = {}
    uses: dict[Name, list[int]] = {}
    for place, each in enumerate(made):
        for name in each.binds:
            binds.setdefault(name, []).append(place)
        for name in each.uses:
            uses.setdefault(name, []).append(place)
    for name in sorted(binds):
        users = uses.get(name, [])
        if len(binds[name]) * len(users) <= PAIRS:
            pairs = {(a, b) for a in binds[name] for b in users if a != b}
            yield from (_digest(f"{made[a].form}->{made[b].form}") for a, b in sorted(pairs))


def _blocks(made: list[Statement]) -> Iterator[str]:
    inside: dict[int, list[str]] = {}
    for each in made:
        place = each.parent
        while place >= 0:
            inside.setdefault(place, []).append(each.form)
            place = made[place].parent
    for place, forms in inside.items():
        if len(forms) >= BLOCK:
            yield _digest("|".join([made[place].form, *sorted(forms)]))


def _python_words(source: str, module: ast.Module) -> Iterator[str]:
    try:
        for token in tokenize.generate_tokens(io.StringIO(source).readline):
            if token.type == tokenize.COMMENT:
                yield from _long(token.string)
    except (tokenize.TokenError, SyntaxError, ValueError):
        # The tokenizer stops at an IPython magic or an unterminated string. The comments before the error
        # have already been found.
        pass
    for node in ast.walk(module):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield from _long(node.value)


def _cpp_words(source: str) -> Iterator[str]:
    for line in source.splitlines():
        if len(line) <= LINE:
            for comment, block in COMMENT.findall(line):
                yield from _long(comment or block)
            for text in TEXT.findall(line):
                yield from _long(text)


def _long(text: str) -> Iterator[str]:
    words = " ".join(text.strip("#/* \t\n").split())
    if len(words) >= LONG:
        yield f"text {words}"


def _digest(text: str) -> str:
    return hashlib.blake2b(text.encode("utf-8", "surrogatepass"), digest_size=8).hexdigest()
