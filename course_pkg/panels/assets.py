"""The files of a front end, joined into the one module and the one sheet that a widget carries.

A widget's code travels as a single string, so an ES module cannot import its neighbours at run
time. The sources stay ordinary modules that editors and Node understand; joining them is a matter of
leaving out the imports.
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
    """Return the ES module at `path` with the relative modules it imports written into it, each once.

    `frame` is a module with a function `framed`, through which what the panel renders goes.
    """
    done: set[Path] = set()
    around = f"{_EXPORT.sub('', _inlined(frame.resolve(), done))}\n" if frame else ""
    panel = _inlined(path.resolve(), done)
    return around + (panel.replace(_DEFAULT, _FRAMED) if frame else panel)


@cache
def sheet(*paths: Path) -> str:
    """Return the style sheets at `paths`, one after the other."""
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)


def _inlined(path: Path, done: set[Path]) -> str:
    done.add(path)
    source = path.read_text(encoding="utf-8")
    neighbours = [(path.parent / name).resolve() for name in _IMPORT.findall(source)]
    parts = [_EXPORT.sub("", _inlined(near, done)) for near in neighbours if near not in done]
    return "\n".join([*parts, _IMPORT.sub("", source)])
