"""`course doctor`: what is there, what is missing or stale, and what to do about each."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple
from urllib.parse import urlsplit

from course_pkg.errors import SetupError
from course_pkg.provision import packages
from course_pkg.provision.places import Places
from course_pkg.provision.platforms import read_platform
from course_pkg.provision.setup import Step, steps_of

ROOM = 1 << 30  # bytes that a set-up from nothing takes, with some to spare


class Finding(NamedTuple):
    """Something that was looked at: all is well, or `advice` says what to do."""

    what: str
    seen: str
    advice: str = ""


def examine() -> int:
    """Print what is found; return 0 if all is well, else 1."""
    findings = list(_findings(Places.of()))
    for what, seen, advice in findings:
        sys.stdout.write(f"{'to do' if advice else 'ok':6}{what}: {seen}\n")
        if advice:
            sys.stdout.write(f"{'':6}-> {advice}\n")
    return int(any(finding.advice for finding in findings))


def _findings(places: Places) -> Iterator[Finding]:
    yield Finding("interpreter", f"{sys.executable}, Python {sys.version.split()[0]}")
    yield from _installed(places)
    yield _room(places)
    yield _master()
    yield from _leftovers(places)


def _installed(places: Places) -> Iterator[Finding]:
    if not places.conda:
        try:
            platform = read_platform(places.checkout)
        except SetupError as error:
            yield Finding("system", "not one that has ROS 1", str(error))
            return
        yield Finding("system", platform.name)
        for part, needed_by in (("course", "course lab"), ("grade", "course grade"), ("test", "course test")):
            missing = packages.missing_packages(getattr(platform, part))
            advice = f"`./course {needed_by.split()[1]}` installs them; or, as an administrator: " + (
                f"apt-get update && apt-get install --no-install-recommends {' '.join(missing)}"
            )
            seen = f"missing: {' '.join(missing)}" if missing else "installed"
            yield Finding(f"packages for `{needed_by}`", seen, advice if missing else "")
    for command, test in (("run true", False), ("test", True)):
        steps = [step for stage in steps_of(places, test=test) for step in stage]
        yield from (
            _made(step, command)
            for step in steps
            if step.makes and not (test and step.makes == places.workspace)
        )


def _made(step: Step, command: str) -> Finding:
    if step.is_done():
        return Finding(step.title, str(step.makes))
    seen = "stale" if step.makes and step.makes.exists() else "not there yet"
    return Finding(step.title, seen, f"`./course {command}` does it")


def _room(places: Places) -> Finding:
    folder = next(path for path in (places.cache, *places.cache.parents) if path.exists())
    if not os.access(folder, os.W_OK):
        return Finding("cache", f"{folder} cannot be written to", "Set XDG_CACHE_HOME to a folder of yours.")
    free = shutil.disk_usage(folder).free
    advice = (
        "" if free > ROOM or places.environment.exists() else f"Make room: a set-up takes {ROOM >> 20} MB."
    )
    return Finding("disk", f"{free >> 20} MB free for {places.cache}", advice)


def _master() -> Finding:
    given = os.environ.get("ROS_MASTER_URI")
    if not given:
        return Finding("ROS_MASTER_URI", "not set: every command has a master of its own")
    try:
        parts = urlsplit(given)
        well_formed = parts.scheme == "http" and bool(parts.hostname) and bool(parts.port)
    except ValueError:
        well_formed = False
    if not well_formed:
        return Finding("ROS_MASTER_URI", given, "It must be like http://localhost:11311. Mend or unset it.")
    return _answering(given, str(parts.hostname), parts.port or 0)


def _answering(uri: str, host: str, port: int) -> Finding:
    import socket

    try:
        socket.create_connection((host, port), timeout=2).close()
    except OSError as error:
        return Finding("ROS_MASTER_URI", f"{uri}: {error}", "Start that master, or unset the variable.")
    return Finding("ROS_MASTER_URI", f"{uri} answers")


def _leftovers(places: Places) -> Iterator[Finding]:
    """Look for processes of this checkout that have lost their parent."""
    stray = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = int(status.read_text().rpartition(")")[2].split()[1])
            command = (status.parent / "cmdline").read_bytes()
        except (OSError, ValueError):
            continue
        if parent == 1 and os.fsencode(places.cache) in command:
            stray.append(status.parent.name)
    advice = f"End them: kill {' '.join(stray)}" if stray else ""
    yield Finding("processes left over", ", ".join(stray) or "none", advice)
