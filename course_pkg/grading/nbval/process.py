"""Runs nbval in an outer sandbox with trusted processes; the kernel runs in an inner sandbox.

The trusted processes are pytest, the master and the check runner. The program reads a notebook from stdin.
The program's argument is the time limit of a cell in s. The program writes the result of each cell to stdout,
as one JSON object per line.
"""

from __future__ import annotations

import json
import os
import re
import socket
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from course_pkg.authoring.cells import Cell, Notebook, check_of, code_cells
from course_pkg.authoring.validate import SANITIZE
from course_pkg.checking.parts import secret_paths
from course_pkg.grading.nbval.plugin import RECORD
from course_pkg.sandbox.channel import descendants, end, fork
from course_pkg.sandbox.linux import confinement, namespaces
from course_pkg.sandbox.supervisor import MASTER_PORT, MEMORY_INTERVAL, run_master, too_much_memory_below
from course_pkg.waiting import Deadline, at_this_load

# If a cell runs too long, nbval ends the kernel within `SILENCE` s.
SILENCE = 15.0
# TOGETHER is the limit in bytes for the total memory of pytest and all nodes of a chapter.
TOGETHER = 2 * confinement.TOGETHER
KERNEL = "sandboxed"
# In the first edition, the function `progress` had the name `results`.
OVERVIEW = re.compile(r"\b(progress|results)\(")
OWN = "/student/.course"
# The folders `notebooks` and `workspace` have the same parent folder, as in a checkout.
NOTEBOOKS, WORKSPACE = "/student/notebooks", "/student/workspace"
# A kernel with the environment variable JPY_PARENT_PID ends if the id of its parent process is 1. In the
# sandbox, this id is always 1.
ORPHANED = ("--unsetenv", "JPY_PARENT_PID")


def main() -> None:
    """Run the notebook that stdin contains."""
    with tempfile.TemporaryDirectory(prefix="course-nbval-") as folder:
        notebook = json.load(sys.stdin)
        for cell in notebook["cells"]:
            _remove_overview(cell)
        path = Path(folder, "notebook.ipynb")
        path.write_text(json.dumps(notebook), "utf-8")
        record = Path(folder, "record")
        record.touch()
        with socket.create_server(("127.0.0.1", 0)) as listener:
            _set_environment(Path(folder), record, listener.getsockname()[1])
            helpers = [fork(lambda: run_master(MASTER_PORT)), fork(lambda: _run_checks(listener))]
        cell = at_this_load(float(sys.argv[1]))
        try:
            silent = _run_within_limits(_command(path, cell), record, cell + SILENCE)
        finally:
            end(helpers)
        sys.stdout.write(record.read_text("utf-8"))
        if silent:
            sys.stdout.write(_unfinished(notebook, record, cell))


def _run_within_limits(command: list[str], record: Path, silence: float) -> bool:
    """Run the command `command` with limits for its memory and its progress.

    Kill the processes of the command if they use too much memory. Also kill them if the file `record` does
    not grow for the time `silence` (s).

    Returns True if the processes were killed because the file did not grow. If the connections of a kernel
    are damaged, nbval would wait for ever without the limit `silence`.
    """
    size, deadline = 0, Deadline(silence)
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None:
            if record.stat().st_size > size:
                size, deadline = record.stat().st_size, Deadline(silence)
            if too_much_memory_below(process.pid, TOGETHER) or deadline.passed:
                end([*descendants(process.pid), process.pid])
            with suppress(subprocess.TimeoutExpired):
                process.wait(MEMORY_INTERVAL)
    return deadline.passed


def _unfinished(notebook: Notebook, record: Path, cell: float) -> str:
    """Return a line of JSON that reports the first cell without a result as failed.

    Return "" if all cells have a result.
    """
    recorded = {json.loads(line)["cell"] for line in record.read_text("utf-8").splitlines()}
    left = (each["id"] for each in code_cells(notebook) if each["source"] and each["id"] not in recorded)
    if not (first := next(left, "")):
        return ""
    words = (
        f"The cell gave no result within {cell:.0f} s. So this cell and all cells after it have no result."
    )
    return json.dumps({"cell": first, "outcome": "failed", "words": words}) + "\n"


def _remove_overview(cell: Cell) -> None:
    """Empty the cells that show the student's progress, because a graded run has no progress record."""
    if cell["cell_type"] == "code" and OVERVIEW.search(cell["source"]) and not check_of(cell):
        cell["source"] = ""
        cell["outputs"] = []


def _set_environment(folder: Path, record: Path, port: int) -> None:
    os.environ.update(
        {
            RECORD: str(record),
            "JUPYTER_PATH": str(folder / "jupyter"),
            "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
            "HOME": str(folder),
            "COURSE_STATE": str(folder / "state"),
            "COURSE_CHECK_RUNNER": f"127.0.0.1:{port}",
            "ROS_MASTER_URI": f"http://localhost:{MASTER_PORT}",
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
    """Return the command of a kernel that cannot read the solutions, the checks, or other processes."""
    size, folders = str(confinement.DISK), (*confinement.MEMORY_FOLDERS, "/student")
    memory = [option for each in folders for option in ("--size", size, "--tmpfs", each)]
    shown = [option for each in confinement.shadowed_paths() for option in ("--ro-bind", each, each)]
    covered = [option for path in secret_paths() for option in _cover(path)]
    limits = [
        f"--as={confinement.MEMORY}",
        f"--nproc={confinement.PROCESSES}",
        f"--fsize={confinement.FILE}",
        "--core=0",
    ]
    unshared = ["--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"]
    command = [
        *("bwrap", *unshared, "--disable-userns", "--die-with-parent", "--new-session", "--cap-drop", "ALL"),
        *("--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev", "--remount-ro", "/dev"),
        *(*memory, *shown, *covered),
        *("--ro-bind", "{connection_file}", "{connection_file}", "--setenv", "HOME", "/student"),
        *("--setenv", "COURSE_STATE", OWN, "--setenv", "ROS_HOME", OWN, "--setenv", "ROS_LOG_DIR", OWN),
        *("--setenv", "COURSE_WORKSPACE", WORKSPACE, "--unsetenv", RECORD, *ORPHANED),
        *("--dir", NOTEBOOKS, "--chdir", NOTEBOOKS),
        *("--seccomp", "9", "--", "prlimit", *limits, "--"),
        *(sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"),
    ]
    return ["sh", "-c", 'exec 9<"$0"; exec "$@"', str(filter_file), *command]


def _cover(path: Path) -> list[str]:
    where = str(path)
    return ["--tmpfs", where, "--remount-ro", where] if path.is_dir() else ["--ro-bind", "/dev/null", where]


def _command(notebook: Path, cell: float) -> list[str]:
    ours = ("course_pkg.authoring.nbval_figures", "course_pkg.grading.nbval.plugin")
    plugins = ("nbval.plugin", *ours, "no:cacheprovider")
    return [
        *(sys.executable, "-m", "pytest", "-q", "--nbval", "--noconftest", "-c", os.devnull),
        *(option for plugin in plugins for option in ("-p", plugin)),
        *("--rootdir", str(notebook.parent), "--nbval-kernel-name", KERNEL),
        *("--nbval-cell-timeout", f"{cell:.0f}", "--nbval-sanitize-with", str(SANITIZE), str(notebook)),
    ]


def _run_checks(listener: socket.socket) -> None:
    """Fork a check runner for each check that the notebook requests."""
    from course_pkg.checking.parts import every_part

    list(every_part())
    while True:
        sock, _ = listener.accept()
        fork(lambda: _run_check(sock))  # noqa: B023 -- the fork runs it now
        sock.close()
        with suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass


def _run_check(sock: socket.socket) -> None:
    from course_pkg.checking.channel import Channel
    from course_pkg.checking.processes.runner import run_check

    # The memory is limited because student code can send any number of bytes to the check.
    namespaces.limit(AS=confinement.CHECK_RUNNER)
    run_check(Channel(sock))


if __name__ == "__main__":
    main()
