"""Measures `course lab`, a hub with many students, and the class view.

usage: ./course run python -m tests.bench.lab start [RUNS [NOTEBOOK]]
       ./course run python -m tests.bench.lab click [CLICKS]
       ./course run python -m tests.bench.lab kill [TIMES]
       ./course run python -m tests.bench.lab isolation [RUNS]
       ./course run --shared-graph python -m tests.bench.lab first PREFIX [RUNS]
       ./course run python -m tests.bench.lab students COUNT [--pause S] [--rounds N]
       ./course run python -m tests.bench.lab live

- `start` prints the time from the command to a page with a rendered notebook and an idle kernel, for
  `course lab` and for the unchanged `jupyter lab`.
- `click` prints the time from a click in the page until the page shows the result from Python, for the same
  two programs.
- `kill` sends SIGKILL to `course lab`, to its master, to its kernel, and to the process that keeps its
  private network. Each of these processes is killed TIMES times (default 25). `kill` prints how many
  processes, sockets, mounts and files remain.
- `isolation` measures a start, a click and a check, for `course lab` and for `course lab --shared-graph`.
- `first` measures the first and the second start of a new user of the installation in PREFIX.
- `students` measures a hub with COUNT students.
- `live` measures how long a result takes from a student's outbox to the teacher's page.

`./course test` installs the browser that these measurements need.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

from tests.bench.commands import run_command
from tests.bench.lab.class_view import live_main
from tests.bench.lab.first_start import first_start_main
from tests.bench.lab.hub import students_main
from tests.bench.lab.kill import kill
from tests.bench.lab.start import click, isolation, start


def _missed(measure: Callable[..., bool]) -> bool:
    """Run a measurement with the arguments of the command line; return whether a limit is not met."""
    return not measure(*(int(word) if word.isdigit() else word for word in sys.argv[1:]))


if __name__ == "__main__":
    run_command(
        {
            "start": lambda: _missed(start),
            "click": lambda: _missed(click),
            "kill": lambda: _missed(kill),
            "isolation": lambda: _missed(isolation),
            "first": first_start_main,
            "students": students_main,
            "live": live_main,
        }
    )
