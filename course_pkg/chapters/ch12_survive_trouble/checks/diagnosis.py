"""12.5: find the cause of each of seven symptoms."""

from __future__ import annotations

from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.cases import Cases, compare_cases

# The table in the notebook describes the symptoms; this dict contains the causes.
RIGHT = {
    "A": "killed",
    "B": "new master",
    "C": "frozen",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}
DECISIVE = {
    "A": "The master has an address for the name, but no process accepts connections at this address.",
    "B": "The open connections continue to work. Only the lookup of the name fails.",
    "C": "No service of this node responds, not even get_loggers.",
    "D": (
        "The service get_loggers responds, so the process runs. The handlers of the other two services "
        "wait for the same object."
    ),
    "E": "Two handlers read the same number at the same time, but no call failed.",
    "F": "The server did the work of the first call, but the response to this call was lost.",
    "G": "Both servers work, but the master stores only the newest provider of a name.",
}
ENTRIES = {
    "killed": 'The diagnosis "killed" means that the server accepts no connections.',
    "new master": 'The diagnosis "new master" means that the master knows no provider, so each lookup fails.',
    "frozen": 'The diagnosis "frozen" means that no service of the process responds.',
    "lock": (
        'The diagnosis "lock" means that one handler holds a lock, so other handlers have to wait for '
        "this lock."
    ),
    "race": 'The diagnosis "race" means that the data is wrong, but no client has to wait.',
    "repeated": 'The diagnosis "repeated" means that the server did the same work twice.',
    "two providers": (
        'The diagnosis "two providers" means that two servers offer one service, and only one server '
        "gets calls."
    ),
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="The answer for a case is missing. Give a cause for each letter from A to G.",
    keys="The keys of the dict are wrong. Use the letters A to G, as strings with capital letters.",
    spelling="A cause has a wrong name. Copy the names from the list of causes, letter by letter.",
    entry="diagnosis",
    listed="the causes",
)


@part("12.5", points=2, goal="Find the cause of each of the seven problems.", needs=["diagnosis"])
def diagnose(context: CheckContext) -> None:
    """Compare the student's choice for each case with the right cause."""
    compare_cases(context, "diagnosis", CASES)
