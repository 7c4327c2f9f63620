"""Serves a tornado application in a thread of the test, and sends requests to pages."""

from __future__ import annotations

import asyncio
import json
import threading
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application


@contextmanager
def served(application: Callable[[int], AbstractContextManager[Application]]) -> Iterator[str]:
    """Serve an application on a thread during the `with` block; yield the address, without a final slash.

    The thread calls `application` with the port, and enters the context manager that this call returns. At
    the end of the `with` block, the thread leaves this context manager.
    """
    (listening,) = bind_sockets(0, "127.0.0.1")
    port = listening.getsockname()[1]
    ready, ends = threading.Event(), list[Callable[[], object]]()

    async def serve() -> None:
        loop, ended = asyncio.get_running_loop(), asyncio.Event()
        with application(port) as made:
            server = HTTPServer(made)
            server.add_socket(listening)
            ends.append(lambda: loop.call_soon_threadsafe(ended.set))
            ready.set()
            await ended.wait()
            server.stop()
            await server.close_all_connections()

    thread = threading.Thread(target=asyncio.run, args=[serve()])
    thread.start()
    assert ready.wait(20)
    try:
        yield f"http://127.0.0.1:{port}"
    finally:
        ends[0]()
        thread.join(10)


class Kept(urllib.request.HTTPRedirectHandler):
    """A handler that does not follow redirects."""

    def redirect_request(self, *_: object) -> None:
        """Return None, so that the redirect is not followed."""


def ask(url: str, data: object = None, **headers: str) -> tuple[int, str, dict[str, str]]:
    """Send a request; return the status, the text and the headers of the response."""
    body = None if data is None else data if isinstance(data, bytes) else json.dumps(data).encode()
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    request = urllib.request.Request(url, body, named)  # noqa: S310 -- our own server
    try:
        with urllib.request.build_opener(Kept).open(request, timeout=30) as response:
            return response.status, response.read().decode(), dict(response.headers)
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.read().decode(), dict(error.headers)
