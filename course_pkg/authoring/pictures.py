"""Pictures beside the panels of a stored notebook, and pictures that stay while nothing changed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from typing import NamedTuple

from course_pkg.authoring.cells import Cell, Notebook, Output, code_cells
from course_pkg.authoring.widgets import VIEW, SavedPanels
from course_pkg.panels.stills import STILLS
from course_pkg.types.fields import Plain

SVG = "image/svg+xml"
MADE_BY = "code"  # the key of a digest in the metadata of a measured picture


class _Stored(NamedTuple):
    """A measured picture as it was stored, with the digest of the code that made it, and its other forms."""

    picture: Plain
    made_by: str
    others: dict[str, Plain]


def add_pictures(executed: Notebook, stored: Notebook) -> None:
    """Give each panel of `executed` its still picture, in place; its metadata still hold the panels' states.

    A plot and the picture of a panel that shows a recording hold measured times, so they would differ after
    each run. Such a picture of `stored` stays, as long as the output's other forms and all the code that
    made it are the same: that of the notebook up to its cell, and that which draws the panel.
    """
    panels = SavedPanels(executed)
    before = {cell["id"]: cell for cell in code_cells(stored)}
    code = hashlib.sha256()
    for cell in code_cells(executed):
        code.update(cell["source"].encode() + b"\0")
        old = list(_pictures(before.get(cell["id"])))
        for output in cell["outputs"]:
            drawn_by = b""
            if panel := panels.of(output):
                still = STILLS[panel.name]
                output["data"][SVG] = still.draw(panel.state)
                if not still.measured:
                    continue
                drawn_by = still.code.encode()
            if SVG in output.get("data", {}):
                made = code.copy()
                made.update(drawn_by)
                _settle(output, made.hexdigest()[:12], old)


def _settle(output: Output, made_by: str, old: list[_Stored]) -> None:
    """Note what made a measured picture; take the stored one instead if the same made it."""
    output["metadata"].setdefault(SVG, {})[MADE_BY] = made_by
    same = next((each for each in old if each.made_by == made_by and each.others == _others(output)), None)
    if same:
        old.remove(same)  # a cell may show several plots that have the same text
        output["data"][SVG] = same.picture


def _pictures(cell: Cell | None) -> Iterator[_Stored]:
    for output in cell["outputs"] if cell else ():
        if SVG in output.get("data", {}):
            made_by = output["metadata"].get(SVG, {}).get(MADE_BY, "")
            yield _Stored(output["data"][SVG], made_by, _others(output))


def _others(output: Output) -> dict[str, Plain]:
    return {kind: data for kind, data in output["data"].items() if kind not in (SVG, VIEW)}
