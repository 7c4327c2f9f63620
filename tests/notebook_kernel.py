"""Runs a real IPython kernel that receives the id of each cell, as in JupyterLab."""

from __future__ import annotations

import os
import queue
import tempfile
import textwrap
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType

from jupyter_client import BlockingKernelClient, KernelManager

TIMEOUT = 30.0  # TIMEOUT is the maximum duration of a cell in s.


@dataclass
class Shown:
    """The outputs of a cell: its streams, the text of its results, and the traceback of its error."""

    out: str = ""
    err: str = ""
    results: list[str] = field(default_factory=list)
    ename: str = ""
    evalue: str = ""
    traceback: list[str] = field(default_factory=list)
    others: str = ""  # The text that other cells printed while this cell ran.

    @property
    def error_lines(self) -> list[str]:
        """The lines of the traceback."""
        return "\n".join(self.traceback).splitlines()


class NotebookKernel:
    """An IPython kernel process, and the client that sends cells to it."""

    def __init__(self, env: Mapping[str, str] | None = None) -> None:
        # With TCP, another program could take the chosen port before the kernel listens on it.
        self._folder = tempfile.TemporaryDirectory(prefix="kernel-")
        sockets = str(Path(self._folder.name) / "kernel.json")
        self.manager = KernelManager(kernel_name="python3", transport="ipc", connection_file=sockets)
        self.manager.start_kernel(env={**os.environ, **(env or {})})
        self.client: BlockingKernelClient = self.manager.client()
        self.client.start_channels()
        self.client.wait_for_ready(timeout=TIMEOUT)

    def __enter__(self) -> NotebookKernel:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.client.stop_channels()
        self.manager.shutdown_kernel(now=True)
        self._folder.cleanup()

    def begin(self, code: str, cell: str | None = None) -> str:
        """Send the code and the id of a cell to the kernel, and return the message id."""
        content = {
            "code": textwrap.dedent(code).strip("\n"),
            "silent": False,
            "store_history": True,
            "user_expressions": {},
            "allow_stdin": False,
            "stop_on_error": True,
        }
        metadata = {} if cell is None else {"cellId": cell}
        message = self.client.session.msg("execute_request", content, metadata=metadata)
        self.client.shell_channel.send(message)
        return str(message["header"]["msg_id"])

    def run(self, code: str, cell: str | None = None, timeout: float = TIMEOUT) -> Shown:
        """Run a cell, and return its outputs."""
        return self.shown(self.begin(code, cell), timeout)

    def shown(self, number: str, timeout: float = TIMEOUT) -> Shown:
        """Wait for the end of a cell, and return its outputs; `number` is the id of the cell's message.

        Raises AssertionError if the cell takes longer than the time limit (in s).
        """
        shown, deadline = Shown(), time.monotonic() + timeout
        while True:
            try:
                message = self.client.get_iopub_msg(timeout=max(deadline - time.monotonic(), 0.01))
            except queue.Empty:
                raise AssertionError(f"the cell did not end within {timeout:g} s: {shown}") from None
            kind, content = message["msg_type"], message["content"]
            if message["parent_header"].get("msg_id") != number:
                shown.others += str(content.get("text", ""))
            elif kind == "status" and content["execution_state"] == "idle":
                return shown
            elif kind == "stream":
                setattr(shown, content["name"][3:], getattr(shown, content["name"][3:]) + content["text"])
            elif kind in ("execute_result", "display_data"):
                shown.results.append(content["data"].get("text/plain", ""))
            elif kind == "error":
                shown.ename, shown.evalue = content["ename"], content["evalue"]
                shown.traceback = content["traceback"]
