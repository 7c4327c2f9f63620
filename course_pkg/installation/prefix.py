"""The folder of a shared installation: its versions, the current version, and the links on the PATH."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.files import write_atomically
from course_pkg.installed import RECORD

DEFAULT = Path("/opt/ros-services-course")
# This file marks a prefix that `course install` made, and stores the path of its `bin`.
OURS = ".course-installation.json"
COMPLETION = "completion.bash"


class Prefix:
    """The folder `path`, the link in `bin`, and the link in the folder of bash-completion.

    If `bin_folder` is None, `bin` is the folder that the last `course install` used. For a first
    installation, `bin` is /usr/local/bin (root) or ~/.local/bin (other users).
    """

    def __init__(self, path: Path | None, bin_folder: Path | None = None) -> None:
        self.path = _absolute(path or DEFAULT)
        self.versions, self.current = self.path / "versions", self.path / "current"
        recorded = self._recorded_bin()
        self.is_ours = recorded is not None
        usual = Path("/usr/local/bin" if os.geteuid() == 0 else "~/.local/bin")
        self.bin = _absolute(bin_folder or recorded or usual)
        shared = self.bin.parent / "share" / "bash-completion" / "completions"
        self._links = {
            self.bin / "course": self.current / "course" / "course",
            shared / "course": self.current / COMPLETION,
        }

    def claim(self) -> None:
        """Create the folder, and mark it as a shared installation.

        If the folder cannot be used, raise SetupError and change nothing.
        """
        if any(letter.isspace() for letter in str(self.path)):
            raise SetupError(
                f"catkin cannot build in {self.path}, because the name of this folder contains "
                "a space. Give --prefix a folder without spaces."
            )
        if (
            not self.is_ours
            and self.path.exists()
            and not (self.path.is_dir() and not any(self.path.iterdir()))
        ):
            raise SetupError(
                f"{self.path} exists, and `course install` did not make it, so nothing was changed. "
                "Give --prefix a new or an empty folder."
            )
        for link, target in self._links.items():
            if os.path.lexists(link) and not _leads_to(link, target):
                raise SetupError(
                    f"{link} exists, but does not belong to this installation, so nothing was "
                    "changed. Give another folder with --bin, or remove the file."
                )
        self.versions.mkdir(parents=True, exist_ok=True)
        write_atomically(self.path / OURS, json.dumps({"bin": str(self.bin)}))

    def complete(self) -> list[Path]:
        """Return the folders of all complete versions."""
        return sorted(path.parent for path in self.versions.glob(f"*/{RECORD}"))

    def switch(self, version: Path) -> None:
        """Make the version `version` the current version, and create missing links."""
        _link(self.current, version.relative_to(self.path))
        for link, target in self._links.items():
            link.parent.mkdir(parents=True, exist_ok=True)
            _link(link, target)

    def remove_unused(self, kept: set[Path]) -> list[Path]:
        """Remove all versions that no process uses, except the versions in `kept`.

        Return the versions that were not removed because a process still uses them.
        """
        others = [path for path in self.versions.iterdir() if path not in kept]
        busy = [path for path in others if any(users_of(path))]
        for path in set(others) - set(busy):
            # delete this file first; after an interrupted removal, the version then does not count as
            # complete
            (path / RECORD).unlink(missing_ok=True)
            shutil.rmtree(path)
        return busy

    def remove(self) -> None:
        """Remove the links and the installation; remove only files that `course install` has made."""
        for link, target in self._links.items():
            if _leads_to(link, target):
                link.unlink()
        self.current.unlink(missing_ok=True)
        shutil.rmtree(self.versions)
        for name in (OURS, "lock"):
            (self.path / name).unlink(missing_ok=True)
        if not any(self.path.iterdir()):
            self.path.rmdir()

    def _recorded_bin(self) -> Path | None:
        try:
            return Path(json.loads((self.path / OURS).read_text())["bin"])
        except (OSError, ValueError, KeyError, TypeError):
            return None


def users_of(folder: Path) -> Iterator[int]:
    """Yield the ids of the processes with the folder's path in their command line or environment.

    The environment of every program of the course contains the path of the folder. Only root can read the
    environments of other users' processes.
    """
    name = os.fsencode(folder) + b"/"
    for process in Path("/proc").glob("[0-9]*"):
        for file in ("cmdline", "environ"):
            try:
                found = name in (process / file).read_bytes()
            except OSError:  # the process has ended, or belongs to another user
                continue
            if found and int(process.name) not in (os.getpid(), os.getppid()):
                yield int(process.name)
                break


def _absolute(path: Path) -> Path:
    return Path(os.path.abspath(path.expanduser()))


def _leads_to(link: Path, target: Path) -> bool:
    return link.is_symlink() and Path(os.readlink(link)) == target


def _link(link: Path, target: Path) -> None:
    draft = link.with_name(f".{link.name}.{os.getpid()}")
    draft.unlink(missing_ok=True)
    draft.symlink_to(target)
    draft.replace(link)
