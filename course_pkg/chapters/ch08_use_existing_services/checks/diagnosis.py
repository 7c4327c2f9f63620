"""08.6: the reason why a client cannot call a service."""

from __future__ import annotations

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.plain_values import ServiceClass
from course_pkg.types import compile_service

KINDS = """
from course_pkg.srv import AddTwoInts, geometry
from std_srvs.srv import SetBool, Trigger
"""
TYPES = {
    "AddTwoInts": "course_pkg/AddTwoInts",
    "geometry": "course_pkg/geometry",
    "SetBool": "std_srvs/SetBool",
    "Trigger": "std_srvs/Trigger",
}
DEFINITIONS = {
    "AddTwoInts": "int64 a\nint64 b\n---\nint64 sum",
    "geometry": "float32 length\nfloat32 width\nfloat32 height\n---\nfloat32 area\nfloat32 volume",
    "SetBool": "bool data\n---\nbool success\nstring message",
    "Trigger": "---\nbool success\nstring message",
}
CHANGED = "float64 first\nfloat64 second\n---\nfloat64 result"  # No type of the course has these fields.
RESULTS = ("not registered", "server is gone", "another type", "another definition", "ok")
ERRORS: Hints = [
    (
        matches("^ROSServiceException.*invalid"),
        "get_service_uri returned None, and your function passed None to get_service_headers. "
        "Test for None before this call.",
    ),
    (
        matches("^ROSServiceIOException"),
        "get_service_headers raised an exception, because the server has ended. Catch ROSServiceIOException.",
    ),
    (
        matches("Unable to load type"),
        "The type of the server is not installed on this computer. Use the dict that "
        "get_service_headers returns: it contains the name and the MD5 sum of the type.",
    ),
    (
        matches("^KeyError"),
        "Your function uses a key that the dict of get_service_headers does not have. Use the keys "
        "`type` and `md5sum`.",
    ),
]
OTHER_RESULTS: Hints = [
    (
        "another type",
        'The names of the types are equal, but your function reported "another type". Compare the entry '
        "`type` of the headers with the whole name of the client's type.",
    ),
    (
        "another definition",
        'The MD5 sums are equal, but your function reported "another definition". Compare the entry '
        "`md5sum` of the headers with the MD5 sum of the client's type.",
    ),
]
SAME = (
    "Since the last call with the same arguments, the graph has changed, but the result is the same. Get the "
    "facts in each call."
)
WHY = {
    "not registered": (
        "The master has no address for this service, so get_service_uri returns None. Test for None "
        "before you call get_service_headers."
    ),
    "server is gone": (
        "The master has an address for this service, but no server responds at this address. Test "
        "whether get_service_headers raises an exception."
    ),
    "another type": (
        "The server and the client have types with different names. Compare the whole names, with "
        "the package, before you compare the MD5 sums."
    ),
    "another definition": (
        "The names of the types are equal, but the MD5 sums are different. Compare the MD5 sums, too."
    ),
    "ok": (
        "The server and the client have the same type and MD5 sum, so the client can connect. Return "
        '"ok" in this case.'
    ),
}


@part(
    "08.6",
    points=3,
    goal=("Return the reason why a client cannot call a service with a given type. Do not call the service."),
    needs=["diagnose"],
    deadline=20.0,
)
def find_the_cause(context: CheckContext) -> None:
    """Call diagnose() for a service of each possible result; then repeat this in a random order."""
    context.prepare(KINDS)
    kind, other = context.random.shuffled(list(TYPES))[:2]
    changed = compile_service(TYPES[kind], CHANGED).cls
    names = _services(context, kind, other, changed)
    working, *others = names
    servers = [context.serve(working, TYPES[kind], lambda _: {})]
    _returns(context, working, kind, "ok")
    _calls_nothing(context, servers)
    for name in others:
        _returns(context, name, kind, names[name])
    names = _services(context, kind, other, changed)
    servers.append(context.serve(next(iter(names)), TYPES[kind], lambda _: {}))
    for name in context.random.shuffled([*names, working]):
        _returns(context, name, kind, names.get(name, "ok"))
    _notices_changes(context, working, kind, servers)
    _calls_nothing(context, servers)


def _notices_changes(context: CheckContext, name: str, kind: str, servers: list[ScriptedServer]) -> None:
    """Stop the server of `name`, register a closed port, and start the server again."""
    servers[0].leave()
    _returns(context, name, kind, "not registered", former="ok")
    context.absent(name, stale=True)
    _returns(context, name, kind, "server is gone", former="not registered")
    servers.append(context.serve(name, TYPES[kind], lambda _: {}))
    _returns(context, name, kind, "ok", former="server is gone")


def _calls_nothing(context: CheckContext, servers: list[ScriptedServer]) -> None:
    context.expect(
        "diagnose() does not call the service",
        expected=0,
        actual=sum(len(server.requests) for server in servers),
        hints=(
            "Your function called the service, and this call started the server's work. Use "
            "only get_service_uri and get_service_headers."
        ),
    )


def _services(context: CheckContext, kind: str, other: str, changed: ServiceClass) -> dict[str, str]:
    """Prepare services; return a dict that maps each service name to the right result of diagnose().

    The first name has the result "ok"; the caller must start the server of this service. The names are
    random, so that a name does not reveal its result.
    """
    works, missing, gone, typed, copied, renewed = (f"/{context.random.word()}" for _ in range(6))
    package = f"{context.random.word()}_pkg"
    context.serve(typed, TYPES[other], lambda _: {})
    context.serve(renewed, changed, lambda _: {})
    context.serve(copied, compile_service(f"{package}/{kind}", DEFINITIONS[kind]).cls, lambda _: {})
    context.absent(gone, stale=True)
    return {
        works: "ok",
        missing: "not registered",
        gone: "server is gone",
        typed: "another type",
        copied: "another type",
        renewed: "another definition",
    }


def _returns(context: CheckContext, name: str, kind: str, expected: str, former: str = "") -> None:
    """Assert that diagnose() returns `expected`. `former` is the right result of the previous call, or ""."""
    result = context.run("diagnose", name, Its(kind), hints=ERRORS)
    context.expect(
        f'diagnose() returns "{expected}"',
        expected=expected,
        actual=result.returned(),
        hints=[
            (None, NO_RETURN),
            *([(former, SAME)] if former else []),
            *(OTHER_RESULTS if expected == "ok" else ()),
            (lambda actual: actual in RESULTS, WHY[expected]),
            (ANYTHING, "Return one of the five strings in the table."),
        ],
    )
