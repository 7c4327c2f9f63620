"""10.6: two shelves with locks that reveal a deadlock and a missing lock."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence

from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value

# If a thread cannot acquire a lock within this time in s, the check assumes a deadlock.
LIMIT = 4.0
BEGIN = 2.0  # All threads must have begun within this time in s.

MEETING = 0.01  # A thread that holds a lock waits up to this time in s for another thread.
# After the first call of acquire(), the thread waits up to this time in s for the other threads.
FIRST_MEETING = 0.3

# This code calls the student's function once, or in several threads; `pair` is a proxy for a CheckedPair.
KERNEL_CODE = """
import threading


def checked_move(function, pair, source, target):
    shelves = pair.first, pair.second
    return function(shelves[source], shelves[target])


def checked_cross(function, pair, count, moves):
    shelves = pair.first, pair.second

    def work(source):
        try:
            pair.begin(count)
            for _ in range(moves):
                pair.returned(function(shelves[source], shelves[1 - source]))
        except Exception as error:
            pair.raised(f"{type(error).__name__}: {error}")

    threads = [threading.Thread(target=work, args=(number % 2,), daemon=True) for number in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
"""


class Deadlock(Exception):
    """A thread would wait for a lock for ever."""


class CheckedLock:
    """A lock; after acquire(), the thread waits briefly, so that another thread can acquire the second lock.

    Two threads that acquire the two locks in opposite order always block each other. A thread that waits too
    long gets an error, so that all threads end.
    """

    def __init__(self, pair: CheckedPair, limit: float) -> None:
        self.owner: int | None = None
        self._pair, self._limit = pair, limit
        self._lock = threading.Lock()
        self._begun = time.monotonic()

    @remote
    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Acquire the lock; threading.Lock.acquire() has the same arguments."""
        if self.owner == threading.get_ident() and blocking and timeout < 0:
            raise Deadlock("the thread already holds this lock")
        limited = blocking and timeout < 0
        if not self._lock.acquire(blocking, self._limit if limited else timeout):
            if limited:
                raise Deadlock("two threads wait for each other")
            if time.monotonic() > self._begun + self._limit:
                raise Deadlock("a thread tries again and again without success")
            return False
        self.owner = threading.get_ident()
        self._pair.meet()
        return True

    @remote
    def release(self) -> None:
        """Release the lock, like threading.Lock.release()."""
        self.owner = None
        self._lock.release()

    @remote
    def locked(self) -> bool:
        """Return whether a thread has acquired the lock."""
        return self._lock.locked()

    @remote
    def __enter__(self) -> bool:
        self.acquire()
        return True

    @remote
    def __exit__(self, *_: Value) -> None:
        self.release()


class CheckedShelf:
    """One of the two shelves in a CheckedPair."""

    def __init__(self, pair: CheckedPair, number: int, count: int, limit: float) -> None:
        self.things: Value = count
        self._pair, self._number = pair, number
        self._lock = CheckedLock(pair, limit)

    @property
    @remote
    def number(self) -> int:
        """The number of the shelf."""
        return self._number

    @property
    @remote
    def lock(self) -> CheckedLock:
        """The lock of the shelf."""
        return self._lock

    @property
    @remote
    def count(self) -> Value:
        """The number of things on the shelf."""
        self._pair.reads.append(self._pair.held())
        return self.things

    @count.setter
    @remote
    def count(self, count: Value) -> None:
        self._pair.changes.append(self._pair.held())
        self.things = count


class CheckedPair:
    """Two shelves, each with a lock.

    The object records how many locks a thread held when the thread read or changed a count.
    """

    def __init__(self, numbers: Sequence[int], counts: Sequence[int], *, crowd: bool = False) -> None:
        self.reads: list[int] = []
        self.changes: list[int] = []
        self.errors: list[str] = []
        self.results: list[Value] = []
        self._shelves = [CheckedShelf(self, *each, LIMIT) for each in zip(numbers, counts, strict=True)]
        self._meeting = FIRST_MEETING if crowd else MEETING
        self._begun = 0
        self._turn = threading.Condition()

    @property
    @remote
    def first(self) -> CheckedShelf:
        """The first shelf; its number is lower than the number of the second shelf."""
        return self._shelves[0]

    @property
    @remote
    def second(self) -> CheckedShelf:
        """The second shelf; its number is higher than the number of the first shelf."""
        return self._shelves[1]

    @remote
    def begin(self, count: int) -> None:
        """Wait until `count` threads have called this method."""
        with self._turn:
            self._begun += 1
            self._turn.notify_all()
            if not self._turn.wait_for(lambda: self._begun >= count, BEGIN):
                raise TimeoutError("the threads ran one after the other")

    @remote
    def returned(self, value: Value) -> None:
        """Record the result of a call."""
        self.results.append(value)

    @remote
    def raised(self, error: str) -> None:
        """Record the error that ended a thread."""
        self.errors.append(str(error))

    @property
    def counts(self) -> list[Value]:
        """The number of things on each of the two shelves."""
        return [shelf.things for shelf in self._shelves]

    @property
    def locked(self) -> bool:
        """Whether a thread has acquired a lock."""
        return any(shelf.lock.locked() for shelf in self._shelves)

    @property
    def error(self) -> str:
        """One of the recorded errors, or ""."""
        return min(self.errors, key=lambda error: "without success" not in error, default="")

    def held(self) -> int:
        """Return the number of locks that the current thread has acquired."""
        return sum(shelf.lock.owner == threading.get_ident() for shelf in self._shelves)

    def meet(self) -> None:
        """Wait until another thread has also acquired a lock, but only for a short time."""
        with self._turn:
            limit, self._meeting = self._meeting, MEETING
            self._turn.notify_all()
            self._turn.wait_for(
                lambda: len({shelf.lock.owner for shelf in self._shelves} - {None}) > 1, limit
            )
