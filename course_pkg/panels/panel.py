"""The base class of all panels: a widget with one ES module. An error in a panel never stops the kernel."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any, ClassVar, TypeAlias

import anywidget
from traitlets import Dict, Unicode
from traitlets.utils.bunch import Bunch

from course_pkg.panels.assets import module, sheet
from course_pkg.ros.explain import explain

HERE = Path(__file__).parent

# A message from the page or to the page is a JSON object. ipywidgets does not define a more exact type.
PageMessage: TypeAlias = dict[str, Any]


class Panel(anywidget.AnyWidget):
    """A widget that any thread may update.

    In a subclass, `front_end` is the path of the ES module, and `style_sheet` is the path of the style sheet.
    A subclass overrides `received` to handle the messages of the page. A subclass also overrides `shown` and
    `hidden` if it works only while a page shows the panel.
    """

    front_end: ClassVar[Path]
    style_sheet: ClassVar[Path]
    # `errors` contains the names of the traits that can contain an error message.
    errors: ClassVar[tuple[str, ...]] = ("notice", "trouble")
    shared_sheets: ClassVar[tuple[Path, ...]] = ()  # Several panels use these style sheets.

    notice = Unicode(help="an error inside the panel itself, in one line").tag(sync=True)
    explained = Dict(help="the course's explanation of the displayed error, if there is an explanation").tag(
        sync=True
    )

    def __init__(self) -> None:
        # A thread holds the lock `turn` while it handles a message from the page or changes a trait. Without
        # this lock, a change by another thread could be lost.
        self.turn = threading.RLock()
        self._views: set[str] = set()
        super().__init__()
        self.on_msg(self._dispatch)
        self.observe(self._explain, names=list(self.errors))

    @property
    def _esm(self) -> str:
        return module(self.front_end, HERE / "explained.js")

    @property
    def _css(self) -> str:
        return sheet(HERE / "look.css", HERE / "explained.css", *self.shared_sheets, self.style_sheet)

    def error_message(self) -> str:
        """Return the error message that the panel shows, or "" if there is none.

        If several traits in `errors` have a message, return the first one.
        """
        messages = (getattr(self, name, "") for name in self.errors)
        return next((each for each in messages if each and isinstance(each, str)), "")

    def shown(self) -> None:
        """Start the work that the panel does while a page shows it.

        The base class calls this method for each new view.
        """

    def hidden(self) -> None:
        """Stop the work that shown() started.

        The base class calls this method after the last view was closed.
        """

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a message from the page."""

    def publish(self, **traits: object) -> None:
        """Set several traits; any thread may call this method.

        The page receives all new values in one message.
        """
        with self.turn, self.hold_sync():
            for name, value in traits.items():
                setattr(self, name, value)

    def complain(self, error: Exception) -> None:
        """Show an error of the panel itself; any thread may call this method."""
        self.publish(notice=f"{type(error).__name__}: {error}")

    def close(self) -> None:
        """Remove the panel from every page and stop its work."""
        if not hasattr(self, "turn"):
            return  # The constructor raised an error, and ipywidgets closes the unfinished widget.
        with self.turn:
            if self._views:
                self._views.clear()
                self.hidden()
            super().close()

    def _explain(self, _change: Bunch) -> None:
        """If the course can explain the panel's error message, send the explanation to the page."""
        message = self.error_message()
        meaning = explain(message) if message else None
        self.explained = meaning.as_dict() if meaning and meaning.known else {}

    def _handle_msg(self, msg: PageMessage) -> None:
        with self.turn:
            super()._handle_msg(msg)

    def _dispatch(self, _widget: Panel, content: PageMessage, _buffers: list[bytes]) -> None:
        kind = content.get("kind", "")
        try:
            if kind == "hello":
                self._views.add(content["view"])
                self.send({"kind": "hello"})
                self.shown()
            elif kind == "bye":
                self._views.discard(content["view"])
                if not self._views:
                    self.hidden()
            elif kind != "here":
                self.received(kind, content)
        except Exception as error:  # noqa: BLE001 - the panel shows the error, because it belongs to no cell
            self.complain(error)
