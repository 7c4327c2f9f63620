"""The table of errors that a client gets because of a failed handler or a wrong declaration of the service.

Each row is (pattern, cause, remedy, chapter). A pattern matches words of the error message that are the same
in every release of ROS. The first row that matches is used.
"""

from __future__ import annotations

Row = tuple[str, str, str, str]

FROM_HANDLERS: tuple[Row, ...] = (
    (
        r"service handler returned None",
        "The handler reached its end without a return, or returned None.",
        "Return a response from the handler, even if the response has no fields: MyServiceResponse().",
        "05",
    ),
    (
        r"service cannot process request: .{0,300}is not an attribute of \w+",
        "The handler uses a field name that the response does not have. Usually, the name is misspelt.",
        "Compare the field names with the output of `rossrv show` for the service's type. The "
        "response is the part below ---.",
        "05",
    ),
    (
        r"handler returned invalid value",
        "rospy cannot create a response from the returned value: the value does not have one "
        "item for each field.",
        "Return a response object, or a tuple, list or dict with one value for each field of the response.",
        "05",
    ),
    (
        r"handler returned wrong number of values",
        "The handler returned a list or tuple of the wrong length. The length has to be the "
        "number of fields in the response.",
        "Return one value for each field. A single array field needs a list inside a list: [[1, 2, 3]].",
        "05",
    ),
    (
        r"[Ee]rror processing request: field .{1,300} (?:is not|must be)",
        "A value in the handler's response has the wrong type for its field.",
        "In the handler, convert each value to the type of its field, for example with bool(…) or float(…). "
        "Then return the values.",
        "05",
    ),
    (
        r"[Ee]rror processing request: .{0,300}(?:positional argument|argument.{0,300} given)",
        "The handler has the wrong parameters: rospy calls the handler with one argument, the request.",
        "Write the handler as a function of one argument: def handle(request).",
        "05",
    ),
    (
        r"[Ee]rror processing request",
        "The handler raised an exception. The traceback is in the terminal of the server, or "
        "below the server's cell.",
        "Find the line in the traceback and correct this line. To refuse a request, raise "
        "rospy.ServiceException.",
        "05",
    ),
    (
        r"service cannot process request: handler ended with (?:SystemExit|KeyboardInterrupt)",
        "The handler called sys.exit() or was interrupted, so it returned no response.",
        (
            "Return a response or raise ServiceException. In a program without the course's tools, the "
            "client waits forever."
        ),
        "05",
    ),
    (
        r"service cannot process request",
        "The handler raised ServiceException to refuse this request.",
        "Read the reason in the error message, and send a request that the service accepts.",
        "05",
    ),
    (
        r"responded with an error: b''",
        "The server refused the request without a reason. For example, a handler in C++ returned false.",
        "Look for the reason in the server's output.",
        "05",
    ),
    (
        r"has no attribute '_request_class'|is the (?:request|response) of a service type",
        "The class of the request or of the response was used instead of the type of the service.",
        "Use the type of the service, for example SetBool instead of SetBoolRequest or SetBoolResponse.",
        "05",
    ),
    (
        r"service \[[^\]]{0,300}\] already registered",
        "This program already provides a service with this name, and the old handler still answers.",
        "Call shutdown() on the old service before you create the service again.",
        "05",
    ),
)
