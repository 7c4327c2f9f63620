"""A student's script: its first line, and the line in which an error occurred."""

from __future__ import annotations

import re

from course_pkg.checking.context import CheckContext

MARK = "\ufeff"  # Some editors on Windows write this byte order mark at the beginning of a file.


def require_shebang(
    context: CheckContext,
    path: str,
    *,
    missing: str,
    elsewhere: str = "",
    another: str = "",
    windows: str = "",
    mark: str = "",
    assertion: str = "the first line of the file is #!/usr/bin/env python3",
    program: str = "python3",
) -> None:
    """Assert that the file's first line is a shebang for the right program, and does not use Python 2.

    `program` is the name of the right program.

    `missing`, `elsewhere`, `another`, `windows` and `mark` are hints for five mistakes: no shebang, a shebang
    in another line, another program, Windows line endings, and a byte order mark. If another hint is not
    given, `missing` is used.
    """
    text = context.source(f"file:{path}")
    first = text.partition("\n")[0]
    if "\r" in first:
        hint = windows
    elif mark and first.startswith(MARK):
        hint = mark
    elif first.startswith("#!"):
        hint = another
    else:
        hint = elsewhere if "\n#!" in text or first.lstrip().startswith("#!") else ""
    context.require(
        assertion,
        holds=first.startswith("#!") and program in first and "\r" not in first and "python2" not in first,
        expected="#!/usr/bin/env python3",
        actual=first.replace("\r", "\\r") or "an empty line",
        hints=hint or missing,
    )


def own_line(name: str, printed: str) -> str:
    """Return a hint with the line number of the error in the script `name`, if `printed` contains it."""
    numbers = re.findall(rf'{re.escape(name)}", line (\d+)', printed)
    return (
        f"The error occurred in line {numbers[-1]} of {name}."
        if numbers
        else "An error has ended the program. Start the program in a terminal, and read the whole output."
    )
