"""The client that calls the next server after a failure; each call has a time limit."""

import time
from collections.abc import Mapping, Sequence

from course_pkg.chapters.ch06_write_a_client.checks.boxes import GEOMETRY, volumes
from course_pkg.checking import ANYTHING, CheckContext, Late, Refuse, Silence, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import Act, Script
from course_pkg.checking.plain_values import Message
from course_pkg.checking.result import Result
from course_pkg.waiting import at_this_load, wait_until

KINDS = ("first", "second", "flat", "late", "tardy", "refuses", "slow", "frozen", "next", "nowhere")
# Three missing services may delay the result by at most this time in s. A wait of 1 s takes 1.2 s, because
# rospy looks for a service every 0.3 s.
MISSING = 4.1
# A service that does not respond may delay the result by at most this time in s; a correct function waits 1 s
# for the response.
LONGEST = 1.75
# If a service does not respond, the client must wait at least this time in s before it calls the next
# service.
SHORTEST = 0.9
FIRST = "If the first service responds, return the volume in its response."
NEXT = (
    "If a service does not exist or refuses the request, return the volume in the response of the "
    "next service."
)


@part(
    "06.4",
    points=3,
    goal=(
        "Return the volume of the first service that responds within one second. Return None "
        "if no service responds."
    ),
    needs=["first_answer"],
    deadline=30.0,
    goals=[FIRST, NEXT, "Wait one second for a response. Return None if no service responds."],
)
def ask_the_next_one(context: CheckContext) -> None:
    """Put a working service at the beginning of the list; later, put a failing service before it.

    At the end, the list contains only failing services.
    """
    # The names are random, so that the name of a service does not reveal how its server behaves.
    names = {kind: f"/{context.random.word()}" for kind in KINDS}
    first, second, late, tardy = volumes(context, 4)
    primary = context.serve(names["first"], GEOMETRY, lambda _: {"volume": first})
    reserve = context.serve(names["second"], GEOMETRY, lambda _: {"volume": second})
    context.serve(names["flat"], GEOMETRY, lambda _: {"volume": 0.0})
    context.serve(names["late"], GEOMETRY, lambda _: Late(0.6, {"volume": late}))
    context.serve(names["tardy"], GEOMETRY, lambda _: Late(1.3, {"volume": tardy}))
    context.serve(names["refuses"], GEOMETRY, lambda _: Refuse("not today"))
    context.serve(names["slow"], GEOMETRY, lambda _: Late(0.5, Refuse("not today")))
    # These lists contain the times in s at which the services "frozen" and "next" were called.
    frozen_at: list[float] = []
    next_at: list[float] = []
    context.serve(names["frozen"], GEOMETRY, _noted(frozen_at, Silence()))
    context.serve(names["next"], GEOMETRY, _noted(next_at, {"volume": second}))
    sides = context.random.numbers(3, 0.5, 9.0)
    working = context.run("first_answer", [names["first"], names["second"]], *sides, hints=_ERRORS)
    context.expect(
        "the first service is used if it responds",
        expected=first,
        actual=working.returned(),
        near=1e-9,
        hints=[
            (None, NO_RETURN),
            (
                second,
                "The function returned the volume of the second service. Stop at the first service "
                "that responds.",
            ),
            (
                lambda actual: "volume" in actual,
                "The function returned the whole response. Return only the field `volume` of the response.",
            ),
            (ANYTHING, "Return the volume from the response of the service."),
        ],
    )
    context.expect(
        "the first service is used if it responds",
        expected=[dict(zip(("length", "width", "height"), sides, strict=True))],
        actual=primary.requests,
        near=1e-4,
        hints=(
            "The request was repeated or changed. Call a service once, and send the three sides "
            "without any change."
        ),
    )
    context.expect(
        "after a response, no other service is called",
        expected=0,
        actual=len(reserve.requests),
        hints=(
            "The first service responded, but the function also called the second service. Call a service "
            "only after the previous call has failed, and return as soon as you have a volume."
        ),
    )
    context.expect(
        "a volume of 0 is valid",
        expected=0.0,
        actual=_first_of(context, names, "flat", "second").returned(),
        hints=(
            "The first service responded with the volume 0.0, and Python treats 0.0 as false. Do not "
            "test the volume itself: test whether it is None, or whether your list is empty."
        ),
    )
    context.fulfilled(FIRST)
    many = context.random.shuffled(["nowhere", *["refuses"] * context.random.integer(2, 3)])
    for failing in (*context.random.shuffled([["nowhere"], ["refuses"]]), many):
        context.expect(
            "if a call fails, the next service is used",
            expected=second,
            actual=_first_of(context, names, *failing, "second").returned(),
            near=1e-9,
            hints=[
                (
                    None,
                    "The last service can respond, but the function did not call it. Catch the "
                    "exception inside the loop, and try all services.",
                )
            ],
        )
    context.fulfilled(NEXT)
    _waits_briefly_for_missing_services(context, names, working.took)
    before = len(reserve.requests)
    context.expect(
        "the client waits for a response that comes after 0.6 s",
        expected=late,
        actual=_first_of(context, names, "late", "second").returned(),
        near=1e-9,
        hints=[
            (
                second,
                "The first service responds after 0.6 s, and this is fast enough. Wait up to 1 "
                "s for a response.",
            )
        ],
    )
    context.expect(
        "after a response, no other service is called",
        expected=0,
        actual=len(reserve.requests) - before,
        hints=(
            "The first service responded after 0.6 s, but the function had already called the second "
            "service. Wait for one second before you call the next service."
        ),
    )
    frozen = _first_of(context, names, "frozen", "next")
    context.expect(
        "if a service is frozen, the next service is used",
        expected=second,
        actual=frozen.returned(),
        near=1e-9,
        hints=[
            (
                lambda actual: actual is None and wait_until(lambda: bool(next_at), at_this_load(0.5)),
                "The second service was called, but the function did not wait for its response. Each service "
                "has one second of its own, so calculate the time limit again for each call.",
            ),
            (
                None,
                "The first service does not respond, but the second service can respond. Call the "
                "second service after one second.",
            ),
        ],
    )
    took = frozen.took
    if took - working.took >= LONGEST:  # The call may be slow because the machine is busy, so repeat it once.
        took = min(took, _first_of(context, names, "frozen", "next").took)
    for _ in range(2):  # On a busy machine, the first request may arrive late.
        if _longest_pause(frozen_at, next_at) < SHORTEST:
            _first_of(context, names, "frozen", "next")
    if _longest_pause(frozen_at, next_at) < SHORTEST:
        context.fail(
            "a frozen service delays the result by about one second",
            expected="a call of the next service after 1 s",
            actual=f"a call of the next service after {_longest_pause(frozen_at, next_at):.2f} s",
            hint=(
                "The function called the next service too early. Wait one full second for each service, "
                "because a slow server may still respond in this second."
            ),
        )
    context.require(
        "a frozen service delays the result by about one second",
        holds=took - working.took < LONGEST,
        expected="at most 1 s for the frozen service",
        actual=f"a result after {took:.1f} s",
        hints="The function waits too long for one service. Wait at most one second for each service.",
    )
    context.expect(
        "the client waits for a response that comes after 0.6 s",
        expected=late,
        actual=_first_of(context, names, "tardy", "late").returned(),
        near=1e-9,
        hints=[
            (
                tardy,
                "The late response of the first service was used as the response of the second "
                "service. Store the response of each call in a new list.",
            )
        ],
    )
    context.expect(
        "the function returns None if no service responds",
        expected=None,
        actual=_first_of(context, names, "nowhere", "refuses", hints=_NO_RESPONSE).returned(),
        hints="No service responded, but the function returned a value. Return None after the loop.",
    )
    context.expect(
        "the function returns None if no service responds",
        expected=None,
        actual=_first_of(context, names, "tardy", "slow", hints=_NO_RESPONSE).returned(),
        hints=[
            (
                tardy,
                "The first service responded after 1.3 s, and the function returned this late response. A "
                "response that takes longer than one second does not count.",
            )
        ],
    )
    _in_a_random_order(context, names, {"first": first, "second": second, "flat": 0.0})


def _waits_briefly_for_missing_services(
    context: CheckContext, names: Mapping[str, str], usual: float
) -> None:
    """Assert that each missing service delays the result by about one second at most.

    `usual` is the duration of a call with a service that responds, in s.
    """
    took: list[float] = []
    while not took or (took[-1] > MISSING and len(took) < 2):  # The machine can be busy, so repeat it once.
        result = _first_of(context, names, "nowhere", "nowhere", "nowhere", "second")
        result.returned()
        took.append(result.took - usual)
    context.require(
        "a missing service delays the result by at most one second",
        holds=min(took) <= MISSING,
        expected="at most 1 s for each of three missing services",
        actual=f"a result after {min(took):.1f} s",
        hints=(
            "The function waits too long for a missing service. Set the timeout of wait_for_service to 1 s."
        ),
    )


def _noted(times: list[float], act: Act) -> Script:
    """Return a script that stores the time of each request in the list `times`, and then returns `act`."""

    def script(_: Message) -> Act:
        times.append(time.monotonic())
        return act

    return script


def _longest_pause(earlier: Sequence[float], later: Sequence[float]) -> float:
    return max(
        (second - first for first, second in zip(earlier, later, strict=False)),
        default=0.0,
    )


def _in_a_random_order(context: CheckContext, names: Mapping[str, str], works: Mapping[str, float]) -> None:
    """Use lists with and without a working service in a random order; a function with fixed results fails."""
    used = [*context.random.shuffled(list(works))[:2], *[""] * context.random.integer(1, 3)]
    for working in context.random.shuffled(used):
        failing = context.random.shuffled(["nowhere", "refuses"])[: context.random.integer(1, 2)]
        context.expect(
            "if a call fails, the next service is used"
            if working
            else "the function returns None if no service responds",
            expected=works.get(working),
            actual=_first_of(context, names, *failing, *filter(None, [working])).returned(),
            near=1e-9,
            hints=(
                "The result has to depend on the services in the list, not on earlier calls. Call "
                "these services each time your function runs."
            ),
        )


_NO_RESPONSE = [
    (
        matches("."),
        "No service responded, and an exception ended the function. Catch this exception "
        "inside the loop, and return None after the loop.",
    )
]
_ERRORS: Hints = [
    (
        matches("^(ServiceException|ROSException)"),
        "A failed call ended the function. Catch the exception of the call inside the loop.",
    ),
    (
        matches("^TimesUp"),
        "The function waits forever for a server that does not respond. Call the service in a "
        "thread, and join this thread with timeout=1.",
    ),
]


def _first_of(context: CheckContext, names: Mapping[str, str], *kinds: str, hints: Hints = ()) -> Result:
    """Call the student's function with one service of each kind in `kinds`, such as "first"."""
    sides = context.random.numbers(3, 0.5, 9.0)
    services = [names[kind] for kind in kinds]
    return context.run("first_answer", services, *sides, within=3.0 + len(services), hints=hints or _ERRORS)
