"""A Jupyter Server extension for tests: /sockets says of each kernel websocket whether TCP_NODELAY is set."""

from __future__ import annotations

import gc
import json
import socket
from typing import Any

from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.services.kernels.websocket import KernelWebsocketHandler


class SocketsHandler(JupyterHandler):  # type: ignore[misc]
    """Looks at the sockets themselves."""

    def get(self) -> None:
        """Answer with one truth value for each open kernel websocket."""
        handlers = [
            it for it in gc.get_objects() if isinstance(it, KernelWebsocketHandler) and it.ws_connection
        ]
        streams = [handler.ws_connection.stream for handler in handlers]
        options = [
            it.socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) for it in streams if it.socket
        ]
        self.finish(json.dumps([bool(option) for option in options]))


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "tests.lab.sockets"}]


def _load_jupyter_server_extension(server: Any) -> None:  # noqa: ANN401
    server.web_app.add_handlers(".*$", [("/sockets", SocketsHandler)])
