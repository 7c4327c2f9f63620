"""Functions for the subcommands and the time measurements of the benchmarks."""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Mapping
from typing import NoReturn


def run_command(commands: Mapping[str, Callable[[], int | None]]) -> NoReturn:
    """Run the subcommand that the first argument names, and pass the other arguments to this subcommand."""
    name = sys.argv.pop(1) if len(sys.argv) > 1 else ""
    if name not in commands:
        sys.exit(f"The first argument is a subcommand: {', '.join(commands)}.")
    sys.exit(commands[name]())


def milliseconds(action: Callable[[], object]) -> float:
    """Return the duration of an action in ms."""
    began = time.perf_counter()
    action()
    return 1000 * (time.perf_counter() - began)


def times_of(action: Callable[[], object], repeats: int) -> list[float]:
    """Run an action several times, and return the duration of each run in ms."""
    return [milliseconds(action) for _ in range(repeats)]


def alternate(actions: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """Return the median duration of each action in ms; the actions run alternately."""
    times: dict[str, list[float]] = {name: [] for name in actions}
    for _ in range(rounds):
        for name, action in actions.items():
            times[name].append(milliseconds(action))
    return {name: statistics.median(values) for name, values in times.items()}
