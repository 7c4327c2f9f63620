"""10.7: six observations of waiting threads, and the cause of each observation."""

from __future__ import annotations

from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.cases import Cases, compare_cases

# The notebook describes the observations of each case; this dict contains the causes.
RIGHT = {
    "A": "lock across a call",
    "B": "lock order",
    "C": "no limit",
    "D": "race",
    "E": "no notify",
    "F": "no loop",
}
DECISIVE = {
    "A": (
        "There is a circle of waiting threads: the last thread waits for a lock that the first thread "
        "holds. For each thread, find the lock that it holds and the lock for which it waits."
    ),
    "B": "Each of the two threads holds the lock of one shelf and waits for the lock of the other shelf.",
    "C": "The clients have ended, but the number of waiting threads still grows.",
    "D": "No thread waits, and no call fails. Only the returned numbers are wrong.",
    "E": "The item came after two seconds, but the handler returned only when its time limit was over.",
    "F": "Only one item came, but several threads woke up, and each of them took an item.",
}
ENTRIES = {
    "lock across a call": (
        'The cause "lock across a call" means that a handler holds a lock while it calls a service. '
        "This service needs the same lock."
    ),
    "lock order": (
        'The cause "lock order" means that two threads acquire the same two locks in opposite orders.'
    ),
    "no limit": 'The cause "no limit" means that a wait never ends, even after the client has ended.',
    "race": "In a race, no thread waits, but the data is wrong.",
    "no notify": 'The cause "no notify" means that a thread sleeps although an item is there.',
    "no loop": (
        'The cause "no loop" means that a thread continues after it has woken up, even if no item is there.'
    ),
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="The answer for a case is missing. Give a cause for each letter from A to F.",
    keys="The keys of the dict are wrong. Use the letters A to F, as strings with capital letters.",
    spelling="A cause has a wrong name. Copy the names from the list of causes, letter by letter.",
)


@part("10.7", points=2, goal="Find the cause of each of the six observations.", needs=["causes"])
def find_the_cause(context: CheckContext) -> None:
    """Compare the student's choice for each case with the right cause."""
    compare_cases(context, "causes", CASES)
