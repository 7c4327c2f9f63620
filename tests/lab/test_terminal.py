"""Tests of commands in JupyterLab's terminals."""

from __future__ import annotations

import os
import re
import signal
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import parse_qs, urlsplit
from urllib.request import Request, urlopen

import pexpect
import psutil
import pytest

from course_pkg.ros.process.supervisor import descendants
from tests.lab.commands import ROOT, all_gone, below, having, lab, listening, network_of
from tests.support import eventually
from tests.workspace.packages import GOOD, write

pytestmark = pytest.mark.timeout(600)

PROMPT = "(lab) "
SCRIPT = (
    "#!/usr/bin/env python3\nimport my_services.srv\nprint('area:', my_services.srv.BoxResponse(3).area)\n"
)
INSTALLED = "catkin_install_python(PROGRAMS scripts/area DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
TAB = "\t"
BUSY = 240.0  # maximum time in s for commands that take 3 s on an idle machine, such as catkin_make


class Terminal:
    """A terminal with the same command, environment and folder as a terminal of JupyterLab."""

    def __init__(self, pid: int) -> None:
        model = psutil.Process(pid)
        program, *arguments = model.cmdline()
        self.environment = model.environ()
        inside = [*network_of(pid), program, *arguments]
        self._shell = pexpect.spawn(
            inside[0], inside[1:], env=self.environment, cwd=model.cwd(), timeout=BUSY, encoding="utf-8"
        )
        self._shell.setecho(False)
        self.type(f"PS1='{PROMPT}'; bind 'set enable-bracketed-paste off'; PROMPT_COMMAND=")
        self.run("stty -echo")

    def type(self, line: str) -> None:
        """Type a line, and press Enter."""
        self._shell.sendline(line)

    def keys(self, text: str) -> None:
        """Type a text, and do not press Enter."""
        self._shell.send(text)

    def wait_for(self, text: str) -> str:
        """Wait until the terminal prints the given text, and return the output before this text."""
        self._shell.expect_exact(text)
        return str(self._shell.before)

    def run(self, line: str) -> str:
        """Run a command, and return its output without control codes."""
        self.type(f"{line}; echo en''d")
        printed = self.wait_for("end\r\n").replace(PROMPT, "")
        return re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", printed)

    def close(self) -> None:
        """Stop the shell and its processes."""
        self._shell.close(force=True)


@pytest.fixture(scope="module")
def terminal(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Terminal]:
    """Start `course lab` with a temporary workspace, and yield a terminal."""
    state = tmp_path_factory.mktemp("state")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(state)  # The test starts `course lab` in a folder that is not the checkout.
        with lab(COURSE_STATE=str(state)) as (process, address):
            parts = urlsplit(address)
            headers = {"Authorization": f"token {parse_qs(parts.query)['token'][0]}"}
            request = Request(f"http://{parts.netloc}/api/terminals", data=b"", headers=headers)
            urlopen(request, timeout=20).close()  # noqa: S310
            shells = eventually(lambda: having(b"bash\0--rcfile\0", below(process)))
            # While a shell starts, its child processes have the same command line, but higher process ids.
            terminal = Terminal(min(shells))
            rosout = eventually(lambda: having(b"rosout/rosout\0", below(process)))
            assert rosout  # If a test starts another node /rosout, the master's own /rosout exits.
            try:
                yield terminal
            finally:
                terminal.close()
                family = below(process)
                process.kill()
                assert all_gone([*rosout, *family])


def test_a_terminal_starts_where_the_chapters_and_the_workspace_are(terminal: Terminal) -> None:
    """A terminal starts in the folder that contains `notebooks`."""
    assert Path(terminal.run("pwd").strip()) == ROOT


def test_the_graph_is_the_same_as_with_roscore(terminal: Terminal) -> None:
    """The nodes, services and parameters are the same as those of the command `roscore`."""
    assert terminal.run("rosnode list").split() == ["/rosout"]
    assert terminal.run("rosservice list").split() == ["/rosout/get_loggers", "/rosout/set_logger_level"]
    assert terminal.run("rosparam list").split() == ["/rosdistro", "/rosversion", "/run_id"]
    assert terminal.run("rosversion roslaunch").strip() in terminal.run("rosparam get /rosversion")


def test_roscore_says_that_a_master_runs(terminal: Terminal) -> None:
    """The command roscore refuses to start while a master runs."""
    printed = terminal.run("roscore")
    assert "roscore cannot run as another roscore/master is already running" in printed
    assert terminal.environment["ROS_MASTER_URI"] in printed


def test_a_node_in_cpp_listens_on_this_computer_only(terminal: Terminal) -> None:
    """A C++ node in the terminal listens only on 127.0.0.1."""
    node = re.findall(
        r"\d+$", terminal.run("rosrun rosout rosout __name:=of_mine > /dev/null & echo $!").strip()
    )
    assert eventually(lambda: "/of_mine" in terminal.run("rosnode list"), timeout=BUSY)
    addresses = listening([int(node[0]), *descendants(int(node[0]))])
    terminal.run("kill %1; wait")
    assert {host for host, _ in addresses} == {"127.0.0.1"}


def test_a_package_is_built_sourced_and_run(terminal: Terminal) -> None:
    """A student can use catkin_make, devel/setup.bash, rossrv, roscd and rosrun."""
    root = Path(terminal.environment["COURSE_STATE"], "workspace")
    assert (root / "src").is_dir()
    lists = GOOD["CMakeLists.txt"] + INSTALLED
    write(root, {**GOOD, "CMakeLists.txt": lists, "scripts/area": SCRIPT})
    terminal.run(f"cd {root}")
    assert "not found" in terminal.run("rospack find my_services")
    assert "[100%]" in terminal.run("catkin_make")
    assert "not found" in terminal.run("rospack find my_services")
    terminal.run("source devel/setup.bash")
    assert "float32 area" in terminal.run("rossrv show my_services/Box")
    assert terminal.run("rosrun my_services area").strip() == "area: 3"
    assert terminal.run("roscd my_services && pwd").strip() == str(root / "src" / "my_services")
    assert terminal.run("rosrun course_pkg client 1 2 3 4").startswith("usage")
    terminal.keys(f"rosrun my_ser{TAB}ar{TAB}; echo en''d\n")
    assert "area: 3" in terminal.wait_for("end\r\n")


def test_roscore_starts_a_new_master_after_the_lab_master_has_ended(terminal: Terminal) -> None:
    """If the master of the lab is killed, roscore starts a new master and /rosout at the same address."""
    master = "python3 -c 'from course_pkg.ros import *; print(MasterClient(master_uri()).pid())'"
    former = int(terminal.run(master))
    os.kill(former, signal.SIGKILL)
    assert all_gone([former])
    terminal.type("roscore")
    terminal.wait_for("started core service [/rosout]")
    terminal.keys("\x1a")  # Ctrl-Z suspends the job, so that the terminal accepts other commands.
    terminal.wait_for("Stopped")
    terminal.run("bg")
    assert int(terminal.run(master)) != former
    assert "/rosout" in terminal.run("rosnode list")
    terminal.run("kill -INT %1; wait")
