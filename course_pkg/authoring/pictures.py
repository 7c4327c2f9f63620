"""Adds still pictures to the panels of a stored notebook; an unchanged picture is not replaced."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from typing import NamedTuple

from course_pkg.authoring.cells import Cell, Notebook, Output, code_cells
from course_pkg.authoring.widgets import VIEW, SavedPanels
from course_pkg.panels.stills import STILLS
from course_pkg.types.fields import Plain

SVG = "image/svg+xml"
# Each picture with measured times has the key MADE_BY in its metadata. The value is a digest of the code that
# made the picture.
MADE_BY = "code"


class _Stored(NamedTuple):
    """A stored picture with measured times.

    `made_by` is a digest of the code that made the picture, and `others` contains the data of the same output
    in other MIME types.
    """

    picture: Plain
    made_by: str
    others: dict[str, Plain]


def add_pictures(executed: Notebook, stored: Notebook) -> None:
    """Add a still picture to each panel of the notebook `executed` itself, not of a copy.

    The metadata of `executed` must still contain the states of the panels. Plots contain measured times, so
    they differ in each run. Pictures of panels that show a recording also contain measured times. Such a
    picture depends on the code of the cells up to its cell, on the drawing code, and on the output's data in
    other MIME types. If the code and the data have not changed, the function uses the picture from the
    notebook `stored`.
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
    """Store `made_by`, a digest of the code that made the picture, in the metadata of `output`.

    Use an old picture if it has the same digest, and if its output has the same other data.
    """
    output["metadata"].setdefault(SVG, {})[MADE_BY] = made_by
    same = next((each for each in old if each.made_by == made_by and each.others == _others(output)), None)
    if same:
        # Several outputs of a cell may have the same digest and the same other data. Therefore, use each old
        # picture only once.
        old.remove(same)
        output["data"][SVG] = same.picture


def _pictures(cell: Cell | None) -> Iterator[_Stored]:
    for output in cell["outputs"] if cell else ():
        if SVG in output.get("data", {}):
            made_by = output["metadata"].get(SVG, {}).get(MADE_BY, "")
            yield _Stored(output["data"][SVG], made_by, _others(output))


def _others(output: Output) -> dict[str, Plain]:
    return {kind: data for kind, data in output["data"].items() if kind not in (SVG, VIEW)}
