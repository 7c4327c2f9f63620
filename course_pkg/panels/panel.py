"""What every panel of the course has in common: a widget of one ES module that never hurts the kernel."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any, ClassVar

import anywidget
from traitlets import Dict, Unicode

from course_pkg.graph.explanations import explain
from course_pkg.panels.assets import module, sheet

HERE = Path(__file__).parent


class Panel(anywidget.AnyWidget):
    """A widget that may be told things from any thread, and knows whether a page shows it.

    A subclass names its ES module in `front_end` and its sheet in `style_sheet`, answers the page's
    messages in `received`, and begins and ends in `shown` and `hidden` what it does only on a page.
    """

    front_end: ClassVar[Path]
    style_sheet: ClassVar[Path]
    errors: ClassVar[tuple[str, ...]] = ("notice", "trouble")  # traits that hold the words of an error
    shared_sheets: ClassVar[tuple[Path, ...]] = ()  # of the parts that it has in common with other panels

    notice = Unicode(help="what went wrong inside the panel itself, in one line").tag(sync=True)
    explained = Dict(help="what that means, where the course knows it").tag(sync=True)

    def __init__(self) -> None:
        # Messages from the page and updates from threads take turns: ipywidgets swaps methods on the instance
        # while it takes a message in, and a change made on another thread just then can be lost.
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

    def error_words(self) -> str:
        """Return the words of the error that the panel shows, "" for none; the first of `errors` counts."""
        words = (getattr(self, name, "") for name in self.errors)
        return next((each for each in words if each and isinstance(each, str)), "")

    def shown(self) -> None:
        """Begin what the panel does only while a page shows it; told again for each further view."""

    def hidden(self) -> None:
        """End it."""

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """Answer a message of the page."""

    def publish(self, **traits: object) -> None:
        """Set traits from any thread; the page gets them as one message."""
        with self.turn, self.hold_sync():
            for name, value in traits.items():
                setattr(self, name, value)

    def complain(self, error: Exception) -> None:
        """Show an error of the panel's own, from any thread."""
        self.publish(notice=f"{type(error).__name__}: {error}")

    def close(self) -> None:
        """Take the panel off every page and end what it runs."""
        if not hasattr(self, "turn"):
            return  # its constructor refused what it was given, and ipywidgets closes what is thrown away
        with self.turn:
            if self._views:
                self._views.clear()
                self.hidden()
            super().close()

    def _explain(self, _change: object) -> None:
        """Offer an explanation of what the panel shows as an error, if there is one."""
        words = self.error_words()
        meaning = explain(words) if words else None
        self.explained = meaning.as_dict() if meaning and meaning.known else {}

    def _handle_msg(self, msg: dict[str, Any]) -> None:
        with self.turn:
            super()._handle_msg(msg)

    def _dispatch(self, _widget: object, content: dict[str, Any], _buffers: object) -> None:
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
        except Exception as error:  # noqa: BLE001 - an error in a click must show in the panel, not in some cell
            self.complain(error)
