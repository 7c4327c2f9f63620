"""11.6: a client that stores the server's address."""

from __future__ import annotations

from course_pkg.chapters.ch11_look_inside.checks.client_calls import (
    AGAIN,
    GEOMETRY,
    reports_a_refusal,
    sends_the_sides,
)
from course_pkg.chapters.ch11_look_inside.checks.client_in_kernel import Client, ResettingPort
from course_pkg.checking import ANYTHING, CheckContext, Its, Refuse, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.scripted_server import Act, ScriptedServer

# TCP cannot connect to a multicast address, so connect() raises an OSError that is not a ConnectionError.
MULTICAST = "224.0.0.1"
STORED = "Look up the address once, and use the stored address for all calls."

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
UNREACHABLE = [
    (
        matches("OSError|unreachable|Errno"),
        (
            "The stored address was not reachable, and `ask()` raised an OSError that is not a "
            "ConnectionError. Catch every kind of OSError."
        ),
    )
]
AT_THE_OLD_ADDRESS = (
    "Your method called `ask()` several times with the old address. After the first OSError, look up the "
    "address again."
)
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
    sends_the_sides(context, client, server, "measure() returns area and volume")
    context.absent(name)
    _measures_both(context, client, "a call with a known address needs no master", numbers[1], LOST)
    _keeps_the_address(context, name, client, numbers[1])
    reports_a_refusal(context, client, server, *SAID_NO)
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
    _finds_it_after_another_error(context, numbers[1])


def _finds_it_after_a_reset(
    context: CheckContext, name: str, client: Client, former: ScriptedServer, numbers: list[float]
) -> None:
    """Start another program at the server's port, and start the server at another address.

    At the end, stop the server, and register another address, at which a program resets each connection.
    """
    former.leave()
    assertion = "the client finds a server that has a new address"
    with ResettingPort(former.uri) as old:
        last = context.serve(name, GEOMETRY, lambda _: dict(zip(("area", "volume"), numbers, strict=True)))
        _measures_both(context, client, assertion, numbers, RESET)
    context.require(
        assertion,
        holds=old.connections < 2,
        expected="one call of ask() with the old address",
        actual=f"calls of ask() with the old address: {old.connections}",
        hints=AT_THE_OLD_ADDRESS,
    )
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


def _finds_it_after_another_error(context: CheckContext, numbers: list[float]) -> None:
    """Register an address to which no program can connect, and then start the server."""
    name = f"/{context.random.word()}"
    context.absent(name, stale=True, host=MULTICAST)
    client = Client(context, "Remembering", name)
    client.measure(())  # This call fails. A client may look up the address already in its constructor.
    context.serve(name, GEOMETRY, lambda _: dict(zip(("area", "volume"), numbers, strict=True)))
    assertion = "the client finds a server that has a new address"
    _measures_both(context, client, assertion, numbers, UNREACHABLE)


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
