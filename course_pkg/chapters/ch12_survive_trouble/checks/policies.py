"""12.6: choose what a client should do after each of six errors."""

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
    "refused": (
        "The server has refused the request. If the client sends the same request again, the server "
        "refuses it again."
    ),
    "not started": "No server got the call, but the server will run in a few seconds.",
    "md5": (
        "The two programs were built with different definitions. A second call does not change the "
        "definitions."
    ),
    "speed": (
        "The request sets a state, such as a speed, so the same request changes nothing if it is sent again."
    ),
    "payment": "Perhaps the till has already taken the money. The till recognises a repeated request.",
    "step": (
        "Perhaps the robot has already moved, and a second request moves it again. A call of /where "
        "does not move the robot."
    ),
}
ENTRIES = {
    "report": (
        'With the policy "report", the client does not repeat the call, although a second call can succeed.'
    ),
    "wait for the service": 'The policy "wait for the service" helps only if no server is registered.',
    "try again": (
        'The policy "try again" is right only if a second call can succeed, and if doing the work '
        "twice does no harm."
    ),
    "same id": (
        'The policy "same id" helps only if the request has a field for an id, and if the server '
        "stores the ids."
    ),
    "look first": (
        'The policy "look first" is right only if a repetition does harm, and if the client can '
        "read the state."
    ),
}
CASES = Cases(
    RIGHT,
    DECISIVE,
    ENTRIES,
    missing="The answer for a situation is missing. Give a policy for each row of the table.",
    keys=("The keys of the dict are wrong. Copy the six names exactly from the first column of the table."),
    spelling="A policy has a wrong name. Copy the names of the policies from the list, letter by letter.",
    entry="policy",
    case="situation",
    label="the situation {}",
    again="{}",
)


@part(
    "12.6",
    points=2,
    goal="For each of the six errors, choose the right policy for the client.",
    needs=["policies"],
)
def choose_a_policy(context: CheckContext) -> None:
    """Compare the student's choice for each situation with the right policy."""
    compare_cases(context, "policies", CASES)
