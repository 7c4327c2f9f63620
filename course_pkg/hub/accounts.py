"""Checks the names of the students' Linux accounts, and creates the missing accounts."""

from __future__ import annotations

import os
import pwd
import re
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

from course_pkg.errors import HubError

NAME = re.compile(r"[a-z][a-z0-9_-]{0,31}")  # useradd accepts all these names
FIRST_UID = 1000  # smaller numbers belong to the system's own accounts


def check_names(names: Iterable[str]) -> None:
    """Raise HubError, with a list of the wrong names, if a name is not valid for an account."""
    wrong = [name for name in names if not NAME.fullmatch(name)]
    if wrong:
        raise HubError(
            f"These names cannot be names of accounts: {', '.join(map(repr, wrong))}. A name has at most 32 "
            "characters, begins with a letter, and contains only a to z, 0 to 9, _ and -. Change the names "
            "in the list."
        )


def make_accounts(names: Iterable[str]) -> list[str]:
    """Create the accounts that are missing, each with a home folder, and return their names.

    The new accounts have no password for a login to the machine itself. Raises HubError if a name belongs to
    the system or this process is not root; no account is created then.
    """
    missing = []
    for name in names:
        try:
            account = pwd.getpwnam(name)
        except KeyError:
            missing.append(name)
            continue
        if account.pw_uid < FIRST_UID:
            raise HubError(f"{name} is an account of the system. Give this student another user name.")
    if missing and os.geteuid() != 0:
        raise HubError(
            f"These accounts are missing: {', '.join(missing)}. Only root can create accounts, so "
            "type the command with sudo. To try the hub without accounts, add --without-accounts "
            "DIR."
        )
    for name in missing:
        command = ["useradd", "--create-home", "-K", "HOME_MODE=0700", "--shell", "/bin/bash", name]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise HubError(
                f"The account {name} was not created: {done.stderr.strip()}. Correct this problem, and "
                "type the command again."
            )
    return missing


def home_problems(names: Iterable[str]) -> Iterator[str]:
    """Yield a line for each student in `names` who cannot use the home folder of their account."""
    for account in map(pwd.getpwnam, names):
        if problem := home_problem(Path(account.pw_dir), account.pw_uid):
            yield f"The student {account.pw_name} cannot use the hub: {problem}"


def home_problem(home: Path, uid: int) -> str:
    """Return why a student with the user id `uid` cannot use the folder `home`, or an empty string."""
    try:
        owner = home.stat().st_uid
    except OSError as error:
        return f"the home folder {home} does not exist ({error.strerror}). An administrator has to create it."
    if owner != uid:
        return f"the home folder {home} belongs to another user. An administrator has to change its owner."
    return ""
