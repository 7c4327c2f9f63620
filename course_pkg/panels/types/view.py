"""The widget of the type browser."""

from __future__ import annotations

import time
from pathlib import Path
from typing import ClassVar

from traitlets import Dict, List, Unicode

from course_pkg.panels.panel import PageMessage, Panel
from course_pkg.panels.poller import Poller
from course_pkg.panels.types.model import Catalogue, TypeModel, catalogue
from course_pkg.ros import Snapshot, look

HERE = Path(__file__).parent
PAUSE = 3.0  # PAUSE is the time in s between two checks of the files.
# Reading all packages is slow on a machine with many packages. Therefore, reading the packages takes at most
# 1 / `SHARE` of the time.
SHARE = 50

# A tuple `Files` contains the names of all types, and the modification time (ns) of the open type's file.
Files = tuple[Catalogue, int]


class TypeBrowser(Panel):
    """All service and message types on this machine, with their fields, and their services or topics.

    `name` is the type that is open at the beginning, such as "std_srvs/SetBool". While a page shows the
    panel, the panel reads the files and the graph repeatedly.
    """

    front_end: ClassVar[Path] = HERE / "types.js"
    shared_sheets: ClassVar[tuple[Path, ...]] = (HERE.parent / "forms" / "forms.css",)
    style_sheet: ClassVar[Path] = HERE / "types.css"

    packages = List(Dict(), help="the packages with their types").tag(sync=True)
    described = Dict(help="the type that is open").tag(sync=True)
    offers = Dict(help="the services and topics of each type on the graph now").tag(sync=True)
    trouble = Unicode(help="why the graph cannot be read").tag(sync=True)

    def __init__(self, name: str | None = None) -> None:
        super().__init__()
        self._name = name
        self._known: Catalogue = ((), ())
        # The panel reads the packages again only after this time (s, time.monotonic()).
        self._not_before = 0.0
        self._model = TypeModel(self.publish, turn=self.turn)
        self._graph: Poller[Snapshot] = Poller(look, self._seen, self._failed)
        self._files: Poller[Files] = Poller(self._list, self._listed, self.complain, every=PAUSE)
        with self.turn, self.hold_sync():
            self._files.once()
            if name is not None:
                self._model.open(name)
            self._graph.once()

    def shown(self) -> None:
        """Start to read the files and the graph repeatedly."""
        self._files.start()
        self._graph.start()

    def hidden(self) -> None:
        """Stop reading the files and the graph."""
        self._files.stop()
        self._graph.stop()

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a click on a type."""
        if kind == "open":
            self._model.open(str(content["name"]), "msg" if content["half"] == "msg" else "srv")

    def __repr__(self) -> str:
        return f"TypeBrowser({self._name!r})" if self._name else "TypeBrowser()"

    def _list(self) -> Files:
        began = time.monotonic()
        if began >= self._not_before:
            self._known = catalogue()
            self._not_before = began + SHARE * (time.monotonic() - began)
        return self._known, _written(self._model.file)

    def _listed(self, files: Files) -> None:
        self._model.update(files[0])

    def _seen(self, snapshot: Snapshot) -> None:
        self.publish(trouble="")
        self._model.see(snapshot)

    def _failed(self, error: Exception) -> None:
        self.publish(trouble=str(error), offers={})


def _written(file: str) -> int:
    try:
        return Path(file).stat().st_mtime_ns if file else 0
    except OSError:
        return 0
