"""Run solutions from the top in a fresh kernel, and keep what they show."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from traitlets.config import Config

from course_pkg.authoring.cells import Notebook, code_cells
from course_pkg.authoring.shelf import Shelf, read, text_of
from course_pkg.authoring.tidy import strip, tidy
from course_pkg.errors import AuthoringError

CELL = 120  # s; a chapter that makes its reader wait longer needs another cell


def execute(chapters: Sequence[str] = (), root: Path | None = None) -> None:
    """Run the solutions of `chapters`, such as ["05"], or all, and store them with what they show."""
    for path in Shelf(root).solutions(chapters):
        notebook = read(path)
        strip(notebook)
        run(path.stem, notebook)
        tidy(notebook)
        path.write_text(text_of(notebook), "utf-8")


def run(name: str, notebook: Notebook) -> None:
    """Run `notebook` in place, in a fresh kernel with a master and folders of its own."""
    total = len(code_cells(notebook))
    done = iter(range(1, total + 1))

    def progress(**_: Any) -> None:  # noqa: ANN401 -- what nbclient hands to a hook
        sys.stderr.write(f"\r{name}: cell {next(done, total)} of {total}")
        sys.stderr.flush()

    with surroundings() as (folder, environment):
        client = NotebookClient(
            nbformat.from_dict(notebook),
            timeout=CELL,
            kernel_name="python3",
            on_cell_executed=progress,
            config=_by_files(folder.parent),
        )
        client.resources = {"metadata": {"path": str(folder)}}
        try:
            client.execute(env=environment)
        except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
            raise AuthoringError(f"{name}: {_what_went_wrong(client.nb, error)}") from error
        finally:
            sys.stderr.write("\n")
        notebook.update(client.nb)


@contextmanager
def surroundings() -> Iterator[tuple[Path, dict[str, str]]]:
    """Give a notebook an empty folder to work in, and an environment in which nothing was done before.

    No master is named in it: the notebook's own set-up starts a private one.
    """
    with tempfile.TemporaryDirectory(prefix="course-notebook-") as folder:
        work = Path(folder, "work")
        work.mkdir()
        environment = {**os.environ, "COURSE_STATE": str(Path(folder, "state"))}
        environment.pop("ROS_MASTER_URI", None)
        yield work, environment


def _by_files(folder: Path) -> Config:
    """Have the kernel talk through files in `folder`: another program can take a port before it does."""
    return Config(KernelManager={"transport": "ipc", "connection_file": str(folder / "kernel.json")})


def _what_went_wrong(notebook: Notebook, error: Exception) -> str:
    """Name the cell that stopped the run."""
    failed = [
        cell["id"]
        for cell in code_cells(notebook)
        if any(output["output_type"] == "error" for output in cell["outputs"])
    ]
    where = f"cell {failed[-1]}" if failed else "a cell"
    words = f"{error.ename}: {error.evalue}" if isinstance(error, CellExecutionError) else str(error)
    return f"{where} stopped the run with {words}"
