"""The table of errors that a service call raises; `handler_errors` explains the columns."""

from __future__ import annotations

from course_pkg.ros.explain.handler_errors import Row

FROM_CALLS: tuple[Row, ...] = (
    (
        r"timeout exceeded while waiting for service",
        "No node provided this service before the timeout of wait_for_service().",
        "Start the server, or compare the name with `rosservice list`.",
        "06",
    ),
    (
        r"timeout must be non-zero",
        "wait_for_service() needs a timeout above 0.",
        "Give a timeout of some seconds, or omit wait_for_service() and catch the exception of the call.",
        "06",
    ),
    (
        r"service \[.{0,300}\] unavailable|(?i:unknown service)|Service \[.{0,300}\] is not available",
        "No node provides a service of this name: the server never started, has ended, or uses another name.",
        "Start the server, or compare the name with `rosservice list`. After a restart of the master, start "
        "the servers again.",
        "06",
    ),
    (
        r"md5sums do not match",
        "Client and server were built from different definitions of the service.",
        "Build and restart the client and the server with one definition. Compare both with `rossrv md5`.",
        "04",
    ),
    (
        r"Unable to communicate with (?:service|node) \[|connection refused to \[|cannot ping",
        "A registered node does not answer: it was killed and could not unregister, or it is stopped.",
        "Start the node again, or remove the stale registration with `rosnode cleanup`.",
        "12",
    ),
    (
        r"Connection refused",
        "The master still lists a server that does not run any more: it was killed and could not unregister.",
        "Start the server again, or remove the stale registration with `rosnode cleanup`.",
        "12",
    ),
    (
        r"TransportTerminated|Broken pipe|has no attribute 'tell'",
        "A persistent proxy keeps its connection to a server that has ended, and does not reconnect.",
        "Close the proxy, create a new one and call again, or call without persistent=True.",
        "11",
    ),
    (
        r"unable to receive data|transport error completing service call|Connection reset",
        "The server ended during the call.",
        (
            "Start the server again. Repeat the call only if it does no harm when the server does the "
            "work twice."
        ),
        "12",
    ),
    (
        r"CallTimeout.{0,300}accepts connections, but sends nothing",
        "The server did not answer in time: it is stopped, or blocked by a connection that sends nothing.",
        (
            "If the server's process is stopped, resume it with `kill -CONT`. Otherwise start the "
            "server again."
        ),
        "12",
    ),
    (
        r"CallTimeout|TimesUp",
        "The server did not answer in time: its handler is slow, waits for something, or never returns.",
        "Find out what the handler waits for. Allow more seconds only if you know that the work is slow.",
        "12",
    ),
    (
        r"CallCancelled",
        "You cancelled the call. The server does not know this, so its handler continues to its end.",
        "Find out what the handler waits for before you call again.",
        "12",
    ),
    (
        r"can be called with arguments or keywords, but not both|may only use args OR keywords",
        "The call mixes values by position and by keyword.",
        "Give all values in the same way: proxy(1, 2) or proxy(a=1, b=2).",
        "06",
    ),
    (
        r"Invalid number of arguments, args should be",
        "The number of values in the call differs from the number of fields in the request.",
        "Give one value for each field, in the order of `rossrv show`, or name them: proxy(a=1, b=2).",
        "06",
    ),
    (
        r"Incompatible arguments to call service",
        "The arguments on the command line do not fit the request of the service.",
        "Show its fields with `rosservice args`, and press Tab to complete the request.",
        "08",
    ),
    (
        r"is not an attribute of \w+Request",
        "The call names a field that the request does not have. Usually the name is misspelt.",
        "Compare the names with the part above --- that `rossrv show` prints for the service's type.",
        "06",
    ),
    (
        r"is not an attribute of \w+",
        "The call names a field that the message does not have. Usually the name is misspelt.",
        "Compare the names with `rossrv show` or `rosmsg show`.",
        "05",
    ),
    (
        r"SerializationError|must be an? .{0,300}(?:type|integer|float|string)|field \w+ is not a bool",
        "A value in the request has the wrong type for its field.",
        "Give each field a value of the right type.",
        "06",
    ),
)
