"""Measures the duration of the set-up, of imports, and of builds.

usage: ./course run python -m tests.bench.setup fresh|imports|cpp [OPTION …]
"""

from __future__ import annotations

import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from tests.bench.commands import run_command

# fresh: prints how long the first `./course run rosservice list` takes on a new Debian system, including the
# set-up. usage: /usr/bin/python3 -m tests.bench.setup fresh [RUNS [CODENAME]]. The benchmark needs root and
# debootstrap. The benchmark creates a new system once, from the apt mirror of this machine, and copies this
# system for each run.

ROOT = Path(__file__).parents[2]
FRESH_BAR = 60.0  # s

# The new system needs these files for package downloads: mirrors, name servers and certificates.
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


def fresh_main() -> int:
    """Measure each run in a copy of a new system, and print the median."""
    runs = int(sys.argv[1]) if sys.argv[1:] else 3
    codename = sys.argv[2] if sys.argv[2:] else "bookworm"
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
        seconds = [fresh_measure(pristine, Path(folder, f"run-{number}")) for number in range(runs)]
    median = statistics.median(seconds)
    print(f"first `./course run rosservice list` on a fresh {codename}: {[round(it, 1) for it in seconds]} s")
    print(f"median {median:.1f} s, bar {FRESH_BAR:.0f} s: {'met' if median <= FRESH_BAR else 'MISSED'}")
    return 0


def fresh_measure(pristine: Path, system: Path) -> float:
    """Copy a newly installed system, and return the time in s of the course's first start in the copy."""
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
    """Run a script in a mount namespace, with the copied system as the root folder."""
    env = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root"}
    env |= {name: os.environ[name] for name in (*KEPT, *(it.upper() for it in KEPT)) if name in os.environ}
    subprocess.run(["unshare", "--mount", "sh", "-c", INSIDE, system, script], env=env, check=True)


def mirror(codename: str) -> str:
    """Return the apt mirror for a Debian release; the default is the release of this machine."""
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
    """Copy the files that are needed for package downloads into the new system."""
    for name in SURROUNDINGS:
        source, target = Path(name), system / name[1:]
        if source.is_dir():
            for path in source.glob("[a-z0-9]*.*"):
                if "docker" not in path.name:
                    shutil.copy(path, target / path.name)
        elif source.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


# imports: compares the import times of `course_pkg` and of a notebook's imports with the import time of
# rospy.

ROUNDS = 21
# The import of course_pkg may take at most this many ms longer than the import of rospy.
IMPORTS_BAR = 60.0
PEER = "import rospy"
STATEMENTS = {
    "course_pkg": "import rospy, course_pkg",
    "join": "import rospy; from course_pkg import join",
    "check": "import rospy; from course_pkg import check",
    "join, check, predict, panels": (
        "import rospy; from course_pkg import join, check, predict, ServicePanel, GraphPanel"
    ),
    "ipywidgets, for comparison": "import rospy, ipywidgets",
}


def import_time(statement: str) -> float:
    """Return the time in ms that a new interpreter needs for a statement."""
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", statement], check=True)
    return (time.perf_counter() - start) * 1000


def imports_main() -> None:
    """For each import, print how much longer it takes than the import of rospy (median)."""
    taken: dict[str, list[float]] = {name: [] for name in STATEMENTS}
    for _ in range(ROUNDS):
        peer = import_time(PEER)
        for name, statement in STATEMENTS.items():
            taken[name].append(import_time(statement) - peer)
    for name, times in taken.items():
        print(f"{name}: {statistics.median(times):+.0f} ms beyond rospy")
    print(f"bar for course_pkg: {IMPORTS_BAR:.0f} ms")


# cpp: prints the duration of the builds of chapter 13 in a new workspace, and of the compilation of one file.
# The benchmark uses the files and the commands in the cells of the solution.

SOLUTION = next((Path(__file__).parents[2] / "solutions").glob("13_*.ipynb"))
CPP_BAR = 15.0  # s
WRITING = re.compile(r"%%writefile (?P<more>-a )?(?P<path>src/cpp_services/\S+)\n(?P<text>.*)", re.DOTALL)


def cpp_main() -> int:
    """Measure each run in a new workspace, and print the medians."""
    runs = int(sys.argv[1]) if sys.argv[1:] else 3
    print(f"{os.cpu_count()} cores; load {os.getloadavg()[0]:.1f} before the start")
    rounds = [cpp_measure() for _ in range(runs)]
    for seconds, alone in rounds:
        steps = " + ".join(f"{step:.1f}" for step in seconds)
        print(f"builds {steps} = {sum(seconds):.1f} s; the compiler alone, one file: {alone:.1f} s")
    median = statistics.median(sum(seconds) for seconds, _ in rounds)
    files = statistics.median(sum(seconds) / alone for seconds, alone in rounds)
    print(f"median {median:.1f} s, as long as {files:.1f} files one by one")
    print(f"bar {CPP_BAR:.0f} s: {'met' if median <= CPP_BAR else 'MISSED'}")
    return 0


def cpp_measure() -> tuple[list[float], float]:
    """Return the duration of each build, and of the compilation of one file, in s."""
    with tempfile.TemporaryDirectory(prefix="course-cpp-") as folder:
        seconds = list(built(Path(folder)))
        from course_pkg.workspace.cpp_support import (
            compile_command,
        )  # This import is inside the function because `fresh` runs without the course's libraries.

        source = f"{folder}/src/cpp_services/src/geometry_server.cpp"
        return seconds, timed(compile_command(source, f"{folder}/alone"), folder)


def built(folder: Path) -> Iterator[float]:
    """Write the files and run the commands of the cells; yield the duration of each build in s."""
    from course_pkg.authoring.cells import code_cells
    from course_pkg.authoring.notebook_store import read

    for cell in code_cells(read(SOLUTION)):
        if found := WRITING.match(cell["source"]):
            path = folder / found["path"]
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("a" if found["more"] else "w") as file:
                file.write(found["text"] + "\n")
        for line in re.findall(r"^!(sed .*|catkin_make [^>;]*)", cell["source"], re.MULTILINE):
            spent = timed(["bash", "-c", line], str(folder))
            if line.startswith("catkin_make"):
                yield spent


def timed(command: list[str], folder: str) -> float:
    """Run a command, and return its duration in s. Exit if the command fails."""
    started = time.perf_counter()
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, "PWD": folder}, capture_output=True, text=True, check=False
    )
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return time.perf_counter() - started


if __name__ == "__main__":
    run_command({"fresh": fresh_main, "imports": imports_main, "cpp": cpp_main})
