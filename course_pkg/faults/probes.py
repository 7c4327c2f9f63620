"""The tools with which a student looks for the cause of a fault: real commands with a time limit."""

from __future__ import annotations

from course_pkg.errors import GraphError
from course_pkg.faults.program import Seen
from course_pkg.faults.stage import Stage
from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.ros.protocol.registrations import remove_stale

TIMEOUT = 4.0  # A tool has to end within this time in s; the start of a tool takes 0.5 s.

COMMANDS = {
    "services": "rosservice list",
    "nodes": "rosnode list",
    "info": "rosservice info /lab/door",
    "ping": "rosnode ping -c 1 /lab/keeper",
}
TOOLS = {
    **{name: f"`{line}`" for name, line in COMMANDS.items()},
    "output": "Output of the server",
    "cleanup": "Remove stale entries",
    "again": "Call again",
}


def probe(stage: Stage, tool: str) -> Seen:
    """Run a tool from `TOOLS` on a stage's graph, and return the tool's output; a tool takes at most 10 s."""
    if tool == "again":
        return stage.symptom()
    if tool == "output":
        return _output(stage)
    if tool == "cleanup":
        return _cleaned(stage)
    program = stage.command(COMMANDS[tool])
    seen = program.watch(TIMEOUT)
    program.end()
    return seen


def _output(stage: Stage) -> Seen:
    """Return the output of the server, and whether its process is still running."""
    keeper = stage.keeper
    if keeper is None:
        return Seen("the server's output", "No server was started in this case.", 0.0, 0)
    state = "Its process still exists." if keeper.running else "Its process has ended."
    return Seen("the server's output", f"{keeper.output().strip() or '(nothing printed)'}\n{state}", 0.0, 0)


def _cleaned(stage: Stage) -> Seen:
    """Remove stale registrations of this fault's nodes; `rosnode cleanup` does this for all nodes."""
    try:
        nodes = MasterClient(stage.uri).system_state().nodes
        own = [node for node in nodes if node.startswith(f"{stage.namespace}/")]
        removed = remove_stale(stage.uri, nodes=own)
    except GraphError as error:
        return Seen("rosnode cleanup, for the nodes of this case", str(error), 0.0, 1)
    lines = [f"Unregistering {entry.kind} {entry.name} of {entry.node}" for entry in removed]
    said = "\n".join(lines) or "There are no stale registrations."
    return Seen("rosnode cleanup, for the nodes of this case", said, 0.0, 0)
