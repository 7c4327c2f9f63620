"""Joins the JavaScript files of a panel into one ES module, and its CSS files into one style sheet.

A widget sends its JavaScript code to the browser as one string. However, the source files are ES modules that
import each other. The function `module` inserts the code of the imported files, and removes the import
statements.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

_IMPORT = re.compile(r'^import \{[^}]*\} from "(\.{1,2}/[^"]+)";\n', re.MULTILINE)
_DEFAULT, _FRAMED = "export default { render };", "export default { render: framed(render) };"
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function|const|class)\b)", re.MULTILINE)


@cache
def module(path: Path, frame: Path | None = None) -> str:
    """Return the code of an ES module, together with the code of the modules that it imports.

    `path` is the path of the module.

    `frame` is the path of an ES module that defines the JavaScript function `framed`. If `frame` is given,
    the result exports `framed(render)` instead of `render`.
    """
    done: set[Path] = set()
    around = f"{_EXPORT.sub('', _inlined(frame.resolve(), done))}\n" if frame else ""
    panel = _inlined(path.resolve(), done)
    return around + (panel.replace(_DEFAULT, _FRAMED) if frame else panel)


@cache
def sheet(*paths: Path) -> str:
    """Return the text of all style sheets at `paths`, one after the other."""
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)


def _inlined(path: Path, done: set[Path]) -> str:
    done.add(path)
    source = path.read_text(encoding="utf-8")
    neighbours = [(path.parent / name).resolve() for name in _IMPORT.findall(source)]
    parts = [_EXPORT.sub("", _inlined(near, done)) for near in neighbours if near not in done]
    return "\n".join([*parts, _IMPORT.sub("", source)])
