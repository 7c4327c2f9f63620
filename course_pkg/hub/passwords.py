"""One-time passwords: each password is accepted once.

After the login, a cookie in the browser identifies the student.
"""

from __future__ import annotations

import csv
import hashlib
import hmac
import io
import json
import os
import secrets
from collections.abc import Iterable
from pathlib import Path

from course_pkg.files import write_atomically
from course_pkg.setup.stamps import locked

# The characters of a password, without letters and digits that look alike.
LETTERS = "abcdefghjkmnpqrstuvwxyz23456789"
GROUPS, LENGTH = 3, 4  # 31 ** 12 possible passwords, such as k3fp-wx7d-m9qa
SCRYPT = {"n": 2**14, "r": 8, "p": 1}  # parameters of scrypt (RFC 7914); one hash takes about 50 ms


class Passwords:
    """The hashes of the passwords that have not been used, in a file that only its owner can read."""

    def __init__(self, file: Path) -> None:
        self._file = file

    def issue(self, users: Iterable[str], again: bool = False) -> dict[str, str]:
        """Return new passwords for the users who never had one, or for all `users` if `again` is true."""
        with self._locked() as known:
            chosen = [user for user in users if again or user not in known]
            issued = {user: _new() for user in chosen}
            for user, password in issued.items():
                salt = secrets.token_bytes(16)
                known[user] = f"{salt.hex()}:{_hash(password, salt)}"
        return issued

    def use(self, user: str, password: str) -> bool:
        """Return whether this is the user's unused password. If so, the password becomes invalid."""
        with self._locked() as known:
            salt, _, expected = known.get(user, "").partition(":")
            given = _hash(password.strip().lower(), bytes.fromhex(salt))
            right = bool(expected) and hmac.compare_digest(given, expected)
            if right:
                known[user] = ""
        return right

    def _locked(self) -> _Record:
        return _Record(self._file)


class _Record:
    """A context manager that reads the file at the start of the `with` block, and writes it at the end.

    During the block, other processes that use the file wait.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._lock = locked(file.with_suffix(".lock"), lambda: None)

    def __enter__(self) -> dict[str, str]:
        self._lock.__enter__()
        self._known: dict[str, str] = json.loads(self._file.read_text()) if self._file.exists() else {}
        self._before = dict(self._known)
        return self._known

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: object) -> None:
        try:
            if kind is None and self._known != self._before:
                write_private(self._file, json.dumps(self._known, indent=1))
        finally:
            self._lock.__exit__(None, None, None)


def write_private(path: Path, text: str) -> None:
    """Write the text to a file, completely or not at all; only the owner can read the file."""
    before = os.umask(0o077)
    try:
        write_atomically(path, text)
    finally:
        os.umask(before)


def add_to_table(path: Path, issued: dict[str, str]) -> None:
    """Add rows to a CSV file with the columns username and password; only the file's owner can read it."""
    rows: dict[str, str] = {}
    if path.exists():
        with path.open(newline="") as file:
            rows = {row["username"]: row["password"] for row in csv.DictReader(file)}
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(["username", "password"])
    writer.writerows({**rows, **issued}.items())
    write_private(path, text.getvalue())


def _new() -> str:
    return "-".join("".join(secrets.choice(LETTERS) for _ in range(LENGTH)) for _ in range(GROUPS))


def _hash(password: str, salt: bytes) -> str:
    return hashlib.scrypt(password.encode(), salt=salt, **SCRYPT).hex()
