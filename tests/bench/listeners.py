"""Which sockets listen, and where, while the chapters run: `python tests/bench/listeners.py`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from course_pkg.authoring.execute import surroundings
from course_pkg.graph.leashed import descendants

SOLUTIONS = sorted((Path(__file__).parents[2] / "solutions").glob("*.ipynb"))
LISTEN = "0A"
LOOPBACK = ("0100007F", "00000000000000000000000001000000", "0000000000000000FFFF00000100007F")


def main() -> None:
    """Run each chapter from the top, and look all the while."""
    away: set[str] = set()
    for path in SOLUTIONS:
        seen = listeners_during(path)
        foreign = {address for address in seen if address.partition(":")[0] not in LOOPBACK}
        away |= foreign
        print(f"{path.stem}: {len(seen)} sockets listened, {len(foreign)} of them off 127.0.0.1")
    sys.exit(bool(away))


def listeners_during(path: Path) -> set[str]:
    """Return the addresses at which the processes of a chapter listened, as /proc/net/tcp has them."""
    convert = [
        sys.executable,
        "-m",
        "jupyter",
        "execute",
        str(path),
        "--output",
        "/dev/null",
        "--timeout=120",
    ]
    seen: set[str] = set()
    with surroundings() as (folder, environment):
        with subprocess.Popen(
            convert, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        ) as run:
            while run.poll() is None:
                seen |= listening([run.pid, *descendants(run.pid)])
                try:
                    run.wait(0.05)
                except subprocess.TimeoutExpired:
                    continue
        if run.returncode:
            raise SystemExit(f"{path.name} did not run to its end")
    return seen


def listening(pids: list[int]) -> set[str]:
    """Return the addresses at which `pids` listen."""
    sockets = {inode for pid in pids for inode in inodes(pid)}
    tables = [Path("/proc/net/tcp"), Path("/proc/net/tcp6")]
    rows = [line.split() for table in tables if table.exists() for line in table.read_text().splitlines()[1:]]
    return {row[1] for row in rows if row[3] == LISTEN and row[9] in sockets}


def inodes(pid: int) -> set[str]:
    """Return the inodes of the sockets that `pid` holds."""
    try:
        links = [os.readlink(entry) for entry in os.scandir(f"/proc/{pid}/fd")]
    except OSError:
        return set()
    return {link.removeprefix("socket:[").removesuffix("]") for link in links if link.startswith("socket:[")}


if __name__ == "__main__":
    main()
