"""Connect to IPython: report the start and end of each cell run, and show errors."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from course_pkg.ros.notebook.cells import Cells
from course_pkg.ros.notebook.error_display import ErrorDisplay
from course_pkg.ros.notebook.programs import Keep, ProgramMagics

if TYPE_CHECKING:
    from IPython.core.interactiveshell import ExecutionInfo, ExecutionResult, InteractiveShell


def current_shell() -> InteractiveShell | None:
    """Return this kernel's IPython shell, or None if this process is not a kernel."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


class NotebookShell:
    """Observes the cell runs of IPython's shell, and reports each run to the object `cells`."""

    def __init__(self, shell: InteractiveShell, cells: Cells) -> None:
        self._shell = shell
        self._cells = cells
        self.errors = ErrorDisplay(shell)
        shell.events.register("pre_run_cell", self._begin)
        shell.events.register("post_run_cell", self._end)
        # The cell that calls join() is already running, so the next line reports the start of this cell.
        if request := _execute_request(shell):
            self._begin_run(request["metadata"].get("cellId"), request["content"]["code"])

    def add_programs(self, keep: Keep) -> None:
        """Add %rosrun and %roslaunch to the notebook; both call the function `keep` with each new process."""
        ProgramMagics(self._shell, self._cells, keep)

    def _begin(self, info: ExecutionInfo) -> None:
        self._begin_run(info.cell_id, info.raw_cell or "")

    def _begin_run(self, cell: str | None, code: str) -> None:
        source = self._source(code)
        self.errors.begin_cell(source)
        self._cells.begin(cell, source)

    def _end(self, result: ExecutionResult | None) -> None:
        error = result.error_before_exec or result.error_in_exec if result is not None else None
        self._cells.end(error)

    def _source(self, code: str) -> str:
        """Return IPython's file name for the code of a cell."""
        return str(self._shell.compile.get_code_name(code, code, self._shell.execution_count))


def _execute_request(shell: InteractiveShell) -> dict[str, Any] | None:
    """Return the front end's request to run the current cell, or None if there is no request."""
    kernel = getattr(shell, "kernel", None)
    parent = kernel.get_parent() if kernel is not None else {}
    asked = parent.get("header", {}).get("msg_type") == "execute_request"
    return parent if asked else None
