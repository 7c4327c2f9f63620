"""JupyterLab's settings for a graph in a private network."""

from __future__ import annotations

import shlex
from pathlib import Path

from course_pkg.lab.graph import network
from course_pkg.lab.graph.graph import Graph

SHELL = ("bash", "--rcfile", str(Path(__file__).parents[1] / "bashrc"))  # the command of a terminal


def settings_for(graph: Graph | None) -> dict[str, object]:
    """Return the settings, by the names of their traits, with which kernels and terminals are on `graph`.

    The server stays outside of a private network, so it reaches a kernel by sockets that are files (transport
    "ipc"). The terminals of JupyterLab run the course's shell.
    """
    command = network.entering(graph.files) if graph and graph.files else []
    terminals = {"ServerApp.terminado_settings": {"shell_command": [*command, *SHELL]}}
    if not command:
        return {**terminals}
    return {
        **terminals,
        "AsyncMappingKernelManager.kernel_manager_class": "course_pkg.lab.graph.kernels.GraphKernelManager",
        "GraphKernelManager.enter": shlex.join(command),
        "GraphKernelManager.transport": "ipc",
    }
