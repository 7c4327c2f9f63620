"""This process forks a new process for each part. It has imported all modules except the checks."""

from __future__ import annotations

import os
import socket
from pathlib import Path
from typing import NoReturn

from course_pkg.checking.parts import secret_paths
from course_pkg.sandbox.channel import end_all_below, fork, receive, send, share_memory_with_children
from course_pkg.sandbox.isolation import Isolation
from course_pkg.sandbox.linux import namespaces, users
from course_pkg.sandbox.student_process import prepare
from course_pkg.sandbox.supervisor import supervise

CLEAR_TIMEOUT = 60.0  # All processes of a part have to end within this time in s.


def serve_forks(sock: socket.socket, private: str, *, isolation: Isolation) -> NoReturn:
    """Fork a supervisor for each job from the socket; report the end of the supervisor's processes."""
    namespaces.adopt_orphans()
    if isolation.namespaces:
        _hide_checks(private)
    shell = prepare()
    share_memory_with_children()
    try:
        send(sock, {"ready": True})
        while True:
            _, (job_file, messages, commands) = receive(sock)
            # This process does not read the job. Otherwise, processes of later parts could find the job in
            # its memory.
            pid = fork(lambda: supervise(job_file, shell, sock, messages, commands, isolation=isolation))  # noqa: B023
            for descriptor in (job_file, messages, commands):
                os.close(descriptor)
            status = os.waitpid(pid, 0)[1]
            end_all_below(CLEAR_TIMEOUT)  # In a sandbox, all remaining processes belong to the ended job.
            if isolation.users:
                users.clear(isolation.users)
            send(sock, {"over": status})
    except (EOFError, OSError):
        os._exit(0)


def _hide_checks(private: str) -> None:
    """Hide the files of all checks from all processes that are forked later."""
    namespaces.unshare(namespaces.MOUNT)
    for path in [*secret_paths(), *([Path(private)] if private else [])]:
        namespaces.hide(str(path))
