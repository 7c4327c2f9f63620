"""Runs notebooks from the first to the last cell, several at the same time, and stores their outputs."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from pathlib import Path
from textwrap import indent

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from traitlets.config import Config

from course_pkg.authoring.cells import Notebook, code_cells, not_passed
from course_pkg.authoring.normalise import strip, tidy
from course_pkg.authoring.notebook_store import NotebookStore, read, text_of
from course_pkg.authoring.pictures import add_pictures
from course_pkg.checking.parts import chapters, parts_of
from course_pkg.errors import AuthoringError
from course_pkg.ros.process.supervised import temporary_folder
from course_pkg.setup.progress import Progress

CELL_TIMEOUT = 120  # A cell is stopped after this time in s; a reader should not wait longer.
# Each core runs PER_CORE notebooks at the same time; a notebook mostly waits for nodes and responses.
PER_CORE = 3
A_CELL = 2.0  # The estimated running time of a notebook contains this time in s for each cell.

Finished = Callable[[str, Notebook], None]


def workers_here(notebooks: int) -> int:
    """Return the number of notebooks that this machine should run at the same time."""
    return max(1, min(notebooks, PER_CORE * (os.cpu_count() or 1)))


def execute(chapters: Sequence[str] = (), root: Path | None = None) -> None:
    """Run the solutions of the given chapters, or of all chapters, and store them with their outputs.

    For example, `chapters` is ["05"].

    The file of a solution does not change if the solution stops before its last cell or one of its checks
    does not pass. When all solutions have run, the function raises AuthoringError with all errors and
    reports.
    """
    paths = {path.stem: path for path in NotebookStore(root).solutions(chapters)}
    stored = {name: read(path) for name, path in paths.items()}

    def store(name: str, notebook: Notebook) -> None:
        if failed := not_passed(notebook):
            raise AuthoringError("\n".join(_about_check(name, *each) for each in failed.items()))
        add_pictures(notebook, stored[name])
        tidy(notebook)
        paths[name].write_text(text_of(notebook), "utf-8")

    errors = run_all(stored, store)
    if errors:
        raise AuthoringError("\n".join(map(str, errors.values())))


def run_all(notebooks: Mapping[str, Notebook], finished: Finished) -> dict[str, AuthoringError]:
    """Run all notebooks, several at the same time; the keys of `notebooks` are the notebooks' names.

    Call the function `finished` for each notebook that ran to its last cell, with the notebook's name and
    outputs. Return the errors of the notebooks that stopped earlier; the keys are the notebooks' names. A
    KeyboardInterrupt ends all kernels.
    """
    progress = Progress(total=sum(len(code_cells(each)) for each in notebooks.values()), unit="cells")
    # In the main thread, nbclient would handle SIGINT itself, and would interrupt only one kernel. Therefore,
    # the kernels run in another thread.
    with progress.painting(), closing(asyncio.new_event_loop()) as loop, ThreadPoolExecutor(1) as thread:
        task = loop.create_task(_run_all(notebooks, finished, progress))
        try:
            return thread.submit(loop.run_until_complete, task).result()
        except KeyboardInterrupt:
            loop.call_soon_threadsafe(task.cancel)
            raise


async def _run_all(
    notebooks: Mapping[str, Notebook], finished: Finished, progress: Progress
) -> dict[str, AuthoringError]:
    slots = asyncio.Semaphore(workers_here(len(notebooks)))
    errors: dict[str, AuthoringError] = {}

    async def run(name: str) -> None:
        async with slots:
            try:
                with progress.step(name):
                    finished(name, await _run(name, notebooks[name], progress))
            except AuthoringError as error:
                errors[name] = error

    await asyncio.gather(*(run(name) for name in _longest_first(notebooks)))
    return errors


def _about_check(name: str, check: str, report: str) -> str:
    shown = indent(report, "  ") or "  The cell shows no report."
    return f"{name}: check {check} has not passed, so nothing was stored for this chapter:\n{shown}"


def _longest_first(notebooks: Mapping[str, Notebook]) -> list[str]:
    """Return the names, sorted by estimated time; the longest time comes first.

    A late start of the longest notebook would delay the end of the whole run.

    The estimate grows with the number of a notebook's cells and with the deadlines of its checks.
    """

    def estimate(name: str) -> float:
        deadlines = [part.deadline for part in parts_of(name[:2])] if name[:2] in chapters() else []
        return A_CELL * len(code_cells(notebooks[name])) + sum(deadlines)

    return sorted(notebooks, key=estimate, reverse=True)


async def _run(name: str, notebook: Notebook, progress: Progress) -> Notebook:
    """Run a copy of the notebook `notebook` in a new kernel with a separate master and separate folders.

    Return the copy.
    """
    node = nbformat.from_dict(notebook)
    fresh: Notebook = node
    strip(fresh)
    with surroundings() as (folder, environment):
        client = NotebookClient(
            node,
            timeout=CELL_TIMEOUT,
            kernel_name="python3",
            on_cell_executed=lambda **_: progress.advance(),
            config=_by_files(folder.parent),
        )
        client.resources = {"metadata": {"path": str(folder)}}
        try:
            await client.async_execute(env=environment)
        except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
            raise AuthoringError(f"{name}: {_what_went_wrong(fresh, error)}") from error
    return fresh


@contextmanager
def surroundings() -> Iterator[tuple[Path, dict[str, str]]]:
    """Yield an empty folder for one notebook, and an environment without the state of earlier notebooks.

    Each notebook has separate folders for temporary files, results and logs, because several notebooks can
    run at the same time. The environment does not contain the address of a master, because the first cell of
    a notebook starts a private master.
    """
    with temporary_folder("course-notebook-") as folder:
        work, temporary = folder / "work", folder / "tmp"
        work.mkdir()
        temporary.mkdir()
        private = {
            "TMPDIR": temporary,
            "COURSE_STATE": folder / "state",
            # The cells of the chapters use the relative path ../workspace.
            "COURSE_WORKSPACE": folder / "workspace",
            "ROS_LOG_DIR": folder / "log",
        }
        environment = {**os.environ, **{name: str(path) for name, path in private.items()}}
        environment.pop("ROS_MASTER_URI", None)
        yield work, environment


def _by_files(folder: Path) -> Config:
    """Return settings for a kernel that uses Unix sockets in the folder `folder` instead of TCP ports.

    Another program could take a TCP port before the kernel opens the port.
    """
    return Config(KernelManager={"transport": "ipc", "connection_file": str(folder / "kernel.json")})


def _what_went_wrong(notebook: Notebook, error: Exception) -> str:
    failed = [
        cell["id"]
        for cell in code_cells(notebook)
        if any(output["output_type"] == "error" for output in cell["outputs"])
    ]
    where = f"cell {failed[-1]}" if failed else "a cell"
    words = f"{error.ename}: {error.evalue}" if isinstance(error, CellExecutionError) else str(error)
    return f"the run stopped at {where}: {words}"
