"""11.3: a service call over a plain socket."""

from __future__ import annotations

import ast
import sys
import textwrap

from course_pkg.chapters.ch11_look_inside.checks.client_calls import GEOMETRY
from course_pkg.chapters.ch11_look_inside.checks.tcpros_server import (
    LINGER,
    TIMEOUT,
    Conversation,
    TcprosServer,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.result import Result
from course_pkg.waiting import at_this_load, wait_until

# A float32 stores this fraction exactly, and the fraction has many decimals.
BINARY = 65 / 512
# On Linux, every address of 127.0.0.0/8 belongs to this computer. A client that always connects to localhost
# does not reach a server at OTHER_HOST.
OTHER_HOST = "127.0.0.2"
ROS_CLIENTS = {"ServiceProxy", "BoundedProxy", "TCPROSTransport", "rosservice", ".call", ".caller"}
NO_PROXY = (
    "The function calls the service with a proxy. Instead, connect a socket to the address, and send "
    "the bytes of the request."
)
WITHOUT_ROS = """
import subprocess

from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_service import ServiceProxy


def refuse(*_, **__):
    raise RuntimeError("only a socket may connect to the service")


FUNCTIONS = (TCPROSTransport.connect, ServiceProxy.call, subprocess.Popen.__init__)
CODE = [each.__code__ for each in FUNCTIONS]


def begin():
    for each in FUNCTIONS:
        each.__code__ = refuse.__code__


def end():
    for each, code in zip(FUNCTIONS, CODE):
        each.__code__ = code
"""  # During the check, a client of rospy or a program such as rosservice cannot call the service.
AS_BYTES = matches(r"\bb['\"]")
NO_HEADER = (
    "The header has to start with its length, in 4 bytes. Use `pack_header`, which writes this length."
)
NO_LENGTH = (
    "The request has to start with its length (12) in 4 bytes. Send the length before the three numbers."
)
MISTAKES = {
    "early request": (
        "Your function sent the request before the server had sent its header. First receive the header "
        'of the server, and check whether it contains the field "error".'
    ),
    "nothing": "The function connected, but sent nothing. First send the connection header of the client.",
    "big-endian header": NO_HEADER,
    "no length of the header": NO_HEADER,
    "short header": NO_HEADER,
    "no request": (
        "The header arrived, but no request followed. Send the request after you have "
        "read the header of the server."
    ),
    "big-endian length": "The length of the request is big-endian. Use '<I' for little-endian numbers.",
    "no length of the request": NO_LENGTH,
    "a request of 24 bytes": (
        "The request has 24 bytes, because it contains three float64 values. Use the format 'f' of "
        "struct, not 'd': a float32 has 4 bytes."
    ),
    "a request of 16 bytes": NO_LENGTH,
    "short request": NO_LENGTH,
}
ONLY_CALLERID = (
    "Your function read a field that the header of this server does not have. A server has to send only the "
    "field callerid, so read no other field than `error`."
)
SLOWLY = (
    "The function fails if the bytes arrive one after the other. Use `receive()` to read all bytes, "
    "including the first byte and the lengths."
)
NOT_DECODED = (
    "The error message contained letters that are not in ASCII, and your function could not decode "
    "them. Call decode() without an argument to use UTF-8."
)
NOT_TESTED = (
    "The byte for success was 0, but your code read the error message as numbers. Compare this byte with "
    "b'\\x00', because every bytes object that is not empty is true, even b'\\x00'."
)
CUT = (
    "The exception contains only the beginning of the error message, because its bytes arrived in several "
    "parts. Use `receive()` to read all bytes of the error message."
)
WITHOUT_BEGINNING = (
    "The beginning of the server's error message is missing. Raise the ServiceException with the whole error "
    "message."
)
BYTES = "The error message is a bytes object, not a string. Convert the bytes with decode()."
OPEN = (
    "The connection was still open after the call. Use the socket in a `with` block, which closes "
    "the socket at the end."
)
UNTIL_THE_END = (
    "The function read until the server closed the connection. Read the length N first (4 bytes), "
    "and then receive exactly N bytes."
)
IN_ORDER = (
    "The function did not read the parts of the response in the right order. After the server's "
    "header, read one byte for success, 4 bytes for the length N, and N bytes of data."
)
ANSWERED = "Return the whole response, even if its bytes arrive in several parts."


@part(
    "11.3",
    points=4,
    goal=(
        "Call a geometry service, and use only a socket. Raise ServiceException if the server refuses "
        "the call."
    ),
    needs=["ask"],
    deadline=40.0,
    goals={ANSWERED: 3, "Raise ServiceException if the server refuses the call.": 1},
)
def call_over_a_socket(context: CheckContext) -> None:
    """Call a server that responds immediately or byte by byte, or that refuses the connection or a call."""
    context.require(
        "the function uses only a socket",
        holds=not ROS_CLIENTS & _names(context.source("ask")),
        expected="a socket",
        actual="a call with a ROS client, such as rospy.ServiceProxy",
        hints=NO_PROXY,
    )
    context.prepare(WITHOUT_ROS)
    context.run("begin", worded="ask()")
    try:
        for slowly in (False, True):
            _answers(context, slowly=slowly)
        context.fulfilled(ANSWERED)
        reason = f"no {context.random.word()} in the café"
        _refuses(context, f"request from [/you]: {reason}", reason, in_handshake=True)
        _refuses(context, f"service cannot process request: {reason}", reason, in_handshake=False)
    finally:
        context.run("end", worded="ask()")


def _names(source: str) -> set[str]:
    """Return the names that the code of a function uses; comments and docstrings do not count.

    For an attribute, the result also contains the name with a dot before it, such as ".call".
    """
    try:
        nodes = list(ast.walk(ast.parse(textwrap.dedent(source))))
    # If the function is a lambda, its source can be a part of a line, which is not valid Python.
    except SyntaxError:
        return set()
    attributes = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    variables = {node.id for node in nodes if isinstance(node, ast.Name)}
    return variables | attributes | {f".{name}" for name in attributes}


def _wrong_numbers(area: float, volume: float) -> Hints:
    return [
        (None, NO_RETURN),
        (
            (lambda actual: isinstance(actual, dict)),
            (
                "The function returned a dict or a response. Return the two numbers as a tuple: (area, "
                "volume)."
            ),
        ),
        (
            (
                lambda actual: all(
                    abs(one - other) < 0.1 for one, other in zip(actual, (area, volume), strict=True)
                )
            ),
            "The returned numbers are rounded. Return the received numbers without a change.",
        ),
        (
            [volume, area],
            "The order of the numbers is wrong. Return the area first, and then the volume.",
        ),
        (
            (lambda actual: isinstance(actual[0], int)),
            "The function returned bytes. Convert the bytes into numbers with struct.unpack.",
        ),
        (
            ANYTHING,
            (
                "The returned numbers are wrong. After the byte for success, read 4 bytes for the "
                "length, and unpack area and volume with '<2f'."
            ),
        ),
    ]


def _answers(context: CheckContext, *, slowly: bool) -> None:
    name, kind = f"/{context.random.word()}", context.service_class(GEOMETRY)
    sides = context.random.numbers(3, 0.5, 9.0)
    area, volume = (number + BINARY for number in context.random.integers(2, 10, 90))
    host = OTHER_HOST if slowly and sys.platform == "linux" else "localhost"
    with TcprosServer(kind, (area, volume), slowly=slowly, host=host) as server:
        result = context.run(
            "ask", server.uri, name, *sides, within=10.0 if slowly else 5.0, hints=_errors(slowly)
        )
        conversation = _conversation_of(context, server, result, slowly)
    _sends_the_header(context, conversation, name, kind)
    context.expect(
        "the request contains length, width and height",
        expected=sides,
        actual=conversation.sides,
        near=1e-6,
        hints=(
            "The request is wrong. Send the three sides as float32, in the order of the definition: "
            "struct.pack('<3f', …)."
        ),
    )
    context.expect(
        "ask() returns area and volume" + (", even if the bytes arrive slowly" if slowly else ""),
        expected=[area, volume],
        actual=result.returned(),
        near=1e-6,
        hints=_wrong_numbers(area, volume),
    )
    context.require(
        "ask() returns area and volume",
        holds=not conversation.left_open,
        expected="a client that closes the connection after the response",
        actual=f"a connection that was still open {LINGER:g} s later",
        hints=UNTIL_THE_END if result.took > LINGER else OPEN,
    )


def _conversation_of(
    context: CheckContext, server: TcprosServer, result: Result, slowly: bool
) -> Conversation:
    context.require(
        "the function connects to the given address",
        holds=bool(server.conversations),
        expected="a connection",
        actual=result.error or "none",
        hints=[
            (lambda _: "only a socket may connect" in result.error, NO_PROXY),
            (
                ANYTHING,
                (
                    "The function connected to a wrong address. Read HOST and PORT from the argument "
                    "`uri`, which has the form rosrpc://HOST:PORT, and convert PORT to an int."
                ),
            ),
        ],
    )
    conversation = server.conversations[0]
    wait_until(lambda: conversation.over, TIMEOUT + LINGER + 1.0)
    context.require(
        "the function sends a TCPROS header and a TCPROS request",
        holds=conversation.mistake not in MISTAKES,
        expected="a connection header, and then a request",
        actual=conversation.mistake,
        hints=[
            (lambda _: slowly and result.error.startswith("KeyError"), ONLY_CALLERID),
            (ANYTHING, MISTAKES.get(conversation.mistake, "")),
        ],
    )
    return conversation


WRONG_MD5: Hints = [
    (
        "*",
        (
            'In the field `md5sum`, the value "*" matches every definition, even a wrong definition. '
            "Send the MD5 sum of your type."
        ),
    ),
    (
        "none",
        (
            "The field `md5sum` is missing in the header. Add this field, because the server compares it "
            "with the MD5 sum of its own type."
        ),
    ),
    (
        ANYTHING,
        "The field `md5sum` has to contain the MD5 sum of the whole service type. Use geometry._md5sum.",
    ),
]


def _sends_the_header(context: CheckContext, conversation: Conversation, name: str, kind: type) -> None:
    md5 = str(getattr(kind, "_md5sum", ""))
    context.expect(
        "the header contains the MD5 sum of the type",
        expected=md5,
        actual=conversation.header.get("md5sum", "none"),
        hints=WRONG_MD5,
    )
    context.expect(
        "the header contains the name of the service",
        expected=name,
        actual=conversation.header.get("service", "none"),
        hints=(
            "The field `service` is wrong. Set it to the name of the service, because one port can "
            "serve several services."
        ),
    )
    context.require(
        "the header contains the name of the caller",
        holds=bool(conversation.header.get("callerid")),
        expected="a field callerid",
        actual=", ".join(conversation.header),
        hints=(
            "The field `callerid` is missing in the header. Set this field to the name of the client, "
            "such as node.name."
        ),
    )


def _refuses(context: CheckContext, message: str, reason: str, *, in_handshake: bool) -> None:
    """Let the server refuse the call; assert that the error of the student's function contains `message`.

    The server sends the message in several pieces. `reason` is the end of the message.
    """
    name, kind = f"/{context.random.word()}", context.service_class(GEOMETRY)
    with TcprosServer(kind, (0.0, 0.0), refusal=message, in_handshake=in_handshake) as server:
        result = context.run(
            "ask", server.uri, name, *context.random.numbers(3, 0.5, 9.0), within=at_this_load(3.0)
        )
    hint = (
        ('The server\'s header contains the field "error". Check for this field before you send the request.')
        if in_handshake
        else (
            "The byte for success was 0, so an error message follows. Read this message, and raise "
            "a ServiceException with the same message."
        )
    )
    server_text = (
        "if the server refuses the connection" if in_handshake else "if the server refuses the request"
    )
    assertion = f"{server_text}, ask() raises a ServiceException with the server's error message"
    text = result.raised(
        assertion,
        "ServiceException",
        saying=reason,
        hints=[
            (matches("UnicodeDecodeError"), NOT_DECODED),
            (AS_BYTES, BYTES),
            (matches("unpack requires"), hint if in_handshake else NOT_TESTED),
            (lambda error: _is_cut(str(error), message), CUT),
            (
                matches("^ServiceException"),
                f"The exception does not contain the error message of the server. {hint}",
            ),
            (
                matches(f"^(?!TimesUp).*{reason}"),
                (
                    "The error message is right, but the exception has the wrong type. Raise a "
                    "rospy.ServiceException."
                ),
            ),
            (ANYTHING, hint),
        ],
    )
    context.require(
        assertion,
        holds=not AS_BYTES.search(text),
        expected=message,
        actual=text,
        hints=BYTES,
    )
    context.require(
        assertion,
        holds=message in text,
        expected=message,
        actual=text,
        hints=WITHOUT_BEGINNING,
    )


def _is_cut(error: str, message: str) -> bool:
    """Return whether the text of the exception is only the beginning of the server's message."""
    kind, _, text = error.partition(": ")
    return kind == "ServiceException" and bool(text) and message.startswith(text)


def _errors(slowly: bool) -> Hints:
    return [
        (
            matches("unpack|struct.error|^TimesUp|ConnectionError|timed out|IndexError"),
            SLOWLY if slowly else IN_ORDER,
        ),
    ]
