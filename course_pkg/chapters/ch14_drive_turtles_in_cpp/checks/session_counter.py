"""14.9: a handler that reads the connection header of a client."""

from __future__ import annotations

import queue
import threading

import rospy

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import World
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.cpp_program import cpp
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.plain_values import ServiceClass

PROGRAM = cpp("session_counter")
TRIGGER = "std_srvs/Trigger"
WITHIN = 8.0  # WITHIN is the time limit in s for a call.
COUNTED = "Count the calls of each session separately."


@part(
    "14.9",
    points=3,
    goal=(
        "Write session_counter.cpp: /count reads the session from the connection header, and "
        "returns the number of calls in this session."
    ),
    needs=[f"file:{PROGRAM.path}"],
    deadline=150.0,
    start=f"%%writefile {PROGRAM.path}\n...",
    goals={COUNTED: 2, "Refuse a call without a session.": 1},
)
def count_sessions(context: CheckContext) -> None:
    """Call the service in two sessions, and without a session."""
    world = World(context, PROGRAM.prepare(context, PROGRAM), PROGRAM, services=("count",))
    with world.run() as running:
        world.serves(running, "count")
        service = context.service(world.name("count"), TRIGGER, timeout=WITHIN)
        first = context.random.word()
        more = [context.random.word() for _ in range(context.random.integer(3, 8))]
        sessions = [first, first.upper(), f"{first}{more[0]}", *more]
        counts = dict.fromkeys(sessions, 0)
        for session in context.random.shuffled(sessions * 6):
            counts[session] += 1
            _counts(context, service.name, service.kind, session, counts)
        counts[first] += 1
        _counts(context, service.name, service.kind, first, counts, f"/{context.random.word()}")
        context.fulfilled(COUNTED)
        for session in context.random.shuffled(sessions)[:3]:
            service.refused(
                'the handler refuses a call without the header field "session"',
                hints=(
                    'The header had no field "session", but the response contains a count. Test with '
                    "find() whether the header has this field."
                ),
            )
            counts[session] += 1
            _counts(context, service.name, service.kind, session, counts)


def _counts(
    context: CheckContext,
    name: str,
    kind: ServiceClass,
    session: str,
    counts: dict[str, int],
    caller: str = "",
) -> None:
    context.expect(
        "the message is the number of calls in this session",
        expected=str(counts[session]),
        actual=_call(name, kind, {"session": session, **({"callerid": caller} if caller else {})}),
        hints=[
            (
                lambda _: bool(caller),
                (
                    "The handler uses the name of the calling node. Use only the value of the "
                    'field "session", '
                    "because several nodes can make calls in one session."
                ),
            ),
            (
                str(sum(counts.values())),
                ("The response contains the number of all calls. Store a separate count for each session."),
            ),
            (
                "1",
                (
                    "The response to every call in this session is 1. Outside the handler, store a map with "
                    "one count for each session, for sessions with any name."
                ),
            ),
            (
                str(counts[session] - 1),
                (
                    "The response contains the number of calls before this call. Increase the count "
                    "before you write the response."
                ),
            ),
            ("", "The message is empty. Set the message to the count, converted with std::to_string."),
            (
                ANYTHING,
                (
                    "The response does not contain the number of calls in the session. Read the session "
                    "from the connection header, and count the calls of this session."
                ),
            ),
        ],
    )


def _call(name: str, kind: ServiceClass, headers: dict[str, str]) -> str:
    """Call the service `name` with header fields; return the message of the response or of the error."""
    inbox: queue.Queue[str] = queue.Queue()

    def call() -> None:
        try:
            inbox.put(rospy.ServiceProxy(name, kind, headers=headers)().message)
        except (rospy.ServiceException, rospy.ROSException) as error:
            inbox.put(f"{type(error).__name__}: {error}")

    threading.Thread(target=call, daemon=True).start()
    try:
        return inbox.get(timeout=WITHIN)
    except queue.Empty:
        return f"no response within {WITHIN:g} s"
