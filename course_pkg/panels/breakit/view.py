"""The widget of the panel "Break it"; its text/plain output is the same for every student."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import ClassVar

from traitlets import Dict, List, Unicode

from course_pkg.faults import Stage, probe
from course_pkg.panels.breakit.cases import CaseStore, cases
from course_pkg.panels.breakit.model import LabModel
from course_pkg.panels.panel import PageMessage, Panel

HERE = Path(__file__).parent


class BreakIt(Panel):
    """A panel with cases. Each case causes a fault on the running graph, and the student finds this fault.

    `chosen` contains names of faults, or of the groups "serving", "calling" and "masters". If `chosen` is
    empty, the panel shows all cases. The panel undoes a fault when another case begins, when no page shows
    the panel any more, and when the kernel ends. The page receives the solution only after the right answer,
    or after the student has opened the solution. Raises UnknownFault for a name that is not a fault and not a
    group.
    """

    front_end: ClassVar[Path] = HERE / "breakit.js"
    style_sheet: ClassVar[Path] = HERE / "breakit.css"

    cases = List(Dict(), help="the cases by number, and the state of each").tag(sync=True)
    score = Dict(
        help=("the numbers of solved cases, of cases solved at the first try, and of all cases")
    ).tag(sync=True)
    case = Dict(help="the open case, the outputs of its tools, and the verdict").tag(sync=True)
    trouble = Unicode(help="why a case could not be set up").tag(sync=True)

    def __init__(self, *chosen: str, store: CaseStore | None = None) -> None:
        listed = cases(*chosen)
        super().__init__()
        self._chosen = chosen
        kept = store or CaseStore()
        self._model = LabModel(listed, kept, self.publish, stage=Stage, use=probe, turn=self.turn)
        self.publish(**self._model.overview())

    def record(self, cases: Mapping[str, Iterable[str]]) -> None:
        """Run tools on some cases, and store the outputs of the tools for a page without a kernel.

        The stored page shows the last of these cases.

        The keys of `cases` are names of faults, and the values are names of tools: {"stale": ["services",
        "ping"]}.
        """
        for name, tools in cases.items():
            self._model.play(name, tools)

    def hidden(self) -> None:
        """Undo the current fault, because no page shows the panel any more."""
        self._model.undo()

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a click on the page."""
        if kind == "open":
            self._model.open(int(content["case"]))
        elif kind == "use":
            self._model.use(str(content["tool"]))
        elif kind == "answer":
            self._model.answer(str(content["diagnosis"]), str(content["remedy"]))
        elif kind == "reveal":
            self._model.reveal()
        elif kind == "undo":
            self._model.undo()
        self.send({"kind": "taken"})

    def close(self) -> None:
        """Remove the panel from every page, and wait at most 15 s until the current fault is undone."""
        super().close()
        if hasattr(self, "_model"):  # The attribute is missing if the constructor raised an error.
            self._model.close()

    def __repr__(self) -> str:
        return f"BreakIt({', '.join(map(repr, self._chosen))})"
