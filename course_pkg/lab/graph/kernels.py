"""The kernels of JupyterLab, started in the private network of a graph."""

from __future__ import annotations

import shlex

from jupyter_server.services.kernels.kernelmanager import ServerKernelManager
from traitlets import Unicode


class GraphKernelManager(ServerKernelManager):  # type: ignore[misc]  # The base class has no types.
    """Starts a kernel of any kind with the command `enter`, which executes the kernel in the same process.

    `enter` does not start a new process. The server therefore knows the kernel's process id and can interrupt
    the kernel.
    """

    enter = Unicode(help="the start of each kernel's command").tag(config=True)

    def format_kernel_cmd(self, extra_arguments: list[str] | None = None) -> list[str]:
        """Return the command that starts the kernel."""
        return [*shlex.split(self.enter), *super().format_kernel_cmd(extra_arguments=extra_arguments)]
