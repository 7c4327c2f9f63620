"""Tests of the magics %rosrun and %roslaunch."""

from __future__ import annotations

import os
import signal
import socket

import pytest

from course_pkg.ros import MasterClient, PrivateMaster
from tests.notebook_kernel import NotebookKernel, Shown
from tests.ros.notebook.conftest import SETUP
from tests.support import eventually, process_state


def value(notebook: NotebookKernel, code: str) -> str:
    """Return the repr of a cell's value."""
    shown = notebook.run(code)
    assert not shown.ename, shown.evalue
    return shown.results[-1]


def test_rosrun_returns_a_handle(notebook: NotebookKernel, master: PrivateMaster) -> None:
    """%rosrun returns an object that contains the program's output and can stop the program."""
    notebook.run("server = %rosrun course_pkg server", "rosrun")
    assert notebook.run("server.wait(service='/getGeometry')") == Shown()
    assert value(notebook, "server") == "<rosrun course_pkg server: running>"
    assert "measure boxes" in value(notebook, "server.wait(line='Ready'); server.output")
    assert value(notebook, "server.stop(); server") == "<rosrun course_pkg server: ended with exit status 0>"
    assert "/getGeometry" not in MasterClient(master.uri).system_state().services


def test_program_that_ends_by_itself(notebook: NotebookKernel) -> None:
    """%rosrun passes arguments to the program, and wait() returns the exit status."""
    shown = notebook.run("client = %rosrun course_pkg client 1 2 'not a number'\nclient.wait()")
    assert shown.results == ["2"], shown
    assert value(notebook, "client").endswith("'not a number': ended with exit status 2>")
    assert "usage: client" in value(notebook, "client.output")


def test_cell_that_runs_again_starts_the_program_again(notebook: NotebookKernel) -> None:
    """When the cell runs again, the program of the previous run is stopped."""
    cell = "%rosrun course_pkg server __name:=again &"
    assert notebook.run(cell, "again").results == ["<rosrun course_pkg server __name:=again: running>"]
    notebook.run("first = _\nfirst.wait(service='/getGeometry')")
    notebook.run(cell, "again")
    assert value(notebook, "first.running") == "False"
    notebook.run("pass", "again")


def test_roslaunch(notebook: NotebookKernel, master: PrivateMaster) -> None:
    """%roslaunch starts a launch file, and stop() ends its nodes."""
    notebook.run("launched = %roslaunch course_pkg geometry.launch")
    assert notebook.run("launched.wait(service='/getGeometry')") == Shown()
    assert value(notebook, "launched.stop(); launched.running") == "False"
    eventually(lambda: "/getGeometry" not in MasterClient(master.uri).system_state().services)


def test_roslaunch_starts_a_master(notebook: NotebookKernel) -> None:
    """`--core` starts a master on the given port, and stop() ends the master."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    notebook.run(f"core = %roslaunch --core -p {port}")
    assert notebook.run("core.wait(line='started core service')") == Shown()
    eventually(lambda: "/rosout" in MasterClient(f"http://localhost:{port}").system_state().nodes)
    assert value(notebook, "core.stop(); core.running") == "False"


@pytest.mark.parametrize(
    ("line", "error", "words"),
    [
        ("%rosrun course_pgk server", "UnknownExecutable", "There is no package 'course_pgk'"),
        ("%rosrun course_pkg servr", "UnknownExecutable", "Did you mean 'server'?"),
        ("%roslaunch course_pgk geometry.launch", "UnknownExecutable", "There is no package 'course_pgk'"),
        ("%roslaunch course_pkg geometri.launch", "UnknownExecutable", "Did you mean 'geometry.launch'?"),
        ("%roslaunch missing.launch", "UnknownExecutable", "There is no launch file 'missing.launch'"),
    ],
)
def test_unknown_name(notebook: NotebookKernel, line: str, error: str, words: str) -> None:
    """If a name is misspelt, the cell shows one error message."""
    shown = notebook.run(line)
    assert shown.ename == error
    assert words in shown.evalue
    assert shown.error_lines[:3] == [
        "Traceback (most recent call last; %tb shows all of it):",
        shown.error_lines[1],
        f"    {line}",
    ]
    assert len(shown.error_lines) == 4


@pytest.mark.parametrize("line", ["%rosrun course_pkg", "%roslaunch", "%roslaunch course_pkg"])
def test_usage(notebook: NotebookKernel, line: str) -> None:
    """If an argument is missing, the cell shows the usage."""
    assert notebook.run(line).err.startswith(f"UsageError: usage: {line.split()[0]} PACKAGE")


def test_a_killed_kernel_leaves_no_program(master: PrivateMaster) -> None:
    """After SIGKILL of the kernel, its program exits and is unregistered."""
    with NotebookKernel() as kernel:
        kernel.run(SETUP.replace("student", "killed"))
        kernel.run("server = %rosrun course_pkg server\nserver.wait(service='/getGeometry')")
        pids = kernel.run("import os\n(os.getpid(), server._process.pid)").results[0]
        pid, program = (int(number) for number in pids.strip("()").split(","))
        os.kill(pid, signal.SIGKILL)
        eventually(lambda: process_state(program) == "Z")
        eventually(lambda: "/getGeometry" not in MasterClient(master.uri).system_state().services)
