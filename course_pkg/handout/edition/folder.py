"""The folder of an edition. The folder is a git repository, and each release with a change is a commit."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import HandoutError
from course_pkg.files import write_atomically
from course_pkg.handout.edition.contents import File
from course_pkg.handout.edition.git import git, git_value
from course_pkg.setup.edition import RECORD

BRANCH = "main"  # A new repository has this branch; the branch of an existing repository does not change.
SHOWN = 5  # A message lists at most this many names.


@dataclass(frozen=True)
class Release:
    """The short name of the new commit, or "" if nothing changed; and the number of changed files."""

    commit: str
    changed: int  # This is the number of changed files.


class ReleaseFolder:
    """A folder that only `course release` writes."""

    def __init__(self, path: Path) -> None:
        """Read the list of files from an earlier release.

        Raises HandoutError if the folder contains files, but no list of the files of an earlier release.
        """
        self.path = path
        self._before = self._released_before()

    @property
    def branch(self) -> str:
        """The current branch of the repository."""
        return git_value(self.path, "symbolic-ref", "--short", "HEAD") or BRANCH

    @property
    def remote(self) -> str:
        """The address of the repository's remote `origin`, or ""."""
        return git_value(self.path, "remote", "get-url", "origin") if (self.path / ".git").exists() else ""

    def write(self, files: Mapping[str, File], message: str) -> Release:
        """Write the given files, remove all other files of an earlier release, and commit the changes.

        Raises HandoutError if a file with uncommitted changes would be overwritten, or if the folder cannot
        be written. In the first case, nothing is changed.
        """
        self._refuse_changes_by_hand(files)
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            # The list of files is written first; a user can then repeat an interrupted release.
            self._put(RECORD, files[RECORD])
            changed = [name for name, file in files.items() if self._put(name, file)]
            removed = [name for name in self._before if name not in files and self._remove(name)]
        except OSError as error:
            raise HandoutError(
                f"{error.filename or self.path} cannot be written ({error.strerror}). Correct this "
                "problem, and type the command again."
            ) from error
        return Release(self._commit([*files, *self._before], message), len({*changed, *removed}))

    def _released_before(self) -> list[str]:
        try:
            record = json.loads((self.path / RECORD).read_text("utf-8"))
            return [name for name in record["files"] if _stays_inside(name)]
        except (OSError, ValueError, KeyError, TypeError) as error:
            if self.path.exists() and not (self.path.is_dir() and not any(self.path.iterdir())):
                raise HandoutError(
                    f"Nothing was written, because {self.path} exists and `course release` did not "
                    "create it. Give a new or an empty folder."
                ) from error
            return []

    def _refuse_changes_by_hand(self, files: Mapping[str, File]) -> None:
        if not (self.path / ".git").exists() or not git_value(
            self.path, "rev-parse", "-q", "--verify", "HEAD"
        ):
            return
        listed = git(self.path, "status", "--porcelain", "-z", "--no-renames", "--untracked-files=no")
        touched = [entry[3:] for entry in listed.split("\0") if entry]
        lost = [
            name for name in touched if name in {*files, *self._before} and self._would_change(name, files)
        ]
        if lost:
            more = f" and {len(lost) - SHOWN} more" if len(lost) > SHOWN else ""
            raise HandoutError(
                f"Nothing was written, because files in {self.path} were changed by hand and not "
                f"committed: {', '.join(lost[:SHOWN])}{more}. The release would overwrite these "
                f"changes. Discard the changes (`git -C {self.path} checkout HEAD -- .`) or keep "
                f"them in a commit (`git -C {self.path} commit -a`), and type the command again."
            )

    def _would_change(self, name: str, files: Mapping[str, File]) -> bool:
        path = self.path / name
        present = path.read_bytes() if path.is_file() else None
        wanted = files[name].content if name in files else None
        return present is not None and present != wanted

    def _put(self, name: str, file: File) -> bool:
        """Write a file if its content has changed; return whether this function wrote the file."""
        path = self.path / name
        mode = 0o755 if file.executable else 0o644
        same = path.is_file() and not path.is_symlink() and path.read_bytes() == file.content
        if same and path.stat().st_mode & 0o777 == mode:
            return False
        if not same:
            write_atomically(path, file.content)
        path.chmod(mode)
        return True

    def _remove(self, name: str) -> bool:
        path = self.path / name
        if not path.exists():
            return False
        path.unlink()
        for folder in path.relative_to(self.path).parents[:-1]:
            with suppress(OSError):  # An OSError means that the folder is not empty.
                (self.path / folder).rmdir()
        return True

    def _commit(self, names: Sequence[str], message: str) -> str:
        """Commit the current state of the files; return the commit's short name, or "" if nothing changed."""
        if not (self.path / ".git").exists():
            git(self.path, "init", "--quiet", f"--initial-branch={BRANCH}", "--template=")
        listed = "".join(f"{name}\0" for name in dict.fromkeys(names))
        git(self.path, "update-index", "--add", "--remove", "-z", "--stdin", given=listed)
        if git_value(self.path, "rev-parse", "-q", "--verify", "HEAD") and not git(
            self.path, "diff", "--cached", "--name-only", "HEAD"
        ):
            return ""
        git(self.path, "commit", "--quiet", "--message", message, identity=True)
        return git(self.path, "rev-parse", "--short", "HEAD").strip()


def _stays_inside(name: str) -> bool:
    return bool(name) and not name.startswith("/") and ".." not in name.split("/")


def refuse_inside(path: Path, checkout: Path) -> None:
    """Raise HandoutError if `path` is in the checkout.

    Otherwise, the next release would contain this release.
    """
    if path.resolve().is_relative_to(checkout.resolve()):
        raise HandoutError(f"{path} is inside the course's own folder. Give a folder outside {checkout}.")
