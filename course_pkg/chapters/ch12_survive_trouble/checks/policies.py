"""12.6: what a client should do after each of six errors."""

from __future__ import annotations

from course_pkg.checking import CheckContext, part
from course_pkg.checking.shared.cases import Cases, compare_cases

# The table in the notebook describes the situations; this dict contains the right policies.
RIGHT = {
    "refused": "report",
    "not started": "wait for the service",
    "md5": "report",
    "speed": "try again",
    "payment": "same id",
    "step": "look first",
}
DECISIVE = {
    "refused": "The server has refused the request. The next try would get the same refusal.",
    "not started": "The call did not reach a server, but the server will run in a few seconds.",
    "md5": "The two programs were built with different definitions. Another try does not change this.",
    "speed": "The request sets a state. The second request has the same effect as the first one.",
    "payment": "Perhaps the till has already taken the money, but it recognises a repeated request.",
    "step": (
        "Perhaps the robot has already moved, and a second request would move the robot again. A call of "
        "/where does not move the robot."
    ),
}
ENTRIES = {
    "report": 'The policy "report" leaves the work undone, although another try could do the work.',
    "wait for the service": 'The policy "wait for the service" helps only if no server is registered.',
    "try again": (
        'The policy "try again" fits only if a second execution does no harm, and if another try can succeed.'
    ),
    "same id": (
        'The policy "same id" helps only if the request has a field for an id, and if '
        "the server remembers the ids."
    ),
    "look first": (
        'The policy "look first" is needed only if a repetition would do harm, and if '
        "the client can read the state."
    ),
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="A situation is missing. Give a policy for each row of the table.",
    keys="The keys are the six names in the first column of the table, letter by letter.",
    spelling="Copy the names of the policies from the list, letter by letter.",
    entry="policy",
    case="situation",
    label="the situation {}",
    again="{}",
)


@part(
    "12.6", points=2, goal="Choose the right policy of a client after each of six errors.", needs=["policies"]
)
def choose_a_policy(context: CheckContext) -> None:
    """Compare the student's choice for each situation with the right policy."""
    compare_cases(context, "policies", CASES)
