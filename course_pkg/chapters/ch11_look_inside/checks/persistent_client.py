"""11.5: a client with a persistent connection."""

from __future__ import annotations

from course_pkg.chapters.ch11_look_inside.checks.client_calls import (
    AGAIN,
    ERRORS,
    GEOMETRY,
    reports_a_refusal,
    sends_the_sides,
)
from course_pkg.chapters.ch11_look_inside.checks.client_in_kernel import Client
from course_pkg.checking import ANYTHING, CheckContext, HangUp, Its, Refuse, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.scripted_server import Act, ScriptedServer
from course_pkg.ros.protocol.json_channel import Json

WAITED = (
    "Your method did not return after the server had ended. Repeat the call only once, and do not call "
    "wait_for_service."
)
FIRST_ERROR = (
    "The server refused the second call, but your method raised a different error. Raise the error of the "
    "second call, not the error of the first call."
)
NOT_MEASURED = "The second call also failed, so there is no response. Raise the error of the second call."
REFUSED = (
    "The server refused the call, but your method did not raise the proxy's exception. Do not catch this "
    "exception, or raise it again.",
    (
        "The server refused the call, but the connection works. Call the service again only if the "
        "connection broke."
    ),
)
SHARED = (
    "A second object of the class changed the proxy that the first object uses. Store the proxy in self, so "
    "that each object has its own proxy."
)
ONE_FOR_ALL = "Use one connection for all calls, even after a refused call."


@part(
    "11.5",
    points=3,
    goal=(
        "Use one connection for all calls. If the connection breaks, open a new connection and call "
        "the service once more."
    ),
    needs=["Keeper"],
    deadline=20.0,
    goals=[
        ONE_FOR_ALL,
        "Open a new connection when the old connection breaks or the server gets a new address.",
    ],
)
def persistent_client(context: CheckContext) -> None:
    """Let the server respond, refuse a call, close the connection, end, and start again at a new address."""
    name = f"/{context.random.word()}"
    volumes = context.random.numbers(8, 10.0, 90.0)
    acts: list[Act] = [{"volume": each} for each in volumes[:5]]
    server = context.serve(name, GEOMETRY, lambda _: _next_act(acts))
    client = Client(context, "Keeper", name)
    for volume in volumes[:3]:
        _measures(context, client, "measure() returns the response", volume)
    sends_the_sides(context, client, server, "measure() returns the response")
    _one_connection(context, server, "the calls share one connection")
    acts.insert(0, {"volume": volumes[7]})
    _shares_no_proxy(context, client, volumes[7])
    acts.insert(0, Refuse("not this box"))
    reports_a_refusal(context, client, server, *REFUSED)
    acts.pop(0)
    _measures(context, client, "after a refused call, the connection still works", volumes[3])
    _one_connection(context, server, "after a refused call, the client uses the same connection")
    context.fulfilled(ONE_FOR_ALL)
    acts.insert(0, HangUp())
    _measures(context, client, "the client replaces a broken connection", volumes[4])
    _breaks_twice(context, client, server)
    acts.append({"volume": volumes[6]})
    _measures(context, client, "the client replaces a broken connection", volumes[6])
    acts[:] = [HangUp(), Refuse("the second call failed")]
    client.measure(ERRORS).raised(
        "the client replaces a broken connection",
        "ServiceException",
        saying="the second call failed",
        hints=FIRST_ERROR,
    )
    acts.clear()
    server.leave()
    _reports_a_missing_server(context, client)
    moved = context.serve(name, GEOMETRY, lambda _: {"volume": volumes[5]})
    _measures(context, client, "the client finds a server that was started again", volumes[5])
    _measures(context, client, "the client finds a server that was started again", volumes[5])
    _one_connection(context, moved, "the client uses the new connection for all further calls")
    for broken in ("break_sending", "break_transport"):
        context.run(broken)
        _measures(context, client, "the client replaces a broken connection", volumes[5])


def _next_act(acts: list[Act]) -> Act:
    """Return the server's next action. A refusal stays in the list `acts` until the check removes it.

    If `acts` is empty, the server closes the connection.
    """
    if not acts:
        return HangUp()
    return acts[0] if isinstance(acts[0], Refuse) else acts.pop(0)


def _shares_no_proxy(context: CheckContext, client: Client, volume: Json) -> None:
    """Let a second object of the student's class call another service, and then call the first object."""
    name, sides = f"/{context.random.word()}", context.random.numbers(3, 0.5, 9.0)
    other = context.serve(name, GEOMETRY, lambda _: {"volume": 100.0})
    context.run("measured_by_another", Its("Keeper"), name, *sides)
    _measures(context, client, "measure() returns the response", volume, SHARED)
    other.leave()


OLD_RESPONSE = (
    "The server sent a different response to this call. Return the response to this call, even after a "
    "broken connection, and not a stored response."
)


def _measures(
    context: CheckContext, client: Client, assertion: str, volume: Json, different: str = OLD_RESPONSE
) -> None:
    """Assert that `measure` returns the volume; `different` is the hint for another response."""
    context.expect(
        assertion,
        expected={"volume": volume},
        actual=client.measure(ERRORS).returned(),
        near=1e-6,
        hints=[
            (None, "The method returned None. Return the response of the proxy."),
            (
                (lambda actual: not isinstance(actual, dict)),
                "The method returned only a part of the response. Return the whole response of the proxy.",
            ),
            (ANYTHING, different),
        ],
    )


SEVERAL_CONNECTIONS: Hints = [
    (
        (lambda words: "without" in words),
        (
            "The connection was not persistent. Create the proxy once with persistent=True, and store "
            "it in self."
        ),
    ),
    (
        ANYTHING,
        (
            "There was more than one connection. Create the proxy in `__init__`, and create a new "
            "proxy only after the connection broke: a refused call does not break the connection."
        ),
    ),
]


def _one_connection(context: CheckContext, server: ScriptedServer, assertion: str) -> None:
    seen = len(server.received.headers)
    kept = all(header.get("persistent") == "1" for header in server.received.headers)
    context.require(
        assertion,
        holds=seen == 1 and kept,
        expected="1 connection, opened with persistent=1",
        actual=f"{seen}, opened {'with' if kept else 'without'} persistent=1",
        hints=SEVERAL_CONNECTIONS,
    )


def _breaks_twice(context: CheckContext, client: Client, server: ScriptedServer) -> None:
    """Close the client's first connection, and then its new connection.

    The client must send the request again, and then raise an error.
    """
    before = len(server.requests)
    result = client.measure(ERRORS)
    asked = len(server.requests) - before
    context.require(
        "the client replaces a broken connection",
        holds=asked == 2 and bool(result.error) and not result.error.startswith("TimesUp"),
        expected="2 requests, and the error of the second connection",
        actual=f"{asked} requests, and {result.error or 'a value'}",
        hints=[
            ((lambda _: asked > 2), AGAIN),
            (
                (lambda _: asked < 2),
                "After the connection broke, your method did not send the request again. Store the new "
                "proxy in self, and call this proxy once.",
            ),
            (ANYTHING, NOT_MEASURED),
        ],
    )


def _reports_a_missing_server(context: CheckContext, client: Client) -> None:
    result = client.measure(())
    context.require(
        "without a server, the client raises an error",
        holds=bool(result.error),
        expected="a ServiceException",
        actual=result.error or "a value",
        hints=NOT_MEASURED,
    )
    context.require(
        "without a server, the client does not wait",
        holds=not result.error.startswith("TimesUp"),
        expected="an immediate error",
        actual=result.error,
        hints=WAITED,
    )
