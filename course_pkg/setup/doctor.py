"""`course doctor`: show what is installed, missing or outdated, and how the user can correct it."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple
from urllib.parse import urlsplit

from course_pkg.errors import SetupError
from course_pkg.setup import packages
from course_pkg.setup.network import network_problem, outgoing_problem
from course_pkg.setup.places import Places
from course_pkg.setup.steps import Step, steps_of
from course_pkg.waiting import wait_until

ENDING = 5.0  # The child processes of a killed process end within this time in s.
NEEDED = 1 << 30  # A complete set-up needs a little less than this number of bytes of disk space.
# A shared installation needs only the packages for `course lab`.
NEEDED_BY = (("course", "course lab"), ("grade", "course grade"), ("test", "course test"))


class Finding(NamedTuple):
    """The result of one examination of the set-up.

    `advice` says what the user can do, and is empty if there is no problem. If `optional` is true, the course
    also works with this problem.
    """

    what: str
    seen: str
    advice: str = ""
    optional: bool = False


def examine() -> int:
    """Print the findings; return 0 if there is no problem, otherwise 1."""
    findings = list(_findings(Places.of()))
    for what, seen, advice, optional in findings:
        sys.stdout.write(f"{'ok' if not advice else 'note' if optional else 'to do':6}{what}: {seen}\n")
        if advice:
            sys.stdout.write(f"{'':6}-> {advice}\n")
    return int(any(finding.advice and not finding.optional for finding in findings))


def _findings(places: Places) -> Iterator[Finding]:
    yield Finding("interpreter", f"{sys.executable}, Python {sys.version.split()[0]}")
    yield from _installed(places)
    yield _disk(places)
    yield _master()
    yield from _private_network()
    yield from _leftovers(places)


def _installed(places: Places) -> Iterator[Finding]:
    if not places.conda:
        try:
            platform = packages.read_platform(places.checkout)
        except SetupError as error:
            yield Finding("system", "has no packages of ROS 1", str(error))
            return
        yield Finding("system", platform.name)
        for part, needed_by in NEEDED_BY[: 1 if places.installed else None]:
            missing = packages.missing_packages(getattr(platform, part))
            advice = (
                f"`./course {needed_by.split()[1]}` installs these packages; or type as an administrator: "
                + (f"apt-get update && apt-get install --no-install-recommends {' '.join(missing)}")
            )
            seen = f"missing: {' '.join(missing)}" if missing else "installed"
            yield Finding(f"packages for `{needed_by}`", seen, advice if missing else "")
    for command, test in (("run true", False), *([] if places.installed else [("test", True)])):
        steps = [step for stage in steps_of(places, test=test) for step in stage]
        yield from (
            _made(step, command)
            for step in steps
            if step.makes and not (test and step.makes == places.workspace)
        )


def _made(step: Step, command: str) -> Finding:
    if step.is_done():
        return Finding(step.title, str(step.makes))
    seen = "outdated" if step.makes and step.makes.exists() else "missing"
    return Finding(step.title, seen, f"Run `./course {command}`.")


def _disk(places: Places) -> Finding:
    folder = next(path for path in (places.own_data, *places.own_data.parents) if path.exists())
    if not os.access(folder, os.W_OK):
        advice = "Set XDG_CACHE_HOME to a folder that you can write to."
        return Finding("cache", f"{folder} is not writable", advice)
    free = shutil.disk_usage(folder).free
    advice = (
        ""
        if free > NEEDED or places.environment.exists()
        else f"Delete files that you do not need: a set-up needs {NEEDED >> 20} MB."
    )
    return Finding("disk", f"{free >> 20} MB free for {places.cache}", advice)


def _master() -> Finding:
    given = os.environ.get("ROS_MASTER_URI")
    if not given:
        return Finding("ROS_MASTER_URI", "not set, so each command starts a master or joins a running graph")
    try:
        parts = urlsplit(given)
        well_formed = parts.scheme == "http" and bool(parts.hostname) and bool(parts.port)
    except ValueError:
        well_formed = False
    if not well_formed:
        return Finding(
            "ROS_MASTER_URI",
            given,
            "Set ROS_MASTER_URI to an address such as http://localhost:11311, or unset ROS_MASTER_URI.",
        )
    return _answering(given, str(parts.hostname), parts.port or 0)


def _private_network() -> Iterator[Finding]:
    problem, advice = network_problem()
    if problem:
        exposed = "Without a private network, all users who can log in can call, replace and stop your nodes."
        yield Finding(
            "private network for a graph", f"not possible: {problem}", f"{advice}. {exposed}", optional=True
        )
        return
    yield Finding("private network for a graph", "possible")
    problem, advice = outgoing_problem()
    yield Finding(
        "connections from the private network to other computers",
        problem or "possible",
        advice,
        optional=True,
    )


def _answering(uri: str, host: str, port: int) -> Finding:
    import socket

    try:
        socket.create_connection((host, port), timeout=2).close()
    except OSError as error:
        remedy = "Start the master at the address in ROS_MASTER_URI, or unset ROS_MASTER_URI."
        return Finding("ROS_MASTER_URI", f"{uri}: {error}", remedy)
    return Finding("ROS_MASTER_URI", f"{uri} answers")


def _leftovers(places: Places) -> Iterator[Finding]:
    """Find processes of this checkout that still run after the end of their parent process.

    After a SIGKILL of the parent, a supervisor normally ends its child within seconds.
    """
    orphans = _orphans(places)
    wait_until(lambda: not orphans & _orphans(places), ENDING, 0.1)
    stray = sorted(orphans & _orphans(places), key=int)
    advice = f"End these processes: kill {' '.join(stray)}" if stray else ""
    yield Finding("processes left over", ", ".join(stray) or "none", advice)


def _orphans(places: Places) -> set[str]:
    """Return the ids of the processes of this checkout that run after the end of their parent process."""
    found = set()
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = int(status.read_text().rpartition(")")[2].split()[1])
            command = (status.parent / "cmdline").read_bytes()
        except (OSError, ValueError):
            continue
        if parent == 1 and os.fsencode(places.cache) in command:
            found.add(status.parent.name)
    return found
