"""The client that handles failed calls."""

import math

from course_pkg.chapters.ch06_write_a_client.checks.boxes import GEOMETRY, stops, volumes
from course_pkg.checking import ANYTHING, CheckContext, HangUp, Its, Refuse, Silence, matches, part
from course_pkg.checking.peers.faulty_server import Fault, Stumble
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.result import Result
from course_pkg.types import compile_service

CHANGED = "float64 size\n---\nfloat64 volume"  # another definition of the type geometry
HIDDEN = (
    "The function catches the exception that a wrong argument causes. Catch only "
    "rospy.ServiceException, not a more general class of exceptions."
)
NO_NAMES = """
class Slip:
    def __init__(self, error):
        self.error = error

    def _raise(self, *_):
        raise self.error(f"the name of a service is a string, not {type(self).__name__}")

    __bool__ = __str__ = __repr__ = __len__ = __getitem__ = __hash__ = __eq__ = _raise


class no_name:
    TypeError, AttributeError, ValueError = map(Slip, (TypeError, AttributeError, ValueError))
"""  # Every operation on a Slip object raises an error, as with a service name that is not a string.

DEPENDS = (
    "The result has to depend on the response of this call, not on earlier calls. Read the volume "
    "from the new response."
)
VOLUME = "Return the volume of the response."
CAUGHT = "Return None if the call failed."


@part(
    "06.3",
    points=2,
    goal=(
        "Return the volume, or None if the call failed. Do not catch exceptions that are "
        "caused by wrong arguments."
    ),
    needs=["volume_or_none"],
    deadline=30.0,
    goals={VOLUME: 1, CAUGHT: 2, "Do not catch exceptions that are caused by wrong arguments.": 1},
)
def catch_what_can_happen(context: CheckContext) -> None:
    """Call the student's function with working services, with failing services, and with wrong arguments."""
    good, flat = (f"/{context.random.word()}" for _ in range(2))
    sides = context.random.numbers(3, 0.5, 9.0)
    volume, second = volumes(context, 2)
    response = {"volume": volume}
    context.serve(good, GEOMETRY, lambda _: response)
    context.serve(flat, GEOMETRY, lambda _: {"volume": 0.0})
    for name, expected in ((good, volume), (flat, 0.0), (good, second)):
        response["volume"] = expected
        context.expect(
            "the function returns the volume of the response",
            expected=expected,
            actual=context.run("volume_or_none", name, *sides).returned(),
            near=1e-9,
            hints=[
                (
                    None,
                    "The server responded, but the function returned None. Note that 0.0 is a "
                    "valid volume, too.",
                ),
                (
                    math.prod(sides),
                    "The function returned the product of the sides. Call the service, and "
                    "return the volume from the response.",
                ),
                (
                    volume,
                    "The check called the function again with the same arguments, and it returned the volume "
                    "of the first response. Call the service in each call of the function.",
                ),
                (ANYTHING, "Return the field `volume` of the response."),
            ],
        )
    context.fulfilled(VOLUME)
    for failure, name, server in _failing(context):
        _fails(context, failure, name, sides)
        if server:
            _is_called_once(context, server)
    _in_a_random_order(context, sides)
    context.fulfilled(CAUGHT)
    converted = (
        "The function accepted a string as a number, but a string has to cause an exception. "
        "Do not convert the arguments."
    )
    for place, side in enumerate(sides):
        wrong = [*sides[:place], str(side), *sides[place + 1 :]]
        _comes_out(context, context.run("volume_or_none", good, *wrong), repr(str(side)), converted)
    # rospy replaces None by 0, so None is not a mistake.
    slips = [f"{context.random.word()} metres", context.random.number(2.0, 9.0) * 1e200, sides, {"side": 1.0}]
    for slip in context.random.shuffled(slips):
        for place in range(3):
            wrong = [*sides[:place], slip, *sides[place + 1 :]]
            _comes_out(context, context.run("volume_or_none", good, *wrong), repr(slip))
    context.prepare(NO_NAMES)
    for kind in ("TypeError", "AttributeError", "ValueError"):
        slipped = context.run("volume_or_none", Its(f"no_name.{kind}"), *sides)
        _comes_out(context, slipped, f"a name that is not a string: {kind}")
    silent = f"/{context.random.word()}"
    context.serve(silent, GEOMETRY, lambda _: Silence())
    stops(context, "volume_or_none", silent, *sides, catch="rospy.ServiceException")


def _in_a_random_order(context: CheckContext, sides: list[float]) -> None:
    """Try new servers that respond or refuse, so that a function with a fixed list of results fails."""
    responding = volumes(context, context.random.integer(2, 4))
    failing = [None] * context.random.integer(2, 4)
    for volume in context.random.shuffled([*responding, *failing]):
        name = f"/{context.random.word()}"
        if volume is None:
            refuses = context.serve(name, GEOMETRY, lambda _: Refuse("not today"))
            _fails(context, "refuses", name, sides)
            _is_called_once(context, refuses)
        else:
            server = context.serve(name, GEOMETRY, lambda _, volume=volume: {"volume": volume})
            context.expect(
                "the function returns the volume of the response",
                expected=volume,
                actual=context.run("volume_or_none", name, *sides).returned(),
                near=1e-9,
                hints=DEPENDS,
            )
            if len(server.requests) > 1:
                context.fail(
                    "the function returns the volume of the response",
                    expected="one call of the service",
                    actual=f"{len(server.requests)} calls",
                    hint="The function called the service more than once. Call the service only once.",
                )


def _is_called_once(context: CheckContext, server: ScriptedServer) -> None:
    context.expect(
        "a failed call is not repeated",
        expected=1,
        actual=len(server.requests),
        hints=[
            (0, DEPENDS),
            (
                ANYTHING,
                "The function repeated a failed call. Call the service only once, because the "
                "server can do the work even if the call fails.",
            ),
        ],
    )


def _comes_out(context: CheckContext, wrong: Result, slip: str, hint: str = HIDDEN) -> None:
    context.require(
        "the function does not catch the exception for a wrong argument",
        holds=bool(wrong.error),
        expected=f"an error about {slip}",
        actual=wrong.error or "no error",
        hints=HIDDEN if wrong.value is None else hint,
    )


def _fails(context: CheckContext, failure: str, name: str, sides: list[float]) -> None:
    """Assert that the student's function returns None if the call of the service `name` fails.

    The student's function may wait up to 10 s for the service.
    """
    result = context.run(
        "volume_or_none",
        name,
        *sides,
        within=12.0,
        hints=[
            (
                matches("^ServiceException.*(responded with|transport|md5sums)"),
                "In this case, too, the call raised rospy.ServiceException. Return None for each "
                "rospy.ServiceException, and ignore the text of its error message.",
            ),
            (
                matches("^ServiceException"),
                "A failed call raises rospy.ServiceException, not rospy.ROSException. Catch "
                "rospy.ServiceException.",
            ),
            (
                matches("^ROSException.*waiting for service"),
                "wait_for_service raises rospy.ROSException when the timeout is over. Catch "
                "this exception, and return None.",
            ),
        ],
    )
    context.expect(
        f"the result is None for a server that {failure}",
        expected=None,
        actual=result.returned(),
        hints=(
            "The call failed, but the function returned a value. Return None, because None is "
            "different from every volume."
        ),
    )


def _failing(context: CheckContext) -> list[tuple[str, str, ScriptedServer | None]]:
    """Return the failures of a call that the student's function must handle.

    Each tuple contains the name of the failure, the name of the service, and the server. If no server runs,
    the third item is None.
    """
    refusing, dying, killed, nowhere, buggy, other = (f"/{context.random.word()}" for _ in range(6))
    refuses = context.serve(refusing, GEOMETRY, lambda _: Refuse("not today"))
    dies = context.serve(dying, GEOMETRY, lambda _: HangUp())
    stumbles = context.faulty(buggy, GEOMETRY, lambda _: {})
    stumbles.plan.append(Fault(Stumble("division by zero")))
    context.serve(other, compile_service(GEOMETRY, CHANGED).cls, lambda _: {})
    context.absent(killed, stale=True)
    return [
        ("does not exist", nowhere, None),
        ("refuses", refusing, refuses),
        ("has a bug in its handler", buggy, stumbles),
        ("uses another definition of the type", other, None),
        ("dies during the call", dying, dies),
        ("was killed", killed, None),
    ]
