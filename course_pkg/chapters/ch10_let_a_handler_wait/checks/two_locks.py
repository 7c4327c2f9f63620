"""10.6: a function that needs two locks; several threads call it at the same time."""

from __future__ import annotations

from course_pkg.chapters.ch10_let_a_handler_wait.checks.locked_shelves import KERNEL_CODE, CheckedPair
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part

THREADS, MOVES = 4, 6  # There are `THREADS` threads, and each thread makes `MOVES` moves.
RUN = 14.0  # This time limit in s for all threads is enough for three consecutive deadlocks and all moves.

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
NOTHING_MOVED = (
    "A call moved nothing, although the shelf was not empty. If another thread holds a lock, wait for the "
    "lock, and acquire the two locks in the order of their numbers."
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
        hints=[
            (matches("two threads wait"), CROSSED),
            (
                lambda error: "without success" in str(error) and pair.results.count(False) > 0,
                NOTHING_MOVED,
            ),
            *ERRORS,
        ],
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
        hints=NOTHING_MOVED,
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
