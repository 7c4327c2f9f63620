"""10.6: a function that needs two locks; several threads call it at the same time."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value

# If a thread cannot acquire a lock within this time in s, the check assumes a deadlock.
LIMIT = 4.0
THREADS, MOVES = 4, 6  # There are THREADS threads, and each thread makes MOVES moves.
BEGIN = 2.0  # All threads must have begun within this time in s.
RUN = 14.0  # This time limit in s for all threads is enough for three consecutive deadlocks and all moves.

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
        """Acquire the lock; the arguments are those of threading.Lock.acquire()."""
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


ERRORS = [
    (
        matches("Deadlock: the thread already"),
        "The function acquires a lock that its own thread already holds. Acquire each of the two locks once.",
    ),
    (
        matches("unlocked lock"),
        "The function released a lock that it did not hold. Use `with`, which releases each lock "
        "exactly once.",
    ),
    (
        matches("TimesUp|without success"),
        (
            "The function did not return. If your code acquires the second lock in a loop, "
            "release the first lock before each new attempt."
        ),
    ),
    (
        matches("one after the other"),
        (
            "The threads of the check ran one after the other, because your code has changed a module of "
            "Python. Remove this change, and use only the two locks."
        ),
    ),
    (
        matches("'<' not supported"),
        (
            "Python cannot compare two shelves with <. Sort the shelves by their numbers: key=lambda "
            "shelf: shelf.number."
        ),
    ),
]
CROSSED = (
    "Two threads acquired the two locks in opposite orders, so each of them waits for the other. "
    "Acquire the locks in the same order in every call, for example by the shelves' numbers."
)
UNLOCKED = (
    "The function changed a count while it did not hold both locks, so another thread can read two "
    "counts with a wrong sum. Hold both locks while you read and write the counts."
)

UNLOCKED_READ = (
    "The function read a count before it held both locks, so another thread can change this count. "
    "First acquire both locks, and then read the counts."
)
MOVED = "Move one thing from the source to the target, but not from an empty shelf."


@part(
    "10.6",
    points=2,
    goal="Move a thing between two shelves while you hold both locks, without a deadlock.",
    needs=["move"],
    deadline=30.0,
    goals=[MOVED, "Move things in both directions at the same time, without a deadlock."],
)
def move_without_deadlock(context: CheckContext) -> None:
    """Move things in one thread, and try to move a thing from an empty shelf.

    At the end, let several threads move things in both directions at the same time.
    """
    context.prepare(KERNEL_CODE)
    numbers = sorted(context.random.integers(2, 1, 99))
    few = context.random.integer(2, 3)
    pair = CheckedPair(numbers, [few, 0])
    context.place("checked_pair", pair)
    _moves_one(context, pair, 0, [few - 1, 1], possible=True)
    _moves_one(context, pair, 1, [few, 0], possible=True)
    for moved in range(1, few + 2):
        _moves_one(context, pair, 0, [max(few - moved, 0), min(moved, few)], possible=moved <= few)
    context.fulfilled(MOVED)
    counts = context.random.integers(2, 20, 40)
    pair = CheckedPair(numbers, counts, crowd=True)
    context.place("checked_pair", pair)
    context.run(
        "checked_cross",
        Its("move"),
        Its("checked_pair"),
        THREADS,
        MOVES,
        within=RUN,
        hints=ERRORS,
        worded="each call of move() in four threads",
    ).returned()
    context.require(
        "four threads at the same time: every call returns",
        holds=not pair.error,
        expected="all threads end",
        actual=pair.error,
        hints=[(matches("two threads wait"), CROSSED), *ERRORS],
    )
    context.expect(
        "four threads at the same time: the total number of things stays the same",
        expected=sum(counts),
        actual=sum(pair.counts),
        hints=UNLOCKED,
    )
    context.expect(
        "four threads at the same time: each call moves one thing",
        expected=THREADS * MOVES,
        actual=pair.results.count(True),
        hints=(
            "A call moved nothing, although the shelf was not empty. If another thread holds a lock, "
            "wait for the lock, and acquire the two locks in the order of their numbers."
        ),
    )
    _both_locks(context, pair)


def _moves_one(
    context: CheckContext, pair: CheckedPair, source: int, counts: list[int], *, possible: bool
) -> None:
    """Move a thing from the shelf with the index `source`.

    `counts` contains the right counts after the move.
    """
    its = Its("move"), Its("checked_pair")
    result = context.run(
        "checked_move", *its, source, 1 - source, hints=ERRORS, worded="move(source, target)"
    )
    context.expect(
        "move() returns True after a move, and False for an empty source",
        expected=possible,
        actual=result.returned(),
        hints=[
            (None, "The function returned None. Return True after a move, or False if the source is empty."),
            (
                (lambda actual: actual is False and possible),
                (
                    "The source was not empty, but the function returned False. Check the count of "
                    "`source`, not the count of `target`."
                ),
            ),
            (
                ANYTHING,
                (
                    "The returned value is wrong. Return True if the function moved a thing, and False "
                    "if the source was empty."
                ),
            ),
        ],
    )
    context.expect(
        "one thing moves from the source to the target",
        expected=counts,
        actual=pair.counts,
        hints=[
            (
                lambda actual: sum(actual) != sum(counts),
                (
                    "The total number of things changed. Subtract one from the source, and add one to "
                    "the target."
                ),
            ),
            (
                lambda actual: min(actual) < 0,
                ("The count of an empty shelf became negative. Check the count before you move a thing."),
            ),
            (
                ANYTHING,
                "The counts after the call are wrong. Move exactly one thing from `source` to `target`.",
            ),
        ],
    )
    context.require(
        "both locks are free after the call",
        holds=not pair.locked,
        expected="two free locks",
        actual="a lock that is still held",
        hints=(
            "The function returned, but a lock is still held. Use `with`, which releases the lock "
            "in every case."
        ),
    )
    _both_locks(context, pair)


def _both_locks(context: CheckContext, pair: CheckedPair) -> None:
    changes, reads = pair.changes, pair.reads
    context.require(
        "both locks are held while a count changes",
        holds=all(held == 2 for held in changes),
        expected="two locks",
        actual=f"locks held: {min(changes, default=0)}",
        hints=UNLOCKED,
    )
    context.require(
        "both locks are held while a count changes",
        holds=all(held == 2 for held in reads),
        expected="two locks while a count is read",
        actual=f"locks held: {min(reads, default=0)}",
        hints=UNLOCKED_READ,
    )
