"""12.5: the cause of each of seven symptoms."""

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
    "A": "the master has an address for the name, but no process accepts connections at this address.",
    "B": "open connections to the server work; only the lookup of the name fails.",
    "C": "no service of this node responds, not even get_loggers.",
    "D": (
        "get_loggers responds, so the process runs. The two services without a response wait for the "
        "same object."
    ),
    "E": "two handlers read the same number at the same time, but no call failed.",
    "F": "the server did the work of the first try; only the response was lost.",
    "G": "both servers work, but the master stores only the newest provider of a name.",
}
ENTRIES = {
    "killed": "A killed server accepts no connections.",
    "new master": "A new master does not know any provider, so each lookup fails.",
    "frozen": "In a frozen process, no service responds.",
    "lock": "If a handler holds a lock during a call, other clients have to wait.",
    "race": "A race makes the data wrong, but no client has to wait.",
    "repeated": "A repeated request does the same work twice.",
    "two providers": "If a service has two providers, only one of them gets all calls, and it responds.",
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="A case is missing. Give a cause for each letter from A to G.",
    keys="The keys are the letters A to G, as strings with capital letters.",
    spelling="Copy the names from the list of causes, letter by letter.",
    entry="diagnosis",
    listed="the causes",
)


@part("12.5", points=2, goal="Find the cause of each of seven problems.", needs=["diagnosis"])
def diagnose(context: CheckContext) -> None:
    """Compare the student's choice for each case with the right cause."""
    compare_cases(context, "diagnosis", CASES)
