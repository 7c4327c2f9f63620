"""JupyterLab's settings for a graph in a private network."""

from __future__ import annotations

import shlex

from course_pkg.lab.graph import network
from course_pkg.lab.graph.graph import Graph
from course_pkg.lab.shell import SHELL


def settings_for(graph: Graph | None) -> dict[str, object]:
    """Return the settings that put kernels and terminals on the graph `graph`.

    The keys of the result are the names of Jupyter's traits.

    The server and a kernel communicate through sockets that are files (transport "ipc"). The server is
    outside a graph's private network and cannot use the TCP ports of a kernel inside. In the network of the
    machine, another program could take a kernel's TCP port before the kernel opens it.
    """
    if not graph or not graph.files:
        return {"KernelManager.transport": "ipc"}
    command = network.entering(graph.files)
    return {
        "ServerApp.terminado_settings": {"shell_command": [*command, *SHELL]},
        "AsyncMappingKernelManager.kernel_manager_class": "course_pkg.lab.graph.kernels.GraphKernelManager",
        "GraphKernelManager.enter": shlex.join(command),
        "GraphKernelManager.transport": "ipc",
    }
