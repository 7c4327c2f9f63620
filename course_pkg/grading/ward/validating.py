"""nbval behind the outer wall: pytest, a master and a judge are trusted, and the kernel has walls of its own.

Reads a notebook from stdin, takes the time (s) of a cell as its argument, and writes the outcome of each cell
to stdout, a JSON object a line.
"""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

from course_pkg.authoring.cells import check_of
from course_pkg.authoring.validate import SANITIZE
from course_pkg.examiner import checks
from course_pkg.grading import namespaces
from course_pkg.grading.nbval_plugin import RECORD
from course_pkg.grading.ward import confinement
from course_pkg.grading.ward.leader import LOOK, USUAL_PORT, be_master, memory_below
from course_pkg.grading.ward.wire import end, fork
from course_pkg.graph.leashed import descendants

TOGETHER = 2 * confinement.TOGETHER  # bytes: pytest and a whole chapter's nodes
KERNEL = "walled"
OWN = "/student/.course"
ORPHANED = ("--unsetenv", "JPY_PARENT_PID")  # a kernel below process 1 takes itself for an orphan


def main() -> None:
    """Run the notebook of stdin."""
    with tempfile.TemporaryDirectory(prefix="course-nbval-") as folder:
        notebook = json.load(sys.stdin)
        for cell in notebook["cells"]:
            _leave_out_results(cell)
        path = Path(folder, "notebook.ipynb")
        path.write_text(json.dumps(notebook), "utf-8")
        record = Path(folder, "record")
        record.touch()
        with socket.create_server(("127.0.0.1", 0)) as desk:
            _surroundings(Path(folder), record, desk.getsockname()[1])
            helpers = [fork(lambda: be_master(USUAL_PORT)), fork(lambda: _be_judges(desk))]
        try:
            _watched(_command(path, sys.argv[1]))
        finally:
            end(helpers)
        sys.stdout.write(record.read_text("utf-8"))


def _watched(command: list[str]) -> None:
    """Run `command`, and end it, and all below it, if it takes too much memory."""
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None:
            if memory_below(process.pid) > TOGETHER:
                end([*descendants(process.pid), process.pid])
            with suppress(subprocess.TimeoutExpired):
                process.wait(LOOK)


def _leave_out_results(cell: dict[str, Any]) -> None:
    """Take the summary of a chapter out: it is made of records, which no submission sees."""
    if cell["cell_type"] == "code" and "results(" in cell["source"] and not check_of(cell):
        cell["source"] = ""
        cell["outputs"] = []


def _surroundings(folder: Path, record: Path, port: int) -> None:
    os.environ.update(
        {
            RECORD: str(record),
            "JUPYTER_PATH": str(folder / "jupyter"),
            "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
            "HOME": str(folder),
            "COURSE_STATE": str(folder / "state"),
            "COURSE_EXAMINER": f"127.0.0.1:{port}",
            "ROS_MASTER_URI": f"http://localhost:{USUAL_PORT}",
            "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        }
    )
    spec = folder / "jupyter" / "kernels" / KERNEL / "kernel.json"
    spec.parent.mkdir(parents=True)
    filter_file = folder / "calls.bpf"
    confinement.write_filter(filter_file)
    spec.write_text(
        json.dumps(
            {
                "argv": _kernel_command(filter_file),
                "display_name": KERNEL,
                "language": "python",
                "interrupt_mode": "message",
            }
        )
    )


def _kernel_command(filter_file: Path) -> list[str]:
    """Return the command of a kernel with nothing: no reference, no checks, nobody's processes."""
    size, rooms = str(confinement.DISK), (*confinement.ROOMS, "/student")
    room = [word for each in rooms for word in ("--size", size, "--tmpfs", each)]
    shown = [word for each in confinement.staged_paths() for word in ("--ro-bind", each, each)]
    covered = [word for each in checks.__path__ for word in ("--tmpfs", each, "--remount-ro", each)]
    limits = [
        f"--as={confinement.MEMORY}",
        f"--nproc={confinement.PROCESSES}",
        f"--fsize={confinement.FILE}",
        "--core=0",
    ]
    alone = ["--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"]
    command = [
        *("bwrap", *alone, "--disable-userns", "--die-with-parent", "--new-session", "--cap-drop", "ALL"),
        *("--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev", "--remount-ro", "/dev"),
        *(*room, *shown, *covered),
        *("--ro-bind", "{connection_file}", "{connection_file}", "--setenv", "HOME", "/student"),
        *("--setenv", "COURSE_STATE", OWN, "--setenv", "ROS_HOME", OWN, "--setenv", "ROS_LOG_DIR", OWN),
        *("--unsetenv", RECORD, *ORPHANED, "--chdir", "/student"),
        *("--seccomp", "9", "--", "prlimit", *limits, "--"),
        *(sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"),
    ]
    return ["sh", "-c", 'exec 9<"$0"; exec "$@"', str(filter_file), *command]


def _command(notebook: Path, cell: str) -> list[str]:
    plugins = ("nbval.plugin", "course_pkg.grading.nbval_plugin", "no:cacheprovider")
    return [
        *(sys.executable, "-m", "pytest", "-q", "--nbval", "--noconftest", "-c", os.devnull),
        *(word for plugin in plugins for word in ("-p", plugin)),
        *("--rootdir", str(notebook.parent), "--nbval-kernel-name", KERNEL),
        *("--nbval-cell-timeout", cell, "--nbval-sanitize-with", str(SANITIZE), str(notebook)),
    ]


def _be_judges(desk: socket.socket) -> None:
    """Fork a judge for each check that the notebook asks for."""
    from course_pkg.examiner.parts import every_part

    list(every_part())
    while True:
        sock, _ = desk.accept()
        fork(lambda: _judge(sock))  # noqa: B023 -- used in the fork alone
        sock.close()
        with suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass


def _judge(sock: socket.socket) -> None:
    from course_pkg.examiner.judge import judge
    from course_pkg.examiner.link import Link

    namespaces.limit(AS=confinement.JUDGE)  # a submission decides how much it sends to its judge
    with tempfile.TemporaryDirectory() as folder:
        judge(Link(sock), Path(folder))


if __name__ == "__main__":
    main()
