"""Joins the front ends of all panels into one classic script.

A page in a local folder cannot load JavaScript modules.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import course_pkg

PANELS = Path(course_pkg.__file__).parent / "panels"
IMPORT = re.compile(r'^import \{(?P<names>[^}]*)\} from "(?P<from>\.{1,2}/[^"]+)";\n', re.MULTILINE)
EXPORT = re.compile(r"^export (?P<rest>(?:async )?(?:function\*?|const|class) (?P<name>\w+))", re.MULTILINE)
DEFAULT = re.compile(r"^export default \{ render \};\n?", re.MULTILINE)
JSDOC = re.compile(r"^[ \t]*/\*\*(?:[^*]|\*(?!/))*\*/[ \t]*\n", re.MULTILINE)


def panels_script(folder: Path = PANELS) -> str:
    """Return a script that sets `coursePanels`, which maps the name of each panel to `{ render }`.

    Each JavaScript module becomes the body of a function. The function of a module comes after the functions
    of all modules that it imports.
    """
    modules = _Modules(folder)
    found = _fronts(folder)
    bodies = "".join(text for path in found.values() for text in modules.needed(path))
    table = ", ".join(f"{name}: {modules.name(path)}" for name, path in found.items())
    return f'"use strict";\n{{\n{bodies}globalThis.coursePanels = {{ {table} }};\n}}\n'


def panels_sheet(folder: Path = PANELS) -> str:
    """Return the style sheets of all panels; the shared style sheet comes first."""
    return "\n".join(_text(path) for path in (folder / "look.css", *sorted(folder.glob("*/*.css"))))


def fronts(folder: Path = PANELS) -> list[str]:
    """Return the names of the panels that have a front end."""
    return list(_fronts(folder))


def _fronts(folder: Path) -> dict[str, Path]:
    return {path.parent.name: path for path in sorted(folder.glob("*/*.js")) if DEFAULT.search(_text(path))}


class _Modules:
    """The modules of a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._given: set[Path] = set()

    def name(self, path: Path) -> str:
        """Return the name of the constant that stores the exports of the module at the path `path`."""
        return "_" + re.sub(r"\W", "_", str(path.resolve().relative_to(self._folder).with_suffix("")))

    def needed(self, path: Path) -> Iterator[str]:
        """Yield the modules that the module at the path `path` imports, and then the module itself.

        Each module is yielded only once.
        """
        path = path.resolve()
        if path in self._given:
            return
        self._given.add(path)
        source = _text(path)
        for found in IMPORT.finditer(source):
            yield from self.needed(path.parent / found["from"])
        yield self._scoped(path, source)

    def _scoped(self, path: Path, source: str) -> str:
        names = ["render"] if DEFAULT.search(source) else [found["name"] for found in EXPORT.finditer(source)]
        body = IMPORT.sub(lambda found: self._bound(path, found), source)
        body = JSDOC.sub("", DEFAULT.sub("", EXPORT.sub(r"\g<rest>", body)))
        return f"const {self.name(path)} = (() => {{\n{body}\nreturn {{ {', '.join(names)} }};\n}})();\n"

    def _bound(self, path: Path, found: re.Match[str]) -> str:
        names = found["names"].replace(" as ", ": ")
        return f"const {{{names}}} = {self.name(path.parent / found['from'])};\n"


def _text(path: Path) -> str:
    return path.read_text("utf-8")
