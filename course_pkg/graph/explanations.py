"""What rospy's words mean, and what to do about them; for panels and checks, so it needs no rospy itself.

A row matches on the part of a message that is the same in every release; the first row that matches counts.
"""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Explanation:
    """The cause of an error and the next step, in plain words."""

    cause: str
    remedy: str


_TABLE: tuple[tuple[str, str, str], ...] = (
    (
        r"service handler returned None",
        "The handler reached its end without a return, or returned None.",
        "Return a response from the handler, also when its response has no fields: MyServiceResponse().",
    ),
    (
        r"handler returned invalid value",
        "What the handler returned cannot be made into a response: it has not one value for each field.",
        "Return a response object, or a tuple, list or dict with one value for each field of the response.",
    ),
    (
        r"handler returned wrong number of values",
        "The handler returned a list or tuple whose length is not the number of fields in the response.",
        "Return one value for each field. A single array field needs a list inside a list: [[1, 2, 3]].",
    ),
    (
        r"is not an attribute of \w+",
        "A field was named that the message does not have, most often a typing slip.",
        "Compare the names with `rossrv show` for the service's type.",
    ),
    (
        r"error processing request: field .+ (?:is not|must be)|error processing request: .*argument",
        "The handler takes the wrong arguments, or a value in its response has the wrong type for its field.",
        "A handler takes one argument, the request; convert each value it returns to the type of its field.",
    ),
    (
        r"error processing request",
        "The handler raised an exception. Its message stands above, the traceback in the server's output.",
        "Read the server's output and mend the handler, or have it refuse the request on purpose.",
    ),
    (
        r"service cannot process request",
        "The handler refused this request on purpose, by raising ServiceException.",
        "Read the reason above and send a request that the service accepts.",
    ),
    (
        r"responded with an error: b''",
        "The server refused the request and gave no reason; nodes written in C++ do so.",
        "Look for the reason in the server's own output.",
    ),
    (
        r"service \[.*\] unavailable",
        "The master knows no provider of this name: it never started, has ended, or uses another name.",
        "Start the server, or look the name up with `rosservice list`.",
    ),
    (
        r"md5sums do not match",
        "Client and server were built from different definitions of the service.",
        "Use one definition on both sides: rebuild, restart both, and compare with `rossrv md5`.",
    ),
    (
        r"Connection refused",
        "The master still lists a server that is no longer there: it was killed and could not sign off.",
        "Start the server again, or remove the stale entry with `rosnode cleanup`.",
    ),
    (
        r"unable to receive data|transport error completing service call|Connection reset",
        "The server went away while the call was under way.",
        "Start the server again and repeat the call, if it is safe to do the same work twice.",
    ),
    (
        r"Name or service not known|Temporary failure in name resolution",
        "The server registered under a host name that this machine cannot look up.",
        "Start the server with ROS_HOSTNAME=localhost.",
    ),
    (
        r"unable to contact master|MasterUnreachable|master .*(?:not answer|unreachable)",
        "No master answers at ROS_MASTER_URI.",
        "Start a master, or correct ROS_MASTER_URI, and start the nodes again.",
    ),
    (
        r"CallTimeout",
        "The server did not answer in time: its handler is slow, waits for something, or never returns.",
        "Look at what the handler waits for. Allow more seconds only if the work is known to be slow.",
    ),
    (
        r"CallCancelled",
        "You ended the wait. The server does not hear of that: its handler runs on to its end.",
        "Look at what the handler waits for before calling again.",
    ),
    (
        r"SerializationError|must be an? .*(?:type|integer|float|string)",
        "A value in the request has the wrong type for its field.",
        "Give each field a value of its own type.",
    ),
)


def explain(words: str) -> Explanation | None:
    """Return the explanation of an error given as `TypeName: message`, None for one not in the table."""
    for pattern, cause, remedy in _TABLE:
        if re.search(pattern, words, re.DOTALL):
            return Explanation(cause, remedy)
    return None
