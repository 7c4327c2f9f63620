"""The trusted process of a sandbox worker: it reads one job per line, and prints one result per line.

The worker has two arguments. The first argument is the kind of isolation (see isolation.py). The second
argument is the folder with an instructor's private exercises, or "".
"""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import sys
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from dataclasses import replace

from course_pkg.checking.report import Verdict
from course_pkg.sandbox import fork_server, supervisor
from course_pkg.sandbox.channel import end, fork, pair, receive, send, share_memory_with_children
from course_pkg.sandbox.isolation import Isolation, Kind
from course_pkg.sandbox.job import PartJob, PartResult, Record, job_from
from course_pkg.sandbox.linux import confinement, namespaces, users

START_TIMEOUT = 60.0  # The fork server has to import its modules within this time in s.
PLACE_TIMEOUT = 15.0  # A supervisor has to start its processes within this time in s.
END_TIMEOUT = 8.0  # A supervisor has to end all its descendants within this time in s.
KILLED_TIMEOUT = 30.0  # The fork server has to report a killed supervisor within this time in s.
# A check runner has to finish within this time in s after the end of the student's process.
VERDICT_TIMEOUT = 3.0
# This is the maximum number of bytes for one read, and for all messages of the student's process together.
CHUNK = 65536

LIMITS = {
    supervisor.TOO_MUCH_MEMORY: "the answer used more memory than allowed",
    supervisor.TOO_MUCH_DISK: "the answer wrote more files than allowed",
}
# A supervisor ends the processes of a part when the part exceeds a limit. The check may then report one of
# these verdicts only because the processes have ended.
STOPPED = (Verdict.FAILED, Verdict.UNDECIDED)
ENDINGS = {
    supervisor.STUDENT_ENDED: "the process that ran the answer ended before the check was finished",
    **LIMITS,
}


def main() -> None:
    """Run the jobs from stdin until stdin is closed."""
    namespaces.die_with_parent()
    kind, private = Kind(sys.argv[1]), sys.argv[2]
    isolation = Isolation(kind)
    if kind is Kind.NAMESPACES:
        namespaces.become_root()
    if kind is Kind.USERS:
        os.umask(0o022)
        reserved, _lock = users.reserve()  # No other worker can use these users until this process ends.
        isolation = Isolation(kind, reserved)
    ours, theirs = pair()
    child = fork(lambda: _serve_forks(theirs, ours, private, isolation))
    theirs.close()
    receive(ours, START_TIMEOUT)
    _import_checks(private)
    share_memory_with_children()
    sys.stdout.write('{"ready": true}\n')
    sys.stdout.flush()
    for line in sys.stdin:
        result = Session(ours, job_from(line), isolation).run()
        sys.stdout.write(result.as_json() + "\n")
        sys.stdout.flush()
    end([child])


def _serve_forks(theirs: socket.socket, ours: socket.socket, private: str, isolation: Isolation) -> None:
    ours.close()
    namespaces.die_with_parent()
    fork_server.serve_forks(theirs, private, isolation=isolation)


def _import_checks(private: str) -> None:
    """Import every check; forked check runners then need no imports.

    The fork server was forked earlier, so its memory does not contain the checks.
    """
    from course_pkg.checking.parts import add_private, every_part

    if private:
        add_private(private)
    list(every_part())


class Session:
    """One job, from the start to the end of its supervisor."""

    def __init__(self, fork_server: socket.socket, job: PartJob, isolation: Isolation) -> None:
        self._fork_server = fork_server
        self._job = job
        self._isolation = isolation
        self._over: int | None = None  # This is the wait status of the supervisor.
        self._supervisor = 0
        self._student = 0  # The answer runs in this process, or in a descendant of this process.
        self._began = time.monotonic()
        self._limit = job.limit  # The limit in s depends on the current load of the machine.

    def run(self) -> PartResult:
        """Run the job, and end all processes of the job.

        Raises TimeoutError if the fork server does not respond; after this error, do not use the worker
        again.
        """
        with ExitStack() as stack:
            messages, commands = self._begin(stack)
            record, ending = None, "the processes of this part could not be started"
            try:
                network, port, listener = self._placed(stack)
                record, ending = self._checked(network, port, listener, commands)
            except TimeoutError:
                # Do not use this worker again: a later message of the fork server may belong to this job or
                # to the next job.
                raise
            except (EOFError, OSError) as error:
                ending = f"{ending} ({error})" if str(error) else ending
            self._end_supervisor()
            took = time.monotonic() - self._began
            return PartResult(record, "" if record else ending, _messages_of(messages), took)

    def _begin(self, stack: ExitStack) -> tuple[int, socket.socket]:
        """Send the job to the fork server; return the pipe for messages, and the socket for commands."""
        job_file = os.memfd_create("job")
        unseeded = replace(self._job, seed=0)  # Only the check runner may know the seed of its random inputs.
        os.write(job_file, unseeded.as_json().encode())
        os.lseek(job_file, 0, os.SEEK_SET)
        reading, writing = os.pipe()
        ours, theirs = socket.socketpair()
        send(self._fork_server, {"job": True}, (job_file, writing, theirs.fileno()))
        for descriptor in (job_file, writing):
            os.close(descriptor)
        theirs.close()
        stack.callback(os.close, reading)
        return reading, stack.enter_context(ours)

    def _placed(self, stack: ExitStack) -> tuple[int, int, socket.socket]:
        """Return the part's network, the port of the part's master, and the socket for the check client."""
        message, descriptors = receive(self._fork_server, PLACE_TIMEOUT)
        if "over" in message:
            self._over = int(message["over"])
            raise EOFError
        network, listener = descriptors
        stack.callback(os.close, network)
        self._supervisor, self._student = int(message["supervisor"]), int(message["student"])
        return network, int(message["port"]), stack.enter_context(socket.socket(fileno=listener))

    def _checked(
        self, network: int, port: int, listener: socket.socket, commands: socket.socket
    ) -> tuple[Record | None, str]:
        """Wait for the check client, and run the check.

        Return the record, or the reason why there is no record.
        """
        if listener not in self._wait([listener]):
            return None, self._reason()
        client, _ = listener.accept()
        reading, writing = os.pipe()
        with client:
            runner = fork(lambda: self._run_check(network, port, client, commands, writing))
        os.close(writing)
        try:
            ready = bool(self._wait([reading]))
            if self._over is not None and not ready:
                ready = bool(select.select([reading], [], [], VERDICT_TIMEOUT)[0])
            if not ready:
                return None, self._reason()
            record = _record(reading)
            if record and record["verdict"] in STOPPED and self._was_stopped():
                # The check failed only because the supervisor had ended the processes of the part.
                return None, self._reason()
            return record, "the check runner ended without a verdict"
        finally:
            end([runner])
            os.waitpid(runner, 0)
            os.close(reading)

    def _run_check(
        self, network: int, port: int, client: socket.socket, commands: socket.socket, out: int
    ) -> None:
        from course_pkg.sandbox.check_process import check_part

        namespaces.die_with_parent()
        # The memory of the check runner is limited, because a submission may send any amount of data.
        namespaces.limit(AS=confinement.CHECK_RUNNER)
        check_part(
            self._job,
            network,
            port,
            client,
            commands,
            out,
            kernel=self._kernel,
            isolation=self._isolation,
        )

    def _kernel(self) -> int:
        """Return the id of the process in which the answer runs."""
        return confinement.innermost(self._student) if self._isolation.namespaces else self._student

    def _wait(self, files: Sequence[int | socket.socket]) -> list[int | socket.socket]:
        """Wait until one of the files is ready, the supervisor ends, or the job reaches its time limit."""
        left = self._began + self._limit - time.monotonic()
        ready = select.select([*files, self._fork_server], [], [], max(left, 0.0))[0]
        if self._fork_server in ready:
            self._over = int(receive(self._fork_server)[0]["over"])
        return [file for file in ready if file is not self._fork_server]

    def _was_stopped(self) -> bool:
        """Return whether the supervisor has ended all processes because of a limit."""
        if self._over is None and select.select([self._fork_server], [], [], VERDICT_TIMEOUT)[0]:
            self._over = int(receive(self._fork_server)[0]["over"])
        return self._over is not None and os.waitstatus_to_exitcode(self._over) in LIMITS

    def _reason(self) -> str:
        if self._over is None:
            return f"the check was not finished after {self._limit:g} s"
        code = os.waitstatus_to_exitcode(self._over)
        return ENDINGS.get(code, "the processes of this part ended unexpectedly")

    def _end_supervisor(self) -> None:
        if self._over is None and self._supervisor:
            with suppress(ProcessLookupError):
                os.kill(self._supervisor, signal.SIGTERM)
            try:
                receive(self._fork_server, END_TIMEOUT)
            except TimeoutError:
                end([self._supervisor])
                # Receive the message about the end of the supervisor here; the next job must not receive it.
                # If the message does not arrive, this worker is not used any more.
                receive(self._fork_server, KILLED_TIMEOUT)


def _record(reading: int) -> Record | None:
    data = b""
    while chunk := os.read(reading, CHUNK):
        data += chunk
    try:
        record: Record = json.loads(data)
    except ValueError:
        return None
    return record


def _messages_of(descriptor: int) -> tuple[dict[str, str], ...]:
    """Return the messages of the student's process; lines that are not JSON objects are omitted."""
    os.set_blocking(descriptor, False)
    messages = []
    with suppress(BlockingIOError):
        for line in os.read(descriptor, CHUNK).splitlines():
            with suppress(ValueError, RecursionError):
                found = json.loads(line)
                if isinstance(found, dict):
                    messages.append(
                        {str(key)[:20]: str(value)[:2000] for key, value in list(found.items())[:4]}
                    )
    return tuple(messages[:40])


if __name__ == "__main__":
    main()
