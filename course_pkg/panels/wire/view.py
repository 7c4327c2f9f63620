"""The wire view as a widget: nothing but a recorded call on its way to the page."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from traitlets import Dict

from course_pkg.panels.panel import Panel
from course_pkg.panels.wire.model import state

if TYPE_CHECKING:
    from course_pkg.graph.wiretap import Wire

HERE = Path(__file__).parent


class WireView(Panel):
    """A real call, byte by byte: look-up, connection headers, request and reply, each piece beside its value.

    `WireView("/getGeometry", length=1.2, width=5.2, height=8.9)` makes the call and shows it, also one that
    fails. `kind` is a type other than the server's own, `headers` are more fields for the connection header.
    `WireView(wire)` shows what a `Wiretap` took down. The protocol: http://wiki.ros.org/ROS/TCPROS and
    http://wiki.ros.org/ROS/Connection%20Header.
    """

    front_end: ClassVar[Path] = HERE / "wire.js"
    style_sheet: ClassVar[Path] = HERE / "wire.css"
    errors: ClassVar[tuple[str, ...]] = ("notice", "exchange")

    exchange = Dict(help="the steps of the call and their pieces; see model.py").tag(sync=True)

    def __init__(
        self,
        call: str | Wire,
        kind: Any = None,  # noqa: ANN401 -- a generated class, a ServiceType or a name
        headers: Mapping[str, str] | None = None,
        /,
        **fields: Any,  # noqa: ANN401 -- the fields of a request
    ) -> None:
        self.wire = _recorded(call, kind, headers, fields) if isinstance(call, str) else call
        super().__init__()
        self.publish(exchange=state(self.wire))

    def error_words(self) -> str:
        """Return how the call failed, where the panel itself has not."""
        return super().error_words() or str(self.exchange.get("outcome", ""))

    def __repr__(self) -> str:
        return f"WireView({self.wire.service!r})"


def _recorded(name: str, kind: Any, headers: Mapping[str, str] | None, fields: Mapping[str, Any]) -> Wire:  # noqa: ANN401
    from course_pkg.graph.wiretap import record_call  # rospy, which a page of recorded calls does not need

    return record_call(name, kind, headers, fields)
