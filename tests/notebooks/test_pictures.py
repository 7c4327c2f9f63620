"""Each panel and plot in a stored solution has a picture."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest
from nbconvert.exporters.html import HTMLExporter

from course_pkg import panels
from course_pkg.authoring.cells import Output, code_cells
from course_pkg.authoring.notebook_store import read
from course_pkg.authoring.pictures import SVG

ROOT = Path(__file__).parents[2]
SOLUTIONS = sorted((ROOT / "solutions").glob("*.ipynb"))
NAMES = "|".join([*panels.__all__, "predictions"])
OF_A_PANEL = re.compile(rf"(?:{NAMES})\(.*\)|What really happened: [\s\S]*")
LIMIT = 1_000_000  # GitHub does not show a notebook that has more bytes than this limit.


def outputs(path: Path) -> Iterator[tuple[str, Output]]:
    """Yield each stored output that has the MIME type text/plain, together with its plain text."""
    for cell in code_cells(read(path)):
        for output in cell["outputs"]:
            if "text/plain" in output.get("data", {}):
                yield str(output["data"]["text/plain"]), output


@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda path: path.stem)
def test_each_panel_and_plot_has_a_picture(path: Path) -> None:
    """The picture of each panel is well-formed XML and has a title."""
    for text, output in outputs(path):
        if text.startswith("<Figure"):
            assert SVG in output["data"], text
        elif OF_A_PANEL.fullmatch(text):
            root = fromstring(str(output["data"].get(SVG, "<none/>")))  # noqa: S314 - it is our own
            assert root.findtext("{http://www.w3.org/2000/svg}title"), text


@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda path: path.stem)
def test_a_stored_notebook_is_small(path: Path) -> None:
    """A stored notebook is smaller than LIMIT."""
    assert path.stat().st_size < LIMIT


def test_page_of_nbconvert_shows_the_pictures() -> None:
    """A page from `jupyter nbconvert --to html` shows the pictures."""
    path = next(path for path in SOLUTIONS if path.name.startswith("05"))
    page, _ = HTMLExporter().from_filename(str(path))  # type: ignore[no-untyped-call]
    drawn = [output for _, output in outputs(path) if SVG in output["data"]]
    assert len(drawn) > 10
    for output in drawn:
        assert base64.b64encode(str(output["data"][SVG]).encode()).decode() in page
    assert "<pre>GraphPanel()</pre>" not in page
