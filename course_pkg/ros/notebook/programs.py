"""`%rosrun` and `%roslaunch`: start programs from a cell, with the same commands as in a terminal."""

from __future__ import annotations

import difflib
import shlex
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from course_pkg.errors import UnknownExecutable
from course_pkg.ros.notebook.cells import Cells
from course_pkg.ros.process.executables import package_folder
from course_pkg.ros.process.node_process import NodeProcess

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

ROSRUN = "usage: %rosrun PACKAGE PROGRAM [ARGUMENTS]"
ROSLAUNCH = "usage: %roslaunch PACKAGE FILE [NAME:=VALUE ...], or %roslaunch PATH [NAME:=VALUE ...]"
SUFFIX = ".launch"
CORE = "--core"  # With this option, roslaunch starts only a master, as roscore does.

Keep = Callable[[NodeProcess], None]


class Program:
    """A program in the background. It ends with the kernel, or when the cell that started it runs again."""

    def __init__(self, words: str, process: NodeProcess) -> None:
        self._words = words
        self._process = process

    @property
    def output(self) -> str:
        """The program's output so far, from stdout and stderr."""
        return self._process.output()

    @property
    def running(self) -> bool:
        """Whether the program is running."""
        return self._process.running

    @property
    def status(self) -> int | None:
        """The exit status (negative if a signal ended the program), or None while the program is running."""
        return self._process.returncode

    def wait(self, timeout: float = 30.0, *, line: str = "", service: str = "") -> int | None:
        """Wait for the text `line` in the output, for the service `service`, or for both.

        Without `line` and `service`, wait until the program ends.

        Returns the exit status, or None while the program is running. Raises NodeFailed after `timeout` s.
        Also raises it if the program ends before it prints the line or offers the service. The error message
        contains the last output.
        """
        if line:
            self._process.wait_for_output(line, timeout)
        if service:
            self._process.wait_for_service(service, timeout)
        if not line and not service:
            self._process.wait(timeout)
        return self.status

    def stop(self) -> None:
        """End the program with SIGINT (Ctrl-C), or with SIGKILL if needed; a second call has no effect."""
        self._process.stop()

    def __repr__(self) -> str:
        state = "running" if self.running else f"ended with exit status {self.status}"
        return f"<{self._words}: {state}>"


class ProgramMagics:
    """Adds %rosrun and %roslaunch to IPython; both call the function `keep` with each new process."""

    def __init__(self, shell: InteractiveShell, cells: Cells, keep: Keep) -> None:
        self._cells = cells
        self._keep = keep
        shell.magics_manager.register_function(self._rosrun, "line", "rosrun")
        shell.magics_manager.register_function(self._roslaunch, "line", "roslaunch")

    def _rosrun(self, line: str) -> Program:
        """Start a program of a package, as rosrun does in a terminal, and return its Program object."""
        words = _words(line)
        if len(words) < 2:
            raise _usage(ROSRUN)
        return self._started("rosrun", words, partial(NodeProcess.rosrun, *words))

    def _roslaunch(self, line: str) -> Program:
        """Start a launch file or a master, as roslaunch does in a terminal; return its Program object."""
        words = _words(line)
        if CORE not in words:
            _require_launchable(words)
        return self._started("roslaunch", words, partial(NodeProcess, ["roslaunch", *words]))

    def _started(self, command: str, words: list[str], start: Callable[[], NodeProcess]) -> Program:
        process = start()
        self._keep(process)
        program = Program(shlex.join([command, *words]), process)
        self._cells.created(program, program.stop)
        return program


def _words(line: str) -> list[str]:
    """Return the words of a command line, without a final `&`.

    %rosrun and %roslaunch ignore `&`, because they always start a program in the background.
    """
    words = shlex.split(line)
    return words[:-1] if words[-1:] == ["&"] else words


def _usage(text: str) -> Exception:
    from IPython.core.error import UsageError

    return UsageError(text)


def _require_launchable(words: list[str]) -> None:
    """Raise UsageError or UnknownExecutable if there is no launch file for these arguments."""
    if not words or (len(words) < 2 and not words[0].endswith(SUFFIX)):
        raise _usage(ROSLAUNCH)
    if words[0].endswith(SUFFIX):
        _require_file(Path(words[0]))
    else:
        _require_launch_file(*words[:2])


def _require_file(path: Path) -> None:
    if not path.is_file():
        raise UnknownExecutable(f"There is no launch file {str(path)!r} in {Path.cwd()}.")


def _require_launch_file(package: str, name: str) -> None:
    """Raise UnknownExecutable if roslaunch would not find the file; the message suggests similar names."""
    folder = package_folder(package)
    places = [folder, folder / "launch"]
    if any((place / name).is_file() for place in places) or any(folder.rglob(name)):
        return
    others = sorted({path.name for place in places for path in place.glob(f"*{SUFFIX}")})
    alike = difflib.get_close_matches(name, others, n=1)
    hint = (
        f" Did you mean {alike[0]!r}?"
        if alike
        else f" The package has these launch files: {', '.join(others)}."
        if others
        else ""
    )
    raise UnknownExecutable(f"Package {package!r} has no launch file {name!r}.{hint}")
