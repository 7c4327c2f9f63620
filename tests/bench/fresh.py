"""Prints how long a first `./course run rosservice list` takes on a fresh Debian, set-up included.

usage, as root, with debootstrap installed:
    /usr/bin/python3 tests/bench/fresh.py [RUNS [CODENAME]]

A pristine system is made once, from the mirror that this machine's apt uses, and copied for each run.
"""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
BAR = 60.0  # s
# What a machine needs to be told of its surroundings: where packages come from, and whose certificates hold.
SURROUNDINGS = (
    "/etc/apt/sources.list",
    "/etc/apt/sources.list.d",
    "/etc/apt/apt.conf.d",
    "/etc/apt/auth.conf.d",
    "/etc/resolv.conf",
    "/etc/hosts",
    "/etc/pip.conf",
    "/etc/ssl/certs/ca-certificates.crt",
)
KEPT = (
    "http_proxy",
    "https_proxy",
    "no_proxy",
    "SSL_CERT_FILE",
    "PIP_CERT",
    "PIP_INDEX_URL",
    "PIP_EXTRA_INDEX_URL",
)
INSIDE = 'mount --bind /proc "$0/proc" && mount --bind /dev "$0/dev" && exec chroot "$0" sh -c "$1"'


def main(runs: int, codename: str) -> int:
    """Measure each run in a copy of its own."""
    if os.geteuid() or not shutil.which("debootstrap"):
        sys.exit("This needs root and debootstrap.")
    with tempfile.TemporaryDirectory(prefix="fresh-") as folder:
        pristine = Path(folder, "pristine")
        subprocess.run(
            [
                "debootstrap",
                "--variant=minbase",
                "--include=ca-certificates",
                codename,
                pristine,
                mirror(codename),
            ],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        tell_surroundings(pristine)
        seconds = [measure(pristine, Path(folder, f"run-{number}")) for number in range(runs)]
    median = statistics.median(seconds)
    print(f"first `./course run rosservice list` on a fresh {codename}: {[round(it, 1) for it in seconds]} s")
    print(f"median {median:.1f} s, bar {BAR:.0f} s: {'met' if median <= BAR else 'MISSED'}")
    return 0


def measure(pristine: Path, system: Path) -> float:
    """Return the seconds of a first start in a copy of `pristine`."""
    subprocess.run(["cp", "-a", pristine, system], check=True)
    checkout = system / "home" / "course"
    checkout.mkdir(parents=True)
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
    ).stdout
    subprocess.run(
        ["tar", "--create", "--null", "--files-from=-", "--file", system / "course.tar"],
        cwd=ROOT,
        input=listed,
        check=True,
    )
    subprocess.run(["tar", "--extract", "--file", system / "course.tar", "--directory", checkout], check=True)
    started = time.perf_counter()
    inside(system, "cd /home/course && ./course run rosservice list")
    seconds = time.perf_counter() - started
    shutil.rmtree(system)
    return seconds


def inside(system: Path, script: str) -> None:
    """Run `script` in `system`, in a mount namespace that ends with it."""
    env = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root"}
    env |= {name: os.environ[name] for name in (*KEPT, *(it.upper() for it in KEPT)) if name in os.environ}
    subprocess.run(["unshare", "--mount", "sh", "-c", INSIDE, system, script], env=env, check=True)


def mirror(codename: str) -> str:
    """Return where this machine's apt takes `codename` from; another release is taken from the same place."""
    targets = [
        "apt-get",
        "indextargets",
        "--format",
        "$(REPO_URI) $(RELEASE) $(COMPONENT)",
        "Created-By: Packages",
    ]
    lines = subprocess.run(targets, capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [line.split() for line in lines]
    fitting = [row[0] for row in rows if row[1] == codename] or [row[0] for row in rows if "-" not in row[1]]
    return fitting[0]


def tell_surroundings(system: Path) -> None:
    """Copy into `system` what it needs to reach the same mirrors as this machine."""
    for name in SURROUNDINGS:
        source, target = Path(name), system / name[1:]
        if source.is_dir():
            for path in source.glob("[a-z0-9]*.*"):
                if "docker" not in path.name:
                    shutil.copy(path, target / path.name)
        elif source.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if sys.argv[1:] else 3, sys.argv[2] if sys.argv[2:] else "bookworm"))
