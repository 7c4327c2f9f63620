"""The table of errors that a service call raises; the module `handler_errors` explains the columns."""

from __future__ import annotations

from course_pkg.ros.explain.handler_errors import Row

FROM_CALLS: tuple[Row, ...] = (
    (
        r"timeout exceeded while waiting for service",
        "No node provided this service before the timeout of wait_for_service() was over.",
        "Start the server, or compare the name of the service with the output of `rosservice list`.",
        "06",
    ),
    (
        r"timeout must be non-zero",
        "wait_for_service() needs a timeout above 0.",
        "Use a timeout of a few seconds, or omit wait_for_service() and catch the exception that the call "
        "raises.",
        "06",
    ),
    (
        r"service \[.{0,300}\] unavailable|(?i:unknown service)|Service \[.{0,300}\] is not available",
        "No node provides a service with this name: the server never started, has ended, or "
        "uses a different name.",
        "Start the server, or compare the name with the output of `rosservice list`. After a "
        "restart of the master, start the servers again.",
        "06",
    ),
    (
        r"md5sums do not match",
        "The client and the server were built from different definitions of the service.",
        "Build the client and the server with the same definition, and restart both. Compare "
        "the definitions with `rossrv md5`.",
        "04",
    ),
    (
        r"Unable to communicate with (?:service|node) \[|connection refused to \[|cannot ping",
        "A registered node does not answer. The node was killed and could not unregister, or "
        "its process is paused.",
        "Start the node again, or remove the stale registration with `rosnode cleanup`.",
        "12",
    ),
    (
        r"Connection refused",
        "The master still lists a server that does not run any more. The server was killed and "
        "could not unregister.",
        "Start the server again, or remove the stale registration with `rosnode cleanup`.",
        "12",
    ),
    (
        r"TransportTerminated|Broken pipe|has no attribute 'tell'",
        "The server of a persistent proxy has ended, and the proxy does not connect again.",
        "Close the proxy and create a new proxy, or create the proxy without persistent=True.",
        "11",
    ),
    (
        r"unable to receive data|transport error completing service call|Connection reset",
        "The server ended during the call.",
        ("Start the server again. Repeat the call only if the server can do the work twice without harm."),
        "12",
    ),
    (
        r"CallTimeout.{0,300}accepts connections, but sends nothing",
        "The server did not answer in time. The server's process is paused, or the server waits for "
        "data from a connection that sends no data.",
        (
            "If the server's process is paused, resume it with `kill -CONT`. Otherwise, start "
            "the server again."
        ),
        "12",
    ),
    (
        r"CallTimeout|TimesUp",
        "The server did not answer in time. The server's handler is slow, waits for something, "
        "or never returns.",
        "Find out what the handler waits for. Use a longer timeout only if you know that the work is slow.",
        "12",
    ),
    (
        r"CallCancelled",
        "You cancelled the call, but the server was not informed. The server's handler continues to its end.",
        "Find out what the handler waits for before you call again.",
        "12",
    ),
    (
        r"can be called with arguments or keywords, but not both|may only use args OR keywords",
        "The call passes some values by position, and other values by keyword.",
        "Pass all values in the same way: proxy(1, 2) or proxy(a=1, b=2).",
        "06",
    ),
    (
        r"Invalid number of arguments, args should be",
        "The number of values in the call differs from the number of fields in the request.",
        "Pass one value for each field, in the order of `rossrv show`, or pass the values by "
        "name: proxy(a=1, b=2).",
        "06",
    ),
    (
        r"Incompatible arguments to call service",
        "The arguments in the command line do not fit the fields of the request.",
        "Show the fields of the request with `rosservice args`, and press Tab to complete the request.",
        "08",
    ),
    (
        r"is not an attribute of \w+Request",
        "The call contains a field name that the request does not have. Usually, the name is misspelt.",
        "Compare the field names with the output of `rossrv show` for the service's type. The "
        "request is the part above ---.",
        "06",
    ),
    (
        r"is not an attribute of \w+",
        "The call contains a field name that the message does not have. Usually, the name is misspelt.",
        "Compare the field names with the output of `rossrv show` or `rosmsg show`.",
        "05",
    ),
    (
        r"SerializationError|must be an? .{0,300}(?:type|integer|float|string)|field \w+ is not a bool",
        "A value in the request has the wrong type for its field.",
        "Pass a value of the right type for each field.",
        "06",
    ),
)
