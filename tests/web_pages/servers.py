"""A tornado application in a thread of the test."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application


@contextmanager
def served(application: Callable[[int], AbstractContextManager[Application]]) -> Iterator[str]:
    """Serve an application during the `with` block; yield its address without a slash at its end.

    The thread calls `application` with the port, in its event loop, and leaves the context at the end.
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
