"""The client that tests whether a server is running."""

from collections.abc import Sequence
from threading import Timer

from course_pkg.chapters.ch06_write_a_client.checks.boxes import GEOMETRY, stops
from course_pkg.checking import CheckContext, matches, part
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.waiting import at_this_load

# If the service is missing, a call may return up to `EARLY` s before its time limit.
EARLY = 0.3
FRACTION = (
    matches("timeout must be non-zero"),
    "The argument `seconds` was 0.5, but the timeout of wait_for_service was 0. Pass `seconds` without any "
    "change, because it can be a fraction.",
)
THERE = "Return True for a service that exists, and False for a service that does not exist."


@part(
    "06.2",
    points=2,
    goal=(
        "Return True if a service exists or starts within the given number of seconds. "
        "Otherwise, return False."
    ),
    needs=["is_there"],
    deadline=30.0,
    goals=[THERE, "Return True for a service that starts within this time."],
)
def is_anybody_there(context: CheckContext) -> None:
    """Call the student's function for a running server, and for two names without a running server.

    Later, start a server while the function waits.
    """
    here, nowhere, killed, later = (f"/{context.random.word()}" for _ in range(4))
    server = context.serve(here, GEOMETRY, lambda _: {})
    context.absent(killed, stale=True)
    there = context.run("is_there", here, 2.0)
    context.expect(
        "the function returns True for a service that exists",
        expected=True,
        actual=there.returned(),
        hints=[
            (None, NO_RETURN),
            (
                False,
                "The service exists, but the result was False. Do not test the return value of "
                "wait_for_service: this function always returns None.",
            ),
            (
                lambda actual: isinstance(actual, str),
                "The function returned a string. Write True and False without quotes.",
            ),
        ],
    )
    context.require(
        "the function does not wait for a service that exists",
        holds=there.took < 1.0,
        expected="an immediate result",
        actual=f"a result after {there.took:.1f} s",
        hints=(
            "The function waits although the service exists. Use wait_for_service, which "
            "returns immediately in this case."
        ),
    )
    context.expect(
        "the function returns True for a service that exists",
        expected=True,
        # In calls for a missing service, the time limit is the same.
        actual=context.run("is_there", here, 0.5, hints=[FRACTION]).returned(),
        hints=[
            (
                False,
                "The service exists, but the function returned False with a time limit of 0.5 s. Wait for "
                "the service with wait_for_service.",
            )
        ],
    )
    _calls_nothing(context, [server])
    _never_there(
        context,
        nowhere,
        "The function returned True for a service that does not exist. Return False when the time is over.",
    )
    _never_there(
        context,
        killed,
        "The service is still registered with the master, but its process has ended. Use "
        "wait_for_service, which also tries to connect to the server.",
    )
    context.fulfilled(THERE)
    # `starts` is the time in s from the beginning of the call to the start of the service. `limit` is the
    # time limit of the call in s.
    starts = context.random.number(1.1, 1.4, digits=1)
    limit = context.random.number(3.2, 4.2, digits=1)
    started = [server]
    start = Timer(starts, lambda: started.append(context.serve(later, GEOMETRY, lambda _: {})))
    start.start()
    waited = context.run("is_there", later, limit, within=2 * limit)
    start.join()
    context.expect(
        "the function returns True for a service that starts in time",
        expected=True,
        actual=waited.returned(),
        hints=[
            (
                False,
                f"The service started after {starts} s, and the argument `seconds` was {limit}. Wait "
                "for the service until this time is over.",
            )
        ],
    )
    context.require(
        "the function does not wait for a service that exists",
        holds=waited.took < min(at_this_load(starts + 1.0), limit),
        expected=f"a result soon after {starts} s",
        actual=f"a result after {waited.took:.1f} s",
        hints=(
            f"The service started after {starts} s, but the function continued to wait. Use "
            "wait_for_service, which returns as soon as the service exists."
        ),
    )
    _in_a_random_order(context, started)
    stops(context, "is_there", nowhere, context.random.number(2.0, 4.0), catch="rospy.ROSException")
    _calls_nothing(context, started)


def _calls_nothing(context: CheckContext, servers: Sequence[ScriptedServer]) -> None:
    requests = sum(len(server.requests) for server in servers)
    if requests:
        context.fail(
            "the function does not call the service",
            expected="no request",
            actual=f"{requests} request(s)",
            hint=(
                "The function called the service, and this call started the server's work. Wait for the "
                "service, but do not call the service."
            ),
        )


def _in_a_random_order(context: CheckContext, servers: list[ScriptedServer]) -> None:
    """Call the student's function with new names; a function with a fixed list of results fails."""
    fixed = (
        "With another service, the result was wrong. The result has to depend on the given "
        "service, not on earlier calls."
    )
    there = [True] * context.random.integer(3, 5) + [False] * context.random.integer(2, 3)
    for expected in context.random.shuffled(there):
        name = f"/{context.random.word()}"
        # These times are long enough for a connection on a busy machine.
        seconds = context.random.number(1.2, 1.8)
        if expected:
            servers.append(context.serve(name, GEOMETRY, lambda _: {}))
        result = context.run("is_there", name, seconds, within=6.0)
        context.expect(
            "the function returns True for a service that exists"
            if expected
            else ("the function returns False for a service that does not start"),
            expected=expected,
            actual=result.returned(),
            hints=fixed,
        )
        if not expected and result.took < seconds - EARLY:
            context.fail(
                "the function returns False for a service that does not start",
                expected=f"a result after {seconds} s",
                actual=f"a result after {result.took:.1f} s",
                hint=(
                    "The function returned False too early, although the service could still start. Wait "
                    "until the time is over, and then return False."
                ),
            )
        if not expected:
            servers.append(context.serve(name, GEOMETRY, lambda _: {}))
            context.expect(
                "the function returns True for a service that exists",
                expected=True,
                actual=context.run("is_there", name, seconds, within=6.0).returned(),
                hints=(
                    "Between two calls with the same arguments, the service started, but the result did not "
                    "change. Wait for the service in each call."
                ),
            )


def _never_there(context: CheckContext, name: str, hint: str) -> None:
    """Call the student's function with the name of a missing service, and with a time limit of 0.5 s.

    Within 0.5 s, rospy looks for the service twice. A result after 1.4 s is too late.
    """
    too_long = (
        "The function waited longer than the time in `seconds`. Call wait_for_service only once, and "
        "pass `seconds` as the timeout."
    )
    missing = context.run(
        "is_there",
        name,
        0.5,
        within=3.0,
        hints=[
            (matches("TimesUp"), too_long),
            FRACTION,
            (
                matches("ROSException"),
                "wait_for_service raises rospy.ROSException when the time is over. Catch this exception.",
            ),
        ],
    )
    context.expect(
        "the function returns False for a service that does not start",
        expected=False,
        actual=missing.returned(),
        hints=[
            (None, "When the time was over, the function returned None. Return False in this case."),
            (True, hint),
        ],
    )
    context.require(
        "the function does not wait longer than the given time",
        holds=missing.took < 1.4,
        expected="a result after 0.5 s or a little more",
        actual=f"a result after {missing.took:.1f} s",
        hints=too_long,
    )
