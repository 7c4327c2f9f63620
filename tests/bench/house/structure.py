"""Measures the size and the structure of the code, and compares each number with its limit."""

from __future__ import annotations

import ast
import io
import re
import statistics
import subprocess
import sys
import tokenize
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from course_pkg.checking.parts import chapters, folder_of
from tests.checking.answers.example_answers import read_answers
from tests.checking.answers.hints import hints_of, not_shown
from tests.setup.test_locks import undeclared

ROOT = Path(__file__).parents[3]
BARS = {
    "lines of Python": 60_000,
    "lines of example answers": 7_000,
    "files": 480,
    "modules in the fullest folder": 15,
    "import circles": 0,
    "upward imports": 0,
    "undeclared distributions": 0,
    "uses of Any": 150,
    "function length, median": 8,
    "function length, 90th percentile": 20,
    "hints without an example answer": 0,
}


def size_main() -> bool:
    """Print the number of lines of Python, and the largest number of modules in a folder.

    Return whether a limit is exceeded.
    """
    lines = {path: len(path.read_text("utf-8").splitlines()) for path in python_files()}
    folders = Counter(path.parent for path in lines if path.name != "__init__.py")
    fullest, modules = folders.most_common(1)[0]
    return any(
        [
            over("lines of Python", sum(lines.values())),
            over("lines of example answers", sum(lines[path] for path in lines if is_answers(path))),
            over("files", len(lines)),
            over("modules in the fullest folder", modules, str(fullest.relative_to(ROOT))),
        ]
    )


def imports_main() -> bool:
    """Print the number of forbidden imports. Return whether a limit is exceeded."""
    return any(
        [
            over("import circles", refused("circles")),
            over("upward imports", refused("layers")),
            over("undeclared distributions", len(undeclared()), " ".join(sorted(undeclared()))),
        ]
    )


def types_main() -> bool:
    """Print how often the code uses Any. Return whether the limit is exceeded."""
    uses = {str(path.relative_to(ROOT)): uses_of_any(path.read_text("utf-8")) for path in python_files()}
    most, count = max(uses.items(), key=lambda item: item[1])
    return over("uses of Any", sum(uses.values()), f"{count} of them in {most}")


def functions_main() -> bool:
    """Print the lengths of functions. Return whether a limit is exceeded."""
    paths = [path for path in python_files() if not is_answers(path)]
    lengths = [length for path in paths for length in function_lengths(path.read_text("utf-8"))]
    return any(
        [
            over("function length, median", statistics.median(lengths), f"of {len(lengths)} functions"),
            over("function length, 90th percentile", statistics.quantiles(lengths, n=10)[-1]),
        ]
    )


def hints_main() -> bool:
    """Print the number of hints that no example answer causes. Return whether the limit is exceeded."""
    hints = {chapter: hints_of(chapter) for chapter in chapters()}
    missing = [
        hint
        for chapter, found in hints.items()
        for hint in not_shown(found, read_answers(folder_of(chapter) / "answers.py"))
    ]
    return over("hints without an example answer", len(missing), f"of {sum(map(len, hints.values()))} hints")


def all_main() -> bool:
    """Print all numbers. Return whether a limit is exceeded."""
    return any([size_main(), imports_main(), types_main(), functions_main(), hints_main()])


def over(what: str, figure: float, note: str = "") -> bool:
    """Print a number and its limit. Return whether the number is larger than the limit."""
    bar = BARS[what]
    print(f"{what:34}{figure:>10,.10g}  (bar: {bar:,})  {'OVER' if figure > bar else ''}  {note}".rstrip())
    return figure > bar


def python_files() -> Iterator[Path]:
    """Yield the Python files that are under version control."""
    listed = subprocess.run(
        ["git", "ls-files", "*.py"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    return (ROOT / name for name in listed.splitlines() if (ROOT / name).exists())


def is_answers(path: Path) -> bool:
    """Return whether the file contains example answers."""
    return path.name == "answers.py" and "chapters" in path.parts


def refused(contract: str) -> int:
    """Return the number of imports that break a contract of import-linter.

    The argument is the contract's id in pyproject.toml.
    """
    command = ["lint-imports", "--contract", contract]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if "Contracts:" not in result.stdout:
        sys.exit(f"lint-imports failed: {result.stdout[-2000:]}{result.stderr[-2000:]}")
    return len(re.findall(r"^- +\S+ -> ", result.stdout, re.MULTILINE))


def uses_of_any(source: str) -> int:
    """Return how often the name Any occurs in the source; types in strings count too."""
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    names = sum(token.type == tokenize.NAME and token.string == "Any" for token in tokens)
    aliases = re.findall(r': TypeAlias = "(.*)"$', source, re.MULTILINE)
    return names + sum(len(re.findall(r"\bAny\b", alias)) for alias in aliases)


def function_lengths(source: str) -> Iterator[int]:
    """Yield the number of lines of each function; decorators are not counted."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.end_lineno is not None:
            yield node.end_lineno - node.lineno + 1
