"""How a worker separates students' code from the grader and from the machine."""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from course_pkg.sandbox.linux.users import Users


class Kind(str, Enum):
    """The kinds of isolation; the value is the first argument of a worker."""

    # The isolation uses bubblewrap, namespaces, limits, and a filter of system calls.
    NAMESPACES = "sandboxed"
    USERS = "users"  # The isolation uses other users of the machine, limits, and a filter of system calls.
    NONE = "unsafe"  # Students' code runs with the rights of the grader.


class Isolation(NamedTuple):
    """The isolation of a running worker; `users` has a value only for the kind USERS."""

    kind: Kind
    users: Users | None = None

    @property
    def namespaces(self) -> bool:
        """Whether the processes of a part have their own network and folders."""
        return self.kind is Kind.NAMESPACES
