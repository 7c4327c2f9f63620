"""08.1: find all services on the graph that have a given type."""

from __future__ import annotations

from collections.abc import Set

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.plain_values import of_kind
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.types import compile_service

KINDS = ("std_srvs/Trigger", "std_srvs/SetBool", "course_pkg/AddTwoInts", "course_pkg/geometry")
DEAD = (
    "Your list contains a service whose server has ended. Catch "
    "rosservice.ROSServiceIOException inside the loop, and continue with the next service."
)
NONE = (
    "Your function found no service. Get the list of services in each call of the function, and compare "
    "`kind` with the whole string that get_service_type returns."
)
SOME = (
    "Your function found only some of the services. Check all services of the list, and return the "
    "result after the loop."
)
NAMES = (
    "Your function left out a service of the type because of the service's name. Select the services only by "
    "their type."
)
GONE = (
    "Your function stopped at a service whose server has ended. Catch the exception inside the loop, "
    "and continue with the next service."
)
ENDED = (
    "Since the last call of your function, a service of your list has ended or has changed its type. Get the "
    "types of all services in each call."
)
ABSENT = (
    "Your list contains names of services that do not exist now. Get the names from the master, in each call "
    "of the function."
)
LATE = "Your function did not find a new service. Get the list of services in each call of the function."
ERRORS = [
    (matches("ROSServiceIOException"), DEAD),
    (
        matches("Unable to load type"),
        "The type of a service is not installed on this machine. Use get_service_type, because "
        "you need only the name of the type.",
    ),
]
FOUND = "Return the names of all services of the given type. Do not call the services."


@part(
    "08.1",
    points=2,
    goal="Return a list with the names of all services of a type. Leave out services whose server has ended.",
    needs=["services_of"],
    deadline=25.0,
    goals=[
        FOUND,
        (
            "Leave out services whose server has ended. Include services that start between two calls of "
            "the function."
        ),
    ],
)
def find_by_type(context: CheckContext) -> None:
    """Offer services of the searched type, of another type, and of types with similar names.

    Later, offer another service, and register a service whose server is dead.
    """
    kind, other = context.random.shuffled(KINDS)[:2]
    short = kind.partition("/")[2]
    word = context.random.word()
    mine = {f"/{word}/one", f"/{word}/{context.random.word()}"}
    first = sorted(mine)
    servers = [context.serve(name, kind, lambda _: {}) for name in first]
    # The last part of this service name looks like the searched type, but the service has another type.
    misnamed = f"/{word}/{short}"
    servers.append(context.serve(misnamed, other, lambda _: {}))
    for decoy in (f"{word}_pkg/{short}", f"{kind}Stamped"):
        made = compile_service(decoy, "---\nint32 found").cls
        context.serve(f"/{word}/{context.random.word()}", made, lambda _: {})
    _finds(context, kind, SOME, mine)
    _calls_no_service(context, servers)
    context.fulfilled(FOUND)
    for place, hint in (("late", LATE), ("last", GONE)):
        if place == "last":
            context.absent(f"/{word}/dead", stale=True)
        name = f"/{context.random.word()}/{place}"
        servers.append(context.serve(name, kind, lambda _: {}))
        mine.add(name)
        _finds(context, kind, hint, mine)
    # A service of the type can have any name, with one or more parts, and with words such as "loggers".
    for name in (f"/{context.random.word()}", f"/{word}/arm/{context.random.word()}/get_loggers"):
        servers.append(context.serve(name, kind, lambda _: {}))
        mine.add(name)
        _finds(context, kind, NAMES, mine)
    ended, killed = first
    servers[0].leave()
    _finds(context, kind, SOME, mine - {ended}, {ended})
    servers[1].leave()
    context.absent(killed, stale=True)
    servers.append(context.serve(ended, other, lambda _: {}))
    _finds(context, kind, SOME, mine - {ended, killed}, {ended, killed})
    _finds(context, other, SOME, {misnamed, ended})
    context.expect(
        "the list is empty for a type that no node serves",
        expected=[],
        actual=context.run("services_of", f"{word}_pkg/Nobodys", hints=ERRORS).returned(),
        hints=[
            (None, "No service of this type exists. Return an empty list."),
            ([""], "The list contains an empty string. Return only the names of services."),
        ],
    )
    _calls_no_service(context, servers)


def _calls_no_service(context: CheckContext, servers: list[ScriptedServer]) -> None:
    if any(server.requests for server in servers):
        context.fail(
            "services_of() calls no service",
            expected="no request",
            actual="a request to a service",
            hint=(
                "The function called the services to find their types, and each call started the work "
                "of a server. Use get_service_type instead."
            ),
        )


def _finds(
    context: CheckContext, kind: str, incomplete: str, mine: set[str], former: Set[str] = frozenset()
) -> None:
    """Assert that the student's function returns all services of the type `kind`.

    `mine` contains the names of the check's services. `incomplete` is the hint for a missing service. The
    services `former` had this type, but have ended, or have another type now.
    """
    names = context.run("services_of", kind, hints=ERRORS).returned()
    _is_a_list_of_names(context, names)
    found: list[str] = of_kind(list, names, "the result")
    types = {service.name: service.type for service in context.look().services}
    # The right result also contains services of nodes that the check did not start.
    right = mine | {name for name, actual in types.items() if actual == kind}
    missing, extra = sorted(right.difference(found)), sorted(set(found) - right)
    context.require(
        "the list contains no wrong service",
        holds=not extra,
        expected=f"a list without {', '.join(extra)}",
        actual=names,
        hints=ENDED
        if set(extra) <= former
        else ABSENT
        if all(name.startswith("/") and name not in types for name in extra)
        else _why_wrong({types.get(name) for name in extra}, kind),
    )
    context.require(
        "the list contains every service of the type",
        holds=not missing,
        expected=f"a list that contains {', '.join(missing)}",
        actual=found,
        hints=NONE if incomplete == SOME and right.isdisjoint(found) else incomplete,
    )
    context.expect("the list contains each service once", expected=len(right), actual=len(found))


def _is_a_list_of_names(context: CheckContext, names: Json) -> None:
    context.require(
        "services_of() returns a list of names",
        holds=isinstance(names, list) and all(isinstance(name, str) for name in names),
        expected="a list of strings",
        actual=names,
        hints=[
            (None, NO_RETURN),
            (
                (lambda actual: isinstance(actual, str)),
                "Your function returned one string. Collect the names in a list.",
            ),
            (
                matches("object"),
                "Your function did not return a list. Convert the result with list(...) or sorted(...).",
            ),
            (
                ANYTHING,
                "The entries of your list have to be strings. Return only the names of the services, "
                "without nodes and types.",
            ),
        ],
    )


def _why_wrong(types: set[str | None], kind: str) -> str:
    """Return the hint for a list with wrong names.

    For each wrong name, `types` contains the type of the service; the value is None if there is no such
    service, and "" if the server is dead.
    """
    if None in types:
        return "Your list contains strings that are not names of services. Return only the names of services."
    if "" in types:
        return DEAD
    if f"{kind}Stamped" in types:
        return (
            "Your list contains a service with a longer type name that begins with the same "
            "text. Compare the whole strings with ==."
        )
    if any(found and found.endswith(f"_pkg/{kind.partition('/')[2]}") for found in types):
        return (
            "Your list contains a service whose type is from a different package. Compare the "
            "whole string, including the package."
        )
    return (
        "Your list contains services of a different type. Get the type with get_service_type, "
        "because the name of a service does not show its type."
    )
