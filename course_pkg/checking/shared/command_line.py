"""Split a command line from a student's function with the rules of a shell."""

from __future__ import annotations

import re
import shlex

from course_pkg.ros.protocol.json_channel import Json

OPERATORS = "();<>|&"


def substitutes(line: str) -> bool:
    """Return whether bash runs another command for a part of `line`: a $(…), a `…` or a <(…).

    Text in single quotes and a character after a backslash do not count, because bash replaces nothing there.
    """
    quoted = re.compile(r"""\\.|'[^']*'|("(?:\\.|[^"\\])*")""", re.DOTALL)
    bare = quoted.sub(lambda found: re.sub(r"\\.", "", found[1] or ""), line)
    return re.search(r"\$\(|`|[<>]\(", bare) is not None


def commands_of(line: Json) -> list[list[str]]:
    """Return the name and the arguments of each command in a pipe, without comments and without a final &.

    The list is empty if `line` is not a string, if a quotation mark is missing, or if the line contains
    another operator, such as `;` or `&&`.
    """
    if not isinstance(line, str):
        return []
    lexer = shlex.shlex(line.strip().removesuffix("&"), posix=True, punctuation_chars=OPERATORS)
    lexer.whitespace_split = True
    commands: list[list[str]] = [[]]
    try:
        for word in lexer:
            if word == "|":
                commands.append([])
            elif word and not word.strip(OPERATORS):
                return []
            else:
                commands[-1].append(word)
    except ValueError:
        return []
    return commands
