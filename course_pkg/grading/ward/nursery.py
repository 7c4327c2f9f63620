"""The process from which submissions are forked: it has everything imported, and has never seen a check."""

from __future__ import annotations

import os
import socket
from typing import NoReturn

from course_pkg.examiner import checks
from course_pkg.grading import namespaces
from course_pkg.grading.ward.leader import lead
from course_pkg.grading.ward.student import prepare
from course_pkg.grading.ward.wire import end_all_below, fork, receive, send

CLEARING = 60.0  # s


def tend(sock: socket.socket, private: str, *, walls: bool) -> NoReturn:
    """Fork a leader for each job that comes over `sock`, and say when it and all below it are gone."""
    namespaces.adopt_orphans()
    if walls:
        _forget_checks(private)
    shell = prepare()
    try:
        send(sock, {"ready": True})
        while True:
            _, (job_file, said, errands) = receive(sock)
            # The leader reads the job: what this process once held, all later forks would find in its memory.
            leader = fork(lambda: lead(job_file, shell, sock, said, errands, walls=walls))  # noqa: B023
            for descriptor in (job_file, said, errands):
                os.close(descriptor)
            status = os.waitpid(leader, 0)[1]
            end_all_below(CLEARING)  # behind walls nothing is left
            send(sock, {"over": status})
    except (EOFError, OSError):
        os._exit(0)


def _forget_checks(private: str) -> None:
    """Cover the folder of the checks: of all that is forked from here, nothing can read it."""
    namespaces.unshare(namespaces.MOUNT)
    for folder in filter(None, [*checks.__path__, private]):
        namespaces.mount_memory(folder, read_only=True)
