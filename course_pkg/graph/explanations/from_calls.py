"""What a client is told when the call itself goes wrong; rows as in from_handlers."""

from __future__ import annotations

from course_pkg.graph.explanations.from_handlers import Row

FROM_CALLS: tuple[Row, ...] = (
    (
        r"timeout exceeded while waiting for service",
        "Nobody has begun to serve this name within the time that wait_for_service() was given.",
        "Start the server, or compare the name with `rosservice list`.",
        "06",
    ),
    (
        r"timeout must be non-zero",
        "wait_for_service() takes a time above 0; a wait of no time is no wait.",
        "Give it some seconds, or leave the wait out and catch the exception of the call.",
        "06",
    ),
    (
        r"service \[.{0,300}\] unavailable|(?i:unknown service)|Service \[.{0,300}\] is not available",
        "The master knows no provider of this name: it never started, has ended, or uses another name.",
        "Start the server, or look the name up with `rosservice list`. After a restart of the master, start "
        "the servers again.",
        "06",
    ),
    (
        r"md5sums do not match",
        "Client and server were built from different definitions of the service.",
        "Use one definition on both sides: rebuild, restart both, and compare with `rossrv md5`.",
        "04",
    ),
    (
        r"Unable to communicate with (?:service|node) \[|connection refused to \[|cannot ping",
        "A node is registered that does not answer: it was killed and could not sign off, or it is stopped.",
        "Start it again, or remove the stale entry with `rosnode cleanup`.",
        "10",
    ),
    (
        r"Connection refused",
        "The master still lists a server that is no longer there: it was killed and could not sign off.",
        "Start the server again, or remove the stale entry with `rosnode cleanup`.",
        "10",
    ),
    (
        r"TransportTerminated|Broken pipe|has no attribute 'tell'",
        "A persistent proxy keeps the connection to a server that has gone, and does not connect again.",
        "Close the proxy, make a new one and call again; or call without persistent=True.",
        "09",
    ),
    (
        r"unable to receive data|transport error completing service call|Connection reset",
        "The server went away while the call was under way.",
        "Start the server again and repeat the call, if it is safe to do the same work twice.",
        "10",
    ),
    (
        r"CallTimeout.{0,300}takes connections and does not speak",
        "The server did not answer in time: it is stopped, or busy with a connection that says nothing.",
        "Look at its process: `kill -CONT` lets a stopped one go on. Otherwise start the server again.",
        "10",
    ),
    (
        r"CallTimeout|TimesUp",
        "The server did not answer in time: its handler is slow, waits for something, or never returns.",
        "Look at what the handler waits for. Allow more seconds only if the work is known to be slow.",
        "10",
    ),
    (
        r"CallCancelled",
        "You ended the wait. The server does not hear of that: its handler runs on to its end.",
        "Look at what the handler waits for before calling again.",
        "10",
    ),
    (
        r"can be called with arguments or keywords, but not both|may only use args OR keywords",
        "Values were given by position and by keyword in one call.",
        "Give all of them in one way: proxy(1, 2) or proxy(a=1, b=2).",
        "06",
    ),
    (
        r"Invalid number of arguments, args should be",
        "The request has fewer or more fields than the call gives values by position.",
        "Give one value for each field, in the order of `rossrv show`, or name them: proxy(a=1, b=2).",
        "06",
    ),
    (
        r"Incompatible arguments to call service",
        "What was given on the command line does not fit the request of the service.",
        "Look at its fields with `rosservice args`, and let Tab write the request.",
        "07",
    ),
    (
        r"is not an attribute of \w+Request",
        "A field was named that the request does not have, most often a typing slip.",
        "Compare the names with the part above --- that `rossrv show` prints for the service's type.",
        "06",
    ),
    (
        r"is not an attribute of \w+",
        "A field was named that the message does not have, most often a typing slip.",
        "Compare the names with `rossrv show` or `rosmsg show`.",
        "05",
    ),
    (
        r"SerializationError|must be an? .{0,300}(?:type|integer|float|string)|field \w+ is not a bool",
        "A value in the request has the wrong type for its field.",
        "Give each field a value of its own type.",
        "06",
    ),
)
