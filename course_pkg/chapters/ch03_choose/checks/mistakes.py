"""03.3: find the design mistake in each of six reports."""

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
    "A": "The delay of a greeting can be as long as the pause between two calls.",
    "B": "Nearly all calls return no new data.",
    "C": "The message was published before the tablet subscribed.",
    "D": "The subscriber sees no difference between a broken sensor and a free road.",
    "E": "While the robot's control thread waits for the response, this thread cannot do anything else.",
    "F": "The node receives many messages, but it uses almost none of them.",
}
ENTRIES = {
    "polls too rarely": "A client that polls too rarely makes few calls, but it notices changes late.",
    "polls too often": "A client that polls too often makes a very large number of calls.",
    "topic without latch": "Without a latch, a subscriber that starts late does not get the last message.",
    "no regular messages": "With regular messages, a subscriber can see that the publisher still works.",
    "waits in the control loop": "A program that waits in its control loop cannot do its other work.",
    "stream for one value": (
        "If a node needs only one value, it does not need a stream of many large messages."
    ),
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="A case from the table is missing in your dict. Write each letter from A to F as a key.",
    keys="Some keys are wrong. Use the letters A to F as keys: strings with capital letters.",
    spelling="The name of a mistake is wrong. Copy each name exactly from the list of mistakes.",
    entry="mistake",
)


@part("03.3", points=2, goal="Find the design mistake in each of six reports.", needs=["mistakes"])
def find_the_mistake(context: CheckContext) -> None:
    """Check that the student found the design mistake in each case; `RIGHT` contains these mistakes."""
    compare_cases(context, "mistakes", CASES)
