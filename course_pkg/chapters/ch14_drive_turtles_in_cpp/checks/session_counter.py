"""14.9: a handler that reads the connection header of a client."""

from __future__ import annotations

import queue
import threading
from concurrent.futures import ThreadPoolExecutor

import rospy

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import World
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.cpp_program import cpp
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.plain_values import ServiceClass

PROGRAM = cpp("session_counter")
TRIGGER = "std_srvs/Trigger"
WITHIN = 8.0  # WITHIN is the time limit in s for a call.
MANY = 30  # After the other calls, the check calls the service once in this number of further sessions.
AT_ONCE = 8  # The check makes this number of calls at the same time.
NOT_REFUSED = 'the handler refuses a call without the header field "session"'
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
        for session in ["", *(context.random.word() for _ in range(MANY)), first, ""]:
            counts[session] = counts.get(session, 0) + 1
            _counts(context, service.name, service.kind, session, counts)
        _counts_at_once(context, service.name, service.kind, first, counts)
        context.fulfilled(COUNTED)
        for session in context.random.shuffled(sessions)[:3]:
            service.refused(
                NOT_REFUSED,
                hints=[
                    (
                        (lambda response: not response["message"].isdigit()),
                        (
                            "Without the field, the client got a response. A response with success=false is "
                            "not a refusal: return false from the handler, or throw an exception."
                        ),
                    ),
                    (
                        ANYTHING,
                        (
                            'The header had no field "session", but the response contains a count. Test with '
                            "find() whether the header has this field."
                        ),
                    ),
                ],
            )
            counts[session] += 1
            _counts(context, service.name, service.kind, session, counts)


def _counts_at_once(
    context: CheckContext, name: str, kind: ServiceClass, session: str, counts: dict[str, int]
) -> None:
    """Make several calls in one session at the same time; each response must contain another number."""
    with ThreadPoolExecutor(AT_ONCE) as pool:
        found = [*pool.map(lambda _: _call(name, kind, {"session": session}), range(AT_ONCE))]
    first = counts[session] + 1
    counts[session] += AT_ONCE
    context.expect(
        "calls at the same time get different numbers",
        expected=[str(number) for number in range(first, first + AT_ONCE)],
        actual=sorted(found, key=lambda text: (len(text), text)),
        hints=(
            "Several calls at the same time got wrong numbers. If several threads execute the handler, lock "
            "a std::mutex while you read and change the count."
        ),
    )


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
                (lambda actual: not session and "Exception" in actual),
                (
                    "The handler refused a session with an empty name. Refuse a call only if the header has "
                    'no field "session": test this with find().'
                ),
            ),
            (
                (lambda actual: actual == "1" and counts[session] > 2),
                (
                    "The count of this session was right at first, but then began again at 1. Keep the "
                    "counts of all sessions, for any number of sessions."
                ),
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
