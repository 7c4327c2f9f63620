"""The trusted process of a ward: takes one job a line, and answers each with its outcome, a line.

Started behind the outer wall with "walls" as its first argument, or with "none" without one; the second is
the folder of an instructor's private parts, or empty.
"""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import sys
import time
from contextlib import ExitStack, suppress
from dataclasses import replace
from typing import Any

from course_pkg.grading import namespaces
from course_pkg.grading.ward import confinement, leader, nursery
from course_pkg.grading.ward.job import PartJob, PartOutcome, job_from
from course_pkg.grading.ward.wire import end, fork, pair, receive, send

STARTING = 60.0  # s for the nursery to have all imported
PLACING = 15.0  # s for a leader to have all in place
ENDING = 8.0  # s for a leader to end all below it
AFTERTHOUGHT = 3.0  # s for a judge to come to its verdict when the student is gone
WORDS = 65536  # bytes of what the student's side may say

ENDINGS = {
    leader.STUDENT_ENDED: "the process in which the answer ran came to an end before its check was done",
    leader.TOO_MUCH_MEMORY: "the answer took more memory than there is for one",
}


def main() -> None:
    """Serve jobs from stdin until it ends."""
    namespaces.die_with_parent()
    walls, private = sys.argv[1] == "walls", sys.argv[2]
    if walls:
        namespaces.become_root()
    ours, theirs = pair()
    child = fork(lambda: _nursery(theirs, ours, private, walls=walls))
    theirs.close()
    receive(ours, STARTING)
    _import_checks(private)
    sys.stdout.write('{"ready": true}\n')
    sys.stdout.flush()
    for line in sys.stdin:
        outcome = Session(ours, job_from(json.loads(line)), walls=walls).run()
        sys.stdout.write(json.dumps(outcome.as_dict()) + "\n")
        sys.stdout.flush()
    end([child])


def _nursery(theirs: socket.socket, ours: socket.socket, private: str, *, walls: bool) -> None:
    ours.close()
    namespaces.die_with_parent()
    nursery.tend(theirs, private, walls=walls)


def _import_checks(private: str) -> None:
    """Have every check imported, so that a judge costs a fork; the nursery, forked before, has none."""
    from course_pkg.examiner.parts import add_private, every_part

    if private:
        add_private(private)
    list(every_part())


class Session:
    """One job, from its network's beginning to its end."""

    def __init__(self, nursery_socket: socket.socket, job: PartJob, *, walls: bool) -> None:
        self._nursery = nursery_socket
        self._job = job
        self._walls = walls
        self._over: int | None = None  # how the leader ended
        self._leader = 0
        self._began = time.monotonic()

    def run(self) -> PartOutcome:
        """Carry the job out, and end all that it started."""
        with ExitStack() as stack:
            said, errands = self._begin(stack)
            record, ending = None, "the place for the answer could not be made"
            try:
                network, port, desk = self._placed(stack)
                record, ending = self._judged(network, port, desk, errands)
            except TimeoutError:
                raise  # nobody knows what the nursery says next, and for whom: this ward is lost
            except (EOFError, OSError) as error:
                ending = f"{ending} ({error})" if str(error) else ending
            self._end_leader()
            took = time.monotonic() - self._began
            return PartOutcome(record, "" if record else ending, _spoken(said), took)

    def _begin(self, stack: ExitStack) -> tuple[int, socket.socket]:
        """Hand the job to the nursery; return where the student speaks, and our end of the errands."""
        job_file = os.memfd_create("job")
        unseeded = replace(self._job, seed=0)  # what the judge will draw is nobody else's business
        os.write(job_file, json.dumps(unseeded.as_dict()).encode())
        os.lseek(job_file, 0, os.SEEK_SET)
        said, saying = os.pipe()
        ours, theirs = socket.socketpair()
        send(self._nursery, {"job": True}, (job_file, saying, theirs.fileno()))
        for descriptor in (job_file, saying):
            os.close(descriptor)
        theirs.close()
        stack.callback(os.close, said)
        return said, stack.enter_context(ours)

    def _placed(self, stack: ExitStack) -> tuple[int, int, socket.socket]:
        words, descriptors = receive(self._nursery, PLACING)
        if "over" in words:
            self._over = words["over"]
            raise EOFError
        network, listener = descriptors
        stack.callback(os.close, network)
        self._leader = words["leader"]
        return network, words["port"], stack.enter_context(socket.socket(fileno=listener))

    def _judged(
        self, network: int, port: int, listener: socket.socket, errands: socket.socket
    ) -> tuple[dict[str, Any] | None, str]:
        """Wait for the student's desk, judge, and return the record, or why there is none."""
        if listener not in self._wait([listener]):
            return None, self._why()
        desk, _ = listener.accept()
        reading, writing = os.pipe()
        with desk:
            judge = fork(lambda: self._judge(network, port, desk, errands, writing))
        os.close(writing)
        try:
            ready = self._wait([reading])
            if self._over is not None and not ready:
                ready = select.select([reading], [], [], AFTERTHOUGHT)[0]
            return (_record(reading), "the judge ended without a verdict") if ready else (None, self._why())
        finally:
            end([judge])
            os.waitpid(judge, 0)
            os.close(reading)

    def _judge(self, network: int, port: int, desk: socket.socket, errands: socket.socket, out: int) -> None:
        from course_pkg.grading.ward.judging import judge_part

        namespaces.die_with_parent()
        namespaces.limit(AS=confinement.JUDGE)  # a submission decides how much it sends to its judge
        judge_part(self._job, network, port, desk, errands, out, walls=self._walls)

    def _wait(self, files: list[Any]) -> list[Any]:
        """Wait for one of `files`, until the leader has ended or the job's time is over."""
        left = self._began + self._job.limit - time.monotonic()
        ready = select.select([*files, self._nursery], [], [], max(left, 0.0))[0]
        if self._nursery in ready:
            self._over = receive(self._nursery)[0]["over"]
            return [file for file in ready if file is not self._nursery]
        return ready

    def _why(self) -> str:
        if self._over is None:
            return f"it was not done after {self._job.limit:g} s"
        code = os.waitstatus_to_exitcode(self._over)
        return ENDINGS.get(code, "the place in which the answer ran was lost")

    def _end_leader(self) -> None:
        if self._over is None and self._leader:
            with suppress(ProcessLookupError):
                os.kill(self._leader, signal.SIGTERM)
            try:
                receive(self._nursery, ENDING)
            except TimeoutError:
                end([self._leader])
                with suppress(TimeoutError):
                    receive(self._nursery, ENDING)


def _record(reading: int) -> dict[str, Any] | None:
    data = b""
    while chunk := os.read(reading, WORDS):
        data += chunk
    try:
        record: dict[str, Any] = json.loads(data)
    except ValueError:
        return None
    return record


def _spoken(descriptor: int) -> tuple[dict[str, Any], ...]:
    """Return what the student's side said; whatever is no line of JSON was not said by us, and is dropped."""
    os.set_blocking(descriptor, False)
    lines = []
    with suppress(BlockingIOError):
        for line in os.read(descriptor, WORDS).splitlines():
            with suppress(ValueError, RecursionError):
                words = json.loads(line)
                if isinstance(words, dict):
                    lines.append({str(key)[:20]: str(value)[:2000] for key, value in list(words.items())[:4]})
    return tuple(lines[:40])


if __name__ == "__main__":
    main()
