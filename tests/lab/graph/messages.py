"""Sends cells to a kernel of `course lab`, and reads the output of the cells."""

from __future__ import annotations

from pathlib import Path

from jupyter_client.blocking import BlockingKernelClient

from tests.lab.commands import below, having
from tests.lab.test_jupyterlab import Service
from tests.support import eventually


class Messages:
    """A client that sends cells to a running kernel of `course lab` through the kernel's sockets."""

    def __init__(self, service: Service) -> None:
        [server] = having(b"-m\0course_pkg.lab\0", below(service.process))[1:]
        self._folder = Path(variable(server, "JUPYTER_RUNTIME_DIR"))

    def run(self, code: str, until: str) -> str:
        """Run a cell, and return its output up to the first message of the type `until`.

        If the cell raises an error, the output contains the error's name.
        """
        [file] = eventually(lambda: list(self._folder.glob("kernel-*.json")))
        client = BlockingKernelClient(connection_file=str(file))
        client.load_connection_file()
        client.start_channels()
        try:
            # A kernel does not answer a heartbeat while it starts.
            client.kernel_info(reply=True, timeout=30)
            client.wait_for_ready(timeout=30)
            client.execute(code)
            printed = ""
            while True:
                message = client.get_iopub_msg(timeout=30)
                content = message["content"]
                printed += content.get("text", "") + content.get("ename", "")
                if message["msg_type"] == until and content.get("execution_state", "idle") == "idle":
                    return printed
        finally:
            client.stop_channels()


def variable(pid: int, name: str) -> str:
    """Return an environment variable of a process."""
    words = Path(f"/proc/{pid}/environ").read_bytes().decode().split("\0")
    return dict(word.split("=", 1) for word in words if "=" in word)[name]
