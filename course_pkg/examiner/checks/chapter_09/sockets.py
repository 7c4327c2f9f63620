"""09.3: a call with nothing but a socket."""

from __future__ import annotations

import ast
import textwrap
from typing import Any

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.checks.chapter_09.clients import GEOMETRY
from course_pkg.examiner.checks.chapter_09.odd_server import PATIENCE, Heard, OddServer
from course_pkg.examiner.outcome import Outcome
from course_pkg.examiner.waiting import until

FOREIGN = {"ServiceProxy", "BoundedProxy", "TCPROSTransport", "rosservice", "call", "caller"}
SLIPS = {
    "nothing": "It connected, and said nothing. The client speaks first: send the connection header.",
    "big-endian header": "The length of the header is big-endian here. Use pack_header.",
    "no length of the header": "The header has to begin with its own length, 4 bytes. Use pack_header.",
    "short header": "The header ends before it is as long as it says.",
    "no request": "The header arrived, and no request. Send it once the server's header has been read.",
    "big-endian length": "The length of the request is big-endian. Least byte first: '<I'.",
    "no length of the request": "A request begins with its length, 4 bytes: 12, and then the three numbers.",
    "a request of 24 bytes": "24 bytes are three float64. A float32 has 4 bytes; for struct it is f, not d.",
    "a request of 16 bytes": "The length of the request counts what follows it: 12 bytes.",
    "short request": "The request ends before it is as long as it says.",
}


@part(
    "09.3",
    points=4,
    goal="Call a geometry service with nothing but a socket; say so if the server refuses.",
    needs=["ask"],
    deadline=20.0,
)
def a_call_by_socket(exam: Exam) -> None:
    """Answer at once, and then drop by drop; turn the client away; refuse."""
    exam.hold(
        "there is nothing but a socket",
        not FOREIGN & _names(exam.source("ask")),
        expected="a socket",
        seen="a call by ROS's own client",
        hints="Let no proxy do it for you: connect a socket to the address, and send the bytes.",
    )
    for drips in (False, True):
        _answered(exam, drips=drips)
    words = f"no {exam.draw.word()} today"
    _refused(exam, f"request from [/you]: {words}", words, turns_away=True)
    _refused(exam, f"service cannot process request: {words}", words, turns_away=False)


def _names(source: str) -> set[str]:
    """Return the names that the code of a function uses; what comments and docstrings name is no use."""
    try:
        nodes = list(ast.walk(ast.parse(textwrap.dedent(source))))
    except SyntaxError:  # a lambda in the middle of something
        return set()
    return {node.id for node in nodes if isinstance(node, ast.Name)} | {
        node.attr for node in nodes if isinstance(node, ast.Attribute)
    }


def _answered(exam: Exam, *, drips: bool) -> None:
    name, kind = f"/{exam.draw.word()}", exam.service_class(GEOMETRY)
    sides = exam.draw.numbers(3, 0.5, 9.0)
    area, volume = exam.draw.numbers(2, 10.0, 90.0)
    with OddServer(kind, (area, volume), drips=drips) as server:
        outcome = exam.run("ask", server.uri, name, *sides, within=4.0, hints=_errors(drips))
        heard = _conversation(exam, server, outcome)
    _greeted(exam, heard, name, kind)
    exam.expect(
        "the request holds length, width and height",
        expected=sides,
        seen=heard.sides,
        near=1e-6,
        hints="The three sides, as float32, in the order of the definition: struct.pack('<3f', …).",
    )
    exam.expect(
        "area and volume are returned" + (", however slowly the bytes come" if drips else ""),
        expected=[area, volume],
        seen=outcome.value,
        near=1e-6,
        hints=[
            (None, "Nothing was returned: a function without a return line gives None."),
            ((lambda seen: isinstance(seen, dict)), "Return the two numbers, as a tuple: (area, volume)."),
            ([volume, area], "That is the volume first. The definition has the area first."),
            (
                (lambda seen: isinstance(seen[0], int)),
                "Those are bytes. struct.unpack makes numbers of them.",
            ),
            (says(""), "Behind the ok byte stand 4 bytes of length, and then area and volume: '<2f'."),
        ],
    )


def _conversation(exam: Exam, server: OddServer, outcome: Outcome) -> Heard:
    exam.hold(
        "the address that was given is called",
        bool(server.heard),
        expected="a connection",
        seen=outcome.error or "none",
        hints="Host and port stand in the address, rosrpc://HOST:PORT. Connect to these.",
    )
    heard = server.heard[0]
    until(lambda: heard.over, PATIENCE + 1.0)
    exam.hold(
        "what is sent is TCPROS",
        heard.slip not in SLIPS,
        expected="a connection header, and then a request",
        seen=heard.slip,
        hints=SLIPS.get(heard.slip, ""),
    )
    return heard


def _greeted(exam: Exam, heard: Heard, name: str, kind: type) -> None:
    md5 = str(getattr(kind, "_md5sum", ""))
    exam.expect(
        "the header names the MD5 of the type",
        expected=md5,
        seen=heard.header.get("md5sum", "none"),
        hints={
            "*": "A star matches everything, also a definition whose numbers mean something else.",
            "none": "The field is called md5sum. Without it a server cannot know that both mean the same.",
            says(""): "That is of another type, or of a half: geometry._md5sum is that of the whole service.",
        },
    )
    exam.expect(
        "the header names the service",
        expected=name,
        seen=heard.header.get("service", "none"),
        hints="One port serves all services of a node. The field service says which of them is meant.",
    )
    exam.hold(
        "the header names the caller",
        bool(heard.header.get("callerid")),
        expected="a field callerid",
        seen=", ".join(heard.header),
        hints="A server wants to know who calls: the field callerid, such as node.name.",
    )


def _refused(exam: Exam, said: str, words: str, *, turns_away: bool) -> None:
    name, kind = f"/{exam.draw.word()}", exam.service_class(GEOMETRY)
    how = {"turns_away": said} if turns_away else {"refuses": said}
    with OddServer(kind, (0.0, 0.0), **how) as server:  # type: ignore[arg-type]
        outcome = exam.run("ask", server.uri, name, *exam.draw.numbers(3, 0.5, 9.0), within=3.0)
    hint = (
        "The server's header had a field error. Look for it before you send the request."
        if turns_away
        else "The ok byte was 0: what follows its length is no response, it is the reason, as text."
    )
    rule = "a server that turns the client away" if turns_away else "a server that refuses"
    outcome.raised(
        f"{rule} is a ServiceException with its words",
        "ServiceException",
        saying=words,
        hints={
            says("^ServiceException"): f"Put the server's own words into the error. {hint}",
            says(
                f"^(?!TimesUp).*{words}"
            ): "Those are its words. The error has to be a rospy.ServiceException.",
            says(""): hint,
        },
    )


def _errors(drips: bool) -> dict[Any, str]:
    slowly = (
        "The bytes came one at a time. Use receive for all of them, the ok byte and the lengths included."
    )
    return {
        says("unpack|struct.error|^TimesUp|ConnectionError|timed out|IndexError"): slowly
        if drips
        else "The reply is an ok byte, 4 bytes of length, and then so many bytes: read them in this order, "
        "behind the whole of the server's header.",
        says("gaierror|invalid literal|Name or service"): (
            "The address is rosrpc://HOST:PORT. Take host and port out of it, the port as a number."
        ),
    }
