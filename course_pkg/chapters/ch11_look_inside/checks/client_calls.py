"""Assertions about the calls of a client class; the checks of several client classes use them."""

from __future__ import annotations

from course_pkg.chapters.ch11_look_inside.checks.client_in_kernel import Client
from course_pkg.checking import CheckContext, matches
from course_pkg.checking.peers.scripted_server import ScriptedServer

GEOMETRY = "course_pkg/geometry"
ERRORS = [
    (
        matches("TransportTerminated|TransportInitError|AttributeError"),
        (
            "A broken connection can raise three kinds of errors, but your method does not catch all of "
            "them. Catch all three kinds, create a new proxy, and call the service once more."
        ),
    ),
    (
        matches("transport error"),
        (
            "The connection broke, and your method raised the error. Catch the error, create a new "
            "proxy, and call the service once more."
        ),
    ),
]

AGAIN = (
    "Your method called the service again and again. After an error, call the service only once "
    "more, and raise the error of the second call."
)


def sends_the_sides(context: CheckContext, client: Client, server: ScriptedServer, assertion: str) -> None:
    """Assert that the last request contains the sides with which `measure` was called."""
    context.expect(
        assertion,
        expected=client.sides,
        actual=[server.requests[-1][side] for side in ("length", "width", "height")],
        near=1e-6,
        hints=(
            "The sides in the request are wrong. Pass the arguments length, width and height to the call "
            "in this order."
        ),
    )


def reports_a_refusal(
    context: CheckContext, client: Client, server: ScriptedServer, swallowed: str, repeated: str
) -> None:
    """Assert that a refused call raises an error, and that the client does not repeat the call.

    `swallowed` is the hint if no error is raised, and `repeated` is the hint if the call is repeated.
    """
    before = len(server.requests)
    client.measure(ERRORS).raised(
        "if the server refuses a call, the client raises the error",
        "ServiceException",
        saying="not this box",
        hints=swallowed,
    )
    context.expect(
        "after a refused call, the client does not repeat the call",
        expected=1,
        actual=len(server.requests) - before,
        hints=repeated,
    )
