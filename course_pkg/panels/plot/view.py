"""The plot as a widget: nothing but data on its way to the page."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from traitlets import Dict

from course_pkg.panels.panel import Panel
from course_pkg.panels.plot.model import Series, drawing

HERE = Path(__file__).parent


class Plot(Panel):
    """A plot of measured data.

    `series` is `{"label": [(x, y), …]}`, or `{"label": number}` for bars; `x` and `y` name the axes, with
    units in parentheses; `kind` is "line", "dots" or "bars"; with `log` the values stand on a logarithmic
    axis. The page shows the same values as a table, too. Raises NotASeries.
    """

    front_end: ClassVar[Path] = HERE / "plot.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (HERE / "chart.css",)
    style_sheet: ClassVar[Path] = HERE / "plot.css"

    data = Dict(help="what to draw, its table, and what was left out").tag(sync=True)

    def __init__(
        self,
        series: Series,
        x: str = "",
        y: str = "",
        kind: str = "line",
        title: str = "",
        log: bool = False,
    ) -> None:
        data = drawing(series, x=x, y=y, kind=kind, title=title, log=log)
        super().__init__()
        self.publish(data=data)

    def __repr__(self) -> str:
        return f"Plot({self.data['title']!r})" if self.data["title"] else "Plot()"
