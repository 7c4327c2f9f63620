"""11.5 and 11.6: a client with a persistent connection, and a client that stores the server's address."""

from __future__ import annotations

from course_pkg.chapters.ch11_look_inside.checks.client_in_kernel import Client, ResettingPort
from course_pkg.checking import ANYTHING, CheckContext, HangUp, Its, Refuse, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.scripted_server import Act, ScriptedServer
from course_pkg.ros.protocol.json_channel import Json

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
ONE_FOR_ALL = "Use one connection for all calls, even after a refused call."
STORED = "Look up the address once, and use the stored address for all calls."


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
    _sends_the_sides(context, client, server, "measure() returns the response")
    _one_connection(context, server, "the calls share one connection")
    acts.insert(0, Refuse("not this box"))
    _reports_a_refusal(context, client, server, *REFUSED)
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


def _measures(context: CheckContext, client: Client, assertion: str, volume: Json) -> None:
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
            (
                ANYTHING,
                (
                    "The server sent a different response to this call. Return the response to this call, "
                    "even after a broken connection, and not a stored response."
                ),
            ),
        ],
    )


def _sends_the_sides(context: CheckContext, client: Client, server: ScriptedServer, assertion: str) -> None:
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


def _reports_a_refusal(
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


LOST = [
    (
        matches("unknown service|no provider|Master|unavailable"),
        (
            "Your method looked up the address again, but the master no longer knows the service. "
            "Use the stored address."
        ),
    )
]
MOVED = [
    (
        matches("refused|OSError|Connection"),
        (
            "No server responds at the old address any more. Catch the OSError, look up the address "
            "again, and call `ask()` once more."
        ),
    )
]
RESET = [
    (
        matches("ConnectionReset|BrokenPipe|ConnectionError|OSError"),
        (
            "Another program uses this address now, so `ask()` raised a different kind of OSError. "
            "Catch every kind of OSError."
        ),
    )
]
SHARED = (
    "A second object of the class changed the server address that the first object uses. Store "
    "the address in self, so that each object has its own address."
)
SAID_NO = (
    (
        "The server refused the call, so the address was right. Raise the error, and look up the "
        "address again only after an OSError."
    ),
    (
        "Your method called `ask()` twice, although a server responded at the address. Call `ask()` "
        "again only after an OSError."
    ),
)


@part(
    "11.6",
    points=2,
    goal=(
        "Look up the address once, and store it. Look up the address again only if no server is at "
        "the stored address any more."
    ),
    needs=["Remembering"],
    deadline=20.0,
    goals=[STORED, "Look up the address again if no server is at the stored address any more."],
)
def client_with_a_known_address(context: CheckContext) -> None:
    """Call a service that runs, is not registered, refuses a call, or has a new address."""
    name = f"/{context.random.word()}"
    numbers = [context.random.numbers(2, 10.0, 90.0) for _ in range(3)]
    answers: list[Act] = [dict(zip(("area", "volume"), each, strict=True)) for each in numbers]
    acts = [answers[0], *[answers[1]] * 3, Refuse("not this box")]
    server = context.serve(name, GEOMETRY, lambda _: acts.pop(0) if acts[1:] else acts[0])
    client = Client(context, "Remembering", name)
    _measures_both(context, client, "measure() returns area and volume", numbers[0], ())
    _sends_the_sides(context, client, server, "measure() returns area and volume")
    context.absent(name)
    _measures_both(context, client, "a call with a known address needs no master", numbers[1], LOST)
    _keeps_the_address(context, name, client, numbers[1])
    _reports_a_refusal(context, client, server, *SAID_NO)
    context.fulfilled(STORED)
    server.leave()
    moved = context.serve(name, GEOMETRY, lambda _: answers[2])
    _measures_both(context, client, "the client finds a server that has a new address", numbers[2], MOVED)
    context.absent(name)
    kept = [
        (ANYTHING, "Store every address that you look up: the second address replaces the first address.")
    ]
    _measures_both(context, client, "the client also stores the new address", numbers[2], kept)
    _finds_it_after_a_reset(context, name, client, moved, numbers[0])


def _finds_it_after_a_reset(
    context: CheckContext, name: str, client: Client, former: ScriptedServer, numbers: list[float]
) -> None:
    """Start another program at the server's port, and start the server at another address.

    At the end, stop the server, and register another address, at which a program resets each connection.
    """
    former.leave()
    assertion = "the client finds a server that has a new address"
    with ResettingPort(former.uri):
        last = context.serve(name, GEOMETRY, lambda _: dict(zip(("area", "volume"), numbers, strict=True)))
        _measures_both(context, client, assertion, numbers, RESET)
    last.leave()
    with ResettingPort(context.absent(name, stale=True).uri) as port:
        result = client.measure(())
    context.require(
        assertion,
        holds=bool(result.error) and not result.error.startswith("TimesUp") and port.connections < 2,
        expected="an error after one more call of ask(), because no server is at the new address",
        actual=f"{result.error or 'a value'}; calls of ask() at the new address: {port.connections}",
        hints=[
            ((lambda _: result.error.startswith("TimesUp") or port.connections > 1), AGAIN),
            (ANYTHING, "The second call also failed. Raise the error of the second call."),
        ],
    )


def _keeps_the_address(context: CheckContext, name: str, client: Client, numbers: list[float]) -> None:
    """Register a second server for the same service.

    Only a client that looks up the address again calls the second server.
    """
    wrong = context.random.numbers(2, 100.0, 900.0)
    other = context.serve(name, GEOMETRY, lambda _: dict(zip(("area", "volume"), wrong, strict=True)))
    again = (
        "Your method looked up the address again, although the stored address was right. First use "
        "the stored address."
    )
    assertion = "a call with a known address needs no master"
    context.run("record_lookups")
    _measures_both(context, client, assertion, numbers, (), again)
    context.expect(assertion, expected=0, actual=len(context.read("lookups", list)), hints=again)
    sides = context.random.numbers(3, 0.5, 9.0)
    context.run("measured_by_another", Its("Remembering"), name, *sides)
    _measures_both(context, client, assertion, numbers, (), SHARED)
    other.leave()


def _measures_both(
    context: CheckContext,
    client: Client,
    assertion: str,
    numbers: list[float],
    hints: Hints,
    other: str = (
        "Your method did not return the numbers that `ask()` returned. Return both numbers without a change."
    ),
) -> None:
    context.expect(
        assertion,
        expected=numbers,
        actual=client.measure(hints).returned(),
        near=1e-6,
        hints=[(None, "The method returned None. Return the tuple that `ask()` returns."), (ANYTHING, other)],
    )
