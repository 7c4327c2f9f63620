"""Counts created objects, imported names, graded parts, lines of errors, and words in the chapters."""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import nbformat

from course_pkg.checking.parts import every_part

ROOT = Path(__file__).parents[3]
ROSPY = {"Service", "ServiceProxy", "Publisher", "Subscriber"}
# These methods of the object that join() returns do the same as classes of rospy.
OURS = {"serve", "proxy", "call", "advertise", "subscribe"}
TYPES = ("course_pkg.srv", "course_pkg.msg", "course_pkg.action")
COLOURS = re.compile(r"\x1b\[[0-9;]*m")
NAMES_BAR, PARTS_BAR, ERROR_BAR, WORDS_BAR = 18, 95, 12, 38_000


@dataclass(frozen=True)
class Code:
    """A code cell with its position, its source without magics, and its magics."""

    place: str
    tree: ast.Module
    magics: tuple[str, ...]
    exercise: bool


def objects_main() -> bool:
    """Print how many objects in exercises are created by rospy, and how many are created by the course.

    Return whether the course creates any object.
    """
    created = Counter(
        "rospy" if owner == "rospy" else f"the course ({code.place})"
        for code in code_cells()
        if code.exercise
        for owner in owners(code.tree)
    )
    plain, total = created.pop("rospy", 0), created.total()
    print(f"objects in exercises by plain rospy: {plain} of {plain + total} (bar: all)")
    for place, count in sorted(created.items()):
        print(f"  {count} by {place}")
    return total > 0


def names_main() -> bool:
    """Print the names that code cells import from course_pkg, except service and message types.

    Return whether there are too many names.
    """
    found: dict[str, set[str]] = {}
    for code in code_cells():
        for name in {*imported(code.tree), *methods(code.tree), *code.magics}:
            found.setdefault(name, set()).add(code.place.split("[")[0])
    print(f"names of course_pkg in code cells: {len(found)} (bar: {NAMES_BAR})")
    for name, chapters in sorted(found.items()):
        print(f"  {name:24} {' '.join(sorted(chapters))}")
    return len(found) > NAMES_BAR


def parts_main() -> bool:
    """Print the number of graded parts of each chapter; return whether there are too few parts."""
    parts = Counter(part.check.split(".")[0] for part in every_part())
    print(f"graded parts: {parts.total()} (bar: at least {PARTS_BAR})")
    print("  " + "  ".join(f"{chapter}: {count}" for chapter, count in sorted(parts.items())))
    return parts.total() < PARTS_BAR


def errors_main() -> bool:
    """Print the number of lines of each stored error; return whether an error has too many lines."""
    lines = {
        f"{path.stem[:2]}[{number}]": len(COLOURS.sub("", "\n".join(output.traceback)).splitlines())
        for path, number, cell in cells("code")
        for output in cell.outputs
        if output.output_type == "error"
    }
    long = {place: count for place, count in lines.items() if count > ERROR_BAR}
    print(f"stored errors: {len(lines)}, the longest has {max(lines.values())} lines (bar: {ERROR_BAR})")
    for place, count in long.items():
        print(f"  {place}: {count} lines")
    return bool(long)


def prose_main() -> bool:
    """Print the number of words in each chapter; return whether the sum is too high."""
    words = Counter[str]()
    for path, _, cell in cells("markdown"):
        words[path.stem[:2]] += len(re.findall(r"[^\W_]+", cell.source))
    print(f"words of prose: {words.total():,} (bar: {WORDS_BAR:,})")
    print("  " + "  ".join(f"{chapter}: {count:,}" for chapter, count in sorted(words.items())))
    return words.total() > WORDS_BAR


def all_main() -> bool:
    """Print all counts, and return True if at least one count is outside its limit."""
    return any([objects_main(), names_main(), parts_main(), errors_main(), prose_main()])


def cells(kind: str) -> Iterator[tuple[Path, int, nbformat.NotebookNode]]:
    """Yield each cell of one type, with the path of the notebook and the number of the cell."""
    for path in sorted((ROOT / "solutions").glob("[0-9][0-9]_*.ipynb")):
        for number, cell in enumerate(nbformat.read(path, as_version=4).cells):
            if cell.cell_type == kind:
                yield path, number, cell


def code_cells() -> Iterator[Code]:
    """Yield the code cells that contain Python."""
    for path, number, cell in cells("code"):
        first = cell.source.partition("\n")[0]
        if first.startswith("%%") and not re.match(r"%%writefile .*\.py$", first):
            continue
        lines = cell.source.splitlines()
        plain = [re.sub(r"^(\s*)(\w+ = )?[%!].*", r"\1pass", line) for line in lines]
        magics = re.findall(r"^\s*(?:\w+ = )?(%(?:rosrun|roslaunch))\b", cell.source, re.MULTILINE)
        place = f"{path.stem[:2]}[{number}]"
        try:
            tree = ast.parse("\n".join(plain))
        except SyntaxError:
            if "raises-exception" not in cell.metadata.get("tags", []):
                print(f"{place} is left out, because it is not Python", file=sys.stderr)
            continue
        yield Code(place, tree, tuple(magics), "exercise" in cell.metadata.get("course", {}))


def owners(tree: ast.AST) -> Iterator[str]:
    """Yield "rospy" or "the course" for each call that creates a service, proxy, publisher or subscriber."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call):
            name = ast.unparse(call.func)
            if name.removeprefix("rospy.") in ROSPY:
                yield "rospy"
            elif name in {f"node.{method}" for method in OURS}:
                yield "the course"


def imported(tree: ast.AST) -> Iterator[str]:
    """Yield the names that the code imports from course_pkg, except service and message types."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "course_pkg":
            if not (node.module or "").startswith(TYPES):
                yield from (alias.name for alias in node.names if f"course_pkg.{alias.name}" not in TYPES)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if re.match(r"course_pkg\b", alias.name))


def methods(tree: ast.AST) -> Iterator[str]:
    """Yield the methods and properties of `node` that the code uses.

    In the chapters, `node` is the object that join() returns.
    """
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "node":
            yield f"node.{node.attr}"
