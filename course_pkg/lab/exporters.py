"""A Jupyter Server extension: the list of export formats does not hold up the page that asks for it.

JupyterLab asks for the list as it opens, for a menu. To answer, the server imports nbconvert, for 0.4 s
in which it answers nothing else, the kernel included. Here the answer comes a little later, from a thread.
"""

from __future__ import annotations

import asyncio
import functools
import importlib
from collections.abc import Awaitable, Callable
from typing import Any

PATIENCE = 3.0  # s from the question, by when the page has opened


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "course_pkg.lab.exporters"}]


def _load_jupyter_server_extension(server: Any) -> None:  # noqa: ANN401 -- of no typed package
    """Delay the list of formats; where the server is built otherwise, change nothing."""
    try:
        from jupyter_server.services.nbconvert.handlers import NbconvertRootHandler

        NbconvertRootHandler.get = _delayed(NbconvertRootHandler.get)
    except (ImportError, AttributeError) as error:
        server.log.warning("course_pkg.lab.exporters does nothing with this server: %s", error)


def _delayed(stock: Callable[..., Awaitable[None]]) -> Callable[..., Awaitable[None]]:
    @functools.wraps(stock)
    async def get(self: Any) -> None:  # noqa: ANN401
        await asyncio.sleep(PATIENCE)
        await asyncio.to_thread(importlib.import_module, "nbconvert.exporters")
        await stock(self)

    return get
