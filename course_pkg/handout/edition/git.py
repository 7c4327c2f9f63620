"""Runs git in a folder.

The user's git hooks do not run. The variables that git sets for a hook are removed.
"""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from course_pkg.errors import HandoutError

SETTINGS = {
    "core.autocrlf": "false",
    "core.fileMode": "true",
    "core.hooksPath": os.devnull,
    "commit.gpgSign": "false",
    "safe.directory": "*",  # The instructor chose the folder, so git accepts any owner of this folder.
}
# This identity is used if the user has configured no name and address in git.
NO_IDENTITY = {"user.name": "course release", "user.email": "course@localhost"}


def git(folder: Path, *arguments: str, given: str = "", identity: bool = False) -> str:
    """Run git in the folder `folder` with the text `given` as its input, and return its output.

    If `identity` is True, a commit gets a default name and address if the user has configured none. Raises
    HandoutError if git fails or is not installed.
    """
    settings = {**SETTINGS, **(_missing_identity(folder) if identity else {})}
    options = [word for name, value in settings.items() for word in ("-c", f"{name}={value}")]
    try:
        done = subprocess.run(
            ["git", *options, "-C", str(folder), *arguments],
            input=given,
            capture_output=True,
            text=True,
            env=_environment(),
            check=True,
        )
    except FileNotFoundError as error:
        raise HandoutError(
            "git is not installed. As an administrator, type: apt-get install git. Then type the command "
            "again."
        ) from error
    except subprocess.CalledProcessError as error:
        reason = " ".join((error.stderr or error.stdout).split()) or f"exit status {error.returncode}"
        raise HandoutError(
            f"git {arguments[0]} failed in {folder}: {reason}. Correct this problem, and type the "
            "command again."
        ) from error
    return done.stdout


def git_value(folder: Path, *arguments: str) -> str:
    """Return the line that git prints. If git fails, for example because the value is not set, return ""."""
    try:
        return git(folder, *arguments).strip()
    except HandoutError:
        return ""


def _missing_identity(folder: Path) -> dict[str, str]:
    return {name: value for name, value in NO_IDENTITY.items() if not git_value(folder, "config", name)}


def _environment() -> dict[str, str]:
    """Return the environment without the variables that git sets for a hook."""
    kept = ("GIT_CONFIG", "GIT_AUTHOR_", "GIT_COMMITTER_", "GIT_SSL", "GIT_SSH")
    known = os.environ.items()
    return {name: value for name, value in known if not name.startswith("GIT_") or name.startswith(kept)}
