"""The connection to IPython: it tells when a cell begins and ends, and shows errors."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from course_pkg.ros.notebook.cells import Cells
from course_pkg.ros.notebook.error_display import ErrorDisplay
from course_pkg.ros.notebook.programs import Keep, ProgramMagics

if TYPE_CHECKING:
    from IPython.core.interactiveshell import ExecutionInfo, ExecutionResult, InteractiveShell


def current_shell() -> InteractiveShell | None:
    """Return the IPython shell that this process is the kernel of, or None in a plain program."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None


class NotebookShell:
    """Follows the cells of `shell`, and tells `cells` of each run."""

    def __init__(self, shell: InteractiveShell, cells: Cells) -> None:
        self._shell = shell
        self._cells = cells
        self.errors = ErrorDisplay(shell)
        shell.events.register("pre_run_cell", self._begin)
        shell.events.register("post_run_cell", self._end)
        if request := _execute_request(shell):  # join() is called in a cell that has begun already
            self._begin_run(request["metadata"].get("cellId"), request["content"]["code"])

    def add_programs(self, keep: Keep) -> None:
        """Give the notebook %rosrun and %roslaunch; `keep` gets each process that they start."""
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
        """Return the name of the file to which IPython says that the code of a cell belongs."""
        return str(self._shell.compile.get_code_name(code, code, self._shell.execution_count))


def _execute_request(shell: InteractiveShell) -> dict[str, Any] | None:
    """Return the message by which the front end has asked to run the current cell, if there is one."""
    kernel = getattr(shell, "kernel", None)
    parent = kernel.get_parent() if kernel is not None else {}
    asked = parent.get("header", {}).get("msg_type") == "execute_request"
    return parent if asked else None
