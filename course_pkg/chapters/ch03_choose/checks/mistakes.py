"""03.3: the mistake in the design in each of six reports."""

from __future__ import annotations

from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.cases import Cases, compare_cases

# The notebook describes the cases; this dict contains the mistake in each case.
RIGHT = {
    "A": "polls too rarely",
    "B": "polls too often",
    "C": "topic without latch",
    "D": "no regular messages",
    "E": "waits in the control loop",
    "F": "stream for one value",
}
DECISIVE = {
    "A": "The delay is as long as the pause between two calls.",
    "B": "Nearly all of the calls return nothing new.",
    "C": "The message was published before the tablet subscribed.",
    "D": "The subscriber cannot distinguish a broken sensor from a free road.",
    "E": "The thread that steers the robot cannot do anything else until the response comes.",
    "F": "Nearly all of the messages are received but not used.",
}
ENTRIES = {
    "polls too rarely": "A client that polls too rarely gets late responses, but it makes few calls.",
    "polls too often": "A client that polls too often makes a very large number of calls.",
    "topic without latch": "A missing latch affects a subscriber that starts after the last message.",
    "no regular messages": "Regular messages show a subscriber that the publisher still works.",
    "waits in the control loop": "A wait in a control loop blocks a program that has other work to do.",
    "stream for one value": (
        "If a node needs only one value, a stream sends many large messages that the node does not need."
    ),
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="A case is missing. The dict needs each letter from A to F as a key.",
    keys="The keys are the letters A to F, as strings with capital letters.",
    spelling="Copy the names exactly from the list of mistakes. Compare them letter by letter.",
    entry="mistake",
)


@part("03.3", points=2, goal="Find the design mistake in each of six reports.", needs=["mistakes"])
def find_the_mistake(context: CheckContext) -> None:
    """Compare the student's choice for each case with the right mistake."""
    compare_cases(context, "mistakes", CASES)
