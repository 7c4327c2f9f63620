"""JupyterHub's spawner for the course: a student's server has limits, and ends with the hub."""

from __future__ import annotations

import os
import pwd
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

from jupyterhub.spawner import LocalProcessSpawner
from traitlets import Integer, Unicode

from course_pkg.errors import HubError
from course_pkg.hub import limits
from course_pkg.hub.accounts import home_problem
from course_pkg.ros.process.supervised import PROGRAM

# A server starts only if the disk of the home folder has at least this number of free bytes.
LEAST_SPACE = 50 << 20


class CourseSpawner(LocalProcessSpawner):  # type: ignore[misc]  # The base class has no types.
    """Starts `single_user.py` as the student. A supervisor ends this program after the end of the hub."""

    homes = Unicode(help="the folder of the home folders if the students have no accounts").tag(config=True)
    memory = Integer(1024, help="MiB for each student").tag(config=True)
    processes = Integer(500, help="processes and threads for each student").tag(config=True)
    _group: Path | None = None

    def _cmd_default(self) -> list[str]:
        # The supervisor writes a process id to file descriptor 3, but the spawner does not need this id.
        supervisor = [sys.executable, "-I", "-S", str(PROGRAM), str(os.getpid()), "3", "", "", "", "", ""]
        shell = ["/bin/sh", "-c", 'exec "$0" "$@" 3>/dev/null']
        return [*shell, *supervisor, sys.executable, "-m", "course_pkg.hub.single_user"]

    @property
    def home(self) -> Path:
        """The student's home folder."""
        name = self.user.name
        return Path(self.homes, name) if self.homes else Path(pwd.getpwnam(name).pw_dir)

    def user_env(self, env: dict[str, str]) -> dict[str, str]:
        """Return the dict `env` with the variables that a login sets."""
        return {**env, "USER": self.user.name, "HOME": str(self.home), "SHELL": "/bin/bash"}

    async def start(self) -> object:
        """Start the server.

        Raises HubError if the server cannot use the home folder or its limits. The student's page shows the
        message.
        """
        try:
            self._refuse()
            hub = limits.group_of_hub()
            self._group = limits.make_group(hub, self.user.name, self._limits()) if hub else None
        except (HubError, OSError, KeyError) as error:
            failure = HubError(f"Your server did not start: {error}")
            failure.jupyterhub_message = str(failure)  # type: ignore[attr-defined]  # JupyterHub shows it
            raise failure from error
        return await super().start()

    async def stop(self, now: bool = False) -> None:
        """End the server, and all processes that the student has started in it."""
        await super().stop(now=now)
        if self._group:
            limits.end_group(self._group)

    def make_preexec_fn(self, name: str) -> Callable[[], None]:
        """Return a function that sets the limits of the new process and changes to the student's account."""
        become = _work_in(self.home) if self.homes else super().make_preexec_fn(name)
        group, chosen, own_account = self._group, self._limits(), not self.homes

        def prepare() -> None:
            if group:
                limits.enter_group(group)
            else:
                limits.set_rlimits(chosen, own_account)
            become()

        return prepare

    def _limits(self) -> limits.Limits:
        return limits.Limits(self.memory, self.processes)

    def _refuse(self) -> None:
        if self.homes:
            self.home.mkdir(parents=True, exist_ok=True, mode=0o700)
        elif problem := home_problem(self.home, pwd.getpwnam(self.user.name).pw_uid):
            raise HubError(problem)
        if shutil.disk_usage(self.home).free < LEAST_SPACE:
            raise HubError(
                f"the disk of {self.home} is full: less than {LEAST_SPACE >> 20} MiB are free. "
                "Delete files, or ask your teacher."
            )


def _work_in(folder: Path) -> Callable[[], None]:
    return lambda: os.chdir(folder)
