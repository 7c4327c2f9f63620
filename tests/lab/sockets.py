"""A Jupyter Server extension for tests: /sockets returns whether each kernel websocket has TCP_NODELAY."""

from __future__ import annotations

import gc
import json
import socket

from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.serverapp import ServerApp
from jupyter_server.services.kernels.websocket import KernelWebsocketHandler


class SocketsHandler(JupyterHandler):  # type: ignore[misc]
    """Responds with the state of TCP_NODELAY on each kernel websocket."""

    def get(self) -> None:
        """Respond with a JSON list: for each open kernel websocket, whether TCP_NODELAY is set."""
        handlers = [
            it
            for it in gc.get_objects()
            # isinstance() would raise an error for a weakref.proxy of a deleted object.
            if issubclass(type(it), KernelWebsocketHandler) and it.ws_connection
        ]
        streams = [handler.ws_connection.stream for handler in handlers]
        options = [
            it.socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) for it in streams if it.socket
        ]
        self.finish(json.dumps([bool(option) for option in options]))


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "tests.lab.sockets"}]


def _load_jupyter_server_extension(server: ServerApp) -> None:
    server.web_app.add_handlers(".*$", [("/sockets", SocketsHandler)])
