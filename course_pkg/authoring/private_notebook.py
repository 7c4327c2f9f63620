"""A pytest plug-in that gives each notebook of nbval a separate master, folder, workspace and results.

With this plug-in, several workers of pytest-xdist can run notebooks at the same time (`--dist loadfile`).
"""

from __future__ import annotations

import os
from collections.abc import Generator
from contextlib import ExitStack
from unittest.mock import patch

import pytest

from course_pkg.authoring.execute import surroundings

OPENED = pytest.StashKey[ExitStack]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item: pytest.Item) -> Generator[None]:
    """Change the environment and the current folder before the first cell, when nbval starts the kernel.

    nbval starts the kernel in the folder of the notebook's path. Therefore, this function changes the
    notebook's path until the kernel runs.
    """
    notebook = item.parent
    if not hasattr(item, "cell") or not isinstance(notebook, pytest.File) or OPENED in notebook.stash:
        return (yield)
    with ExitStack() as stack:
        folder, environment = stack.enter_context(surroundings())
        stack.enter_context(patch.dict(os.environ, environment, clear=True))
        notebook.stash[OPENED] = stack.pop_all()
    with patch.object(notebook, "path", folder / notebook.path.name):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> Generator[None]:
    """Restore the environment and remove the folders after nbval has ended the kernel."""
    try:
        return (yield)
    finally:
        notebook = item.parent
        over = nextitem is None or nextitem.parent is not notebook
        if over and notebook is not None and OPENED in notebook.stash:
            notebook.stash[OPENED].close()
            del notebook.stash[OPENED]
