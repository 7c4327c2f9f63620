"""`course test`: runs the tests, and at the same time the tools that check the code."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from threading import Thread

from course_pkg.errors import SetupError
from course_pkg.setup import Places

TOOLS = {
    "lint": "ruff check --quiet .",
    "format": "ruff format --quiet --check .",
    "types": "mypy",
    "spelling": "codespell",
    "imports": "lint-imports",
    "dead code": "vulture",
}
# After a run of all tests, pytest lists the slowest tests.
SLOWEST = ("--durations", "40", "--durations-min", "4")
A_CORE = 2  # Each core has this many pytest workers, because most tests wait for nodes, browsers or builds.


@dataclass
class Tool:
    """One tool that checks the code: its command and its result."""

    name: str
    command: str
    output: str = ""
    passed: bool = False
    took: float = 0.0  # The time is in s.

    def run(self, places: Places) -> None:
        """Run the tool, and wait until it has ended."""
        started = time.monotonic()
        program, *arguments = self.command.split()
        result = subprocess.run(
            [places.venv / "bin" / program, *arguments],
            cwd=places.checkout,
            env={**os.environ, "PYTHONPATH": str(places.checkout)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        self.passed, self.output = result.returncode == 0, result.stdout
        self.took = time.monotonic() - started


def run_suite(arguments: Sequence[str]) -> int:
    """Run all tools and all tests, even if some of them fail; return 0 if all of them pass.

    `--changed` runs only the tests that a change since the last successful run can affect. `--slow` runs only
    the slow tests. pytest gets all other `arguments`; with such arguments, no tool runs.

    Raises SetupError if the tools are not installed, for example in a conda environment.
    """
    places = Places.of()
    if not (places.venv / "bin" / "ruff").exists():
        lock = places.checkout / "course_pkg" / "setup" / "locks" / "test.txt"
        raise SetupError(f"The tools for the tests are not installed. Type: python -m pip install -r {lock}")
    own = {"--changed", "--slow"} & set(arguments)
    others = [word for word in arguments if word not in own]
    tools = [] if others or "--slow" in own else [Tool(*each) for each in TOOLS.items()]
    reading = Thread(target=_run_tools, args=(tools, places))
    reading.start()
    workers = str(A_CORE * (os.cpu_count() or 1))
    spread = [] if others else ["-n", workers, "--dist", "loadgroup", "--no-loadscope-reorder", *SLOWEST]
    status = _run_tests(places, [*spread, *sorted(own), *others])
    reading.join()
    failed = [tool for tool in tools if not tool.passed]
    for tool in failed:
        sys.stderr.write(f"\n{tool.name} failed:\n{tool.output[-6000:]}\n  ./course run {tool.command}\n")
    return status or int(bool(failed))


def _run_tools(tools: Sequence[Tool], places: Places) -> None:
    for tool in tools:
        tool.run(places)
        sys.stderr.write(f"{tool.name}: {'passed' if tool.passed else 'failed'} ({tool.took:.1f} s)\n")


def _run_tests(places: Places, arguments: Sequence[str]) -> int:
    environment = {name: value for name, value in os.environ.items() if name != "ROS_MASTER_URI"}
    command = [str(places.python), "-m", "pytest", "-p", "tests.selection", *arguments]
    return subprocess.run(command, cwd=places.checkout, env=environment, check=False).returncode


def repeat_command(test: str) -> str:
    """Return the command line that runs the test with the id `test` again."""
    return f"./course test {shlex.quote(test)}"
