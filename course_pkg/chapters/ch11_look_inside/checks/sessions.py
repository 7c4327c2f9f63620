"""11.4: a server that recognises its clients by a field of the connection header."""

from __future__ import annotations

import rospy

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.plain_values import Message, ServiceClass
from course_pkg.checking.shared.own_program import require_kernel
from course_pkg.ros.node.proxy import BoundedProxy

NAME, KIND = "/my_add_up", "course_pkg/AddUp"
TIMEOUT = 4.0  # TIMEOUT is the time limit in s for a call on a busy machine.
REFUSED = (
    'The header had the field "session", but your handler refused the call. Check the field\'s '
    "name in your code."
)
SHARED = (
    "A new Sessions object already had a total for this session. Create the dict in __init__ and store it in "
    "self, so that each object has its own totals."
)
ANOTHER = """
import rospy
from course_pkg.srv import AddUp


class AnotherSessions:
    def open(self, kind, name):
        self.service = rospy.Service(name, AddUp, kind().handle)

    def close(self):
        self.service.shutdown("checked")


another_sessions = AnotherSessions()
"""
TOTALS = "Store a separate total for each session."


@part(
    "11.4",
    points=3,
    goal=(
        "Store a separate total for each session in the connection header. Refuse a call without a session."
    ),
    needs=["Sessions"],
    goals={TOTALS: 2, "Refuse a call without a session.": 1},
)
def totals_of_sessions(context: CheckContext) -> None:
    """Call the service in two sessions, from another node in one of these sessions, and without a session."""
    kind = context.service(NAME, KIND).kind
    require_kernel(context, [service.node for service in context.look().services if service.name == NAME])
    first, second = context.random.word(), context.random.word()
    others = [first.upper(), *(context.random.word() for _ in range(context.random.integer(4, 9)))]
    turns = [first, second, first, first, second, second, *others, first]
    # Each amount is larger than the number of calls, so a program that returns the number of calls as the
    # total fails.
    amounts = context.random.integers(len(turns), 20, 900)
    amounts[3] = -amounts[3]
    amounts[4] = -amounts[1]  # After this call, the total of the second session is 0.
    totals = dict.fromkeys(turns, 0)
    counts = dict.fromkeys(turns, 0)
    everything = 0
    for session, amount in zip(turns, amounts, strict=True):
        totals[session] += amount
        everything += amount
        counts[session] += 1
        answer = _answer(context, kind, amount, {"session": session})
        _is_right(context, answer, amount, totals[session], counts[session], everything)
    more = context.random.integer(1000, 2000)
    header = {"session": first, "callerid": f"/{context.random.word()}"}
    answer = _answer(
        context,
        kind,
        more,
        header,
        "Calls from several nodes can belong to one session. Do not refuse a call because the name of the "
        "node is different.",
    )
    context.expect(
        "another node can continue a session",
        expected=totals[first] + more,
        actual=answer.total,
        hints=[
            (
                more,
                (
                    "The total started again at 0 for another node. Use only the session as the key of "
                    "the total, not the name of the node."
                ),
            )
        ],
    )
    _shares_no_total(context, kind, first)
    context.fulfilled(TOTALS)
    _refuses_without_a_session(context, kind)


def _shares_no_total(context: CheckContext, kind: ServiceClass, session: str) -> None:
    """Call a second object of the student's class in a session that the first object has used."""
    name, amount = f"/{context.random.word()}", context.random.integer(20, 900)
    context.prepare(ANOTHER)
    opened = context.run("another_sessions.open", Its("Sessions"), name, worded="Sessions()")
    assertion = "the response contains the total of the session"
    context.require(assertion, holds=not opened.error, actual=opened.error)
    try:
        context.expect(
            assertion,
            expected=amount,
            actual=_answer(context, kind, amount, {"session": session}, name=name).total,
            hints=SHARED,
        )
    finally:
        context.run("another_sessions.close", worded="Sessions()")


def _wrong_total(amount: int, calls: int, everything: int) -> Hints:
    return [
        (
            amount,
            ("The response contains only the amount of this call. Store the total of each session in self."),
        ),
        (
            everything,
            (
                "The total also contains the amounts of other sessions. Store one total for each session in "
                'a dict, with the header field "session" as the key.'
            ),
        ),
        (
            0,
            (
                "The field `total` is 0. Add the amount of this call to the total of the session, and "
                "return the sum."
            ),
        ),
        (
            calls,
            (
                "The field `total` contains the number of calls. Pass the total first: AddUpResponse(total, "
                "calls)."
            ),
        ),
        (
            ANYTHING,
            (
                "The field `total` is wrong. The total of a session starts at 0, and each call adds "
                "the amount in its request."
            ),
        ),
    ]


def _is_right(
    context: CheckContext, answer: Message, amount: int, total: int, calls: int, everything: int
) -> None:
    context.expect(
        "the response contains the total of the session",
        expected=total,
        actual=answer.total,
        hints=_wrong_total(amount, calls, everything),
    )
    context.expect(
        "the field `calls` is the number of calls of the session",
        expected=calls,
        actual=answer.calls,
        hints=[
            (
                0,
                (
                    "The field `calls` is 0. Set it to the number of calls in this session, including this "
                    "call."
                ),
            ),
            (
                lambda actual: actual == 1 and total == amount,
                (
                    "The number of calls started again at 1, because the total of the session was 0. Test "
                    "whether your dict contains the session, and not whether its total is 0."
                ),
            ),
            (ANYTHING, "The field `calls` is wrong. Count the calls of each session separately."),
        ],
    )


NOT_REFUSED: Hints = [
    (
        matches("a total of"),
        'Your server accepted a call without a session. If the header field "session" is missing or '
        "empty, raise rospy.ServiceException.",
    ),
    (
        matches("error processing request: 'session'|NoneType"),
        (
            'The header had no field "session", and this caused an exception of the wrong type. Read the '
            "field with .get(), and raise rospy.ServiceException if the field is missing."
        ),
    ),
    (
        matches("error processing request"),
        (
            "The handler raised an exception of the wrong type. To refuse a call, raise "
            "rospy.ServiceException."
        ),
    ),
    (
        matches("returned None"),
        (
            "The handler returned None, so rospy sent its own error message to the client. Raise "
            'rospy.ServiceException with a message that contains the word "session".'
        ),
    ),
    (
        ANYTHING,
        'The error message does not contain the word "session". Add the name of the missing field to '
        "the message.",
    ),
]


def _refuses_without_a_session(context: CheckContext, kind: ServiceClass) -> None:
    assertion = 'the handler refuses a call without a session, and the error message contains "session"'
    for headers in ({}, {"session": ""}):
        try:
            answer = _call(context, kind, 1, headers)
        except rospy.ServiceException as error:
            message = str(error)
        else:
            message = f"a total of {answer.total}"
        context.require(
            assertion,
            holds="cannot process request" in message and "session" in message.partition("cannot process")[2],
            expected='a ServiceException with the word "session"',
            actual=message,
            hints=NOT_REFUSED,
        )


def _answer(
    context: CheckContext,
    kind: ServiceClass,
    amount: int,
    headers: dict[str, str],
    refused: str = REFUSED,
    name: str = NAME,
) -> Message:
    try:
        return _call(context, kind, amount, headers, name)
    except rospy.ServiceException as error:
        context.fail(
            "a call with a session gets a response",
            expected="a response",
            actual=str(error),
            hint=_why_refused(str(error), refused),
        )


def _why_refused(message: str, refused: str) -> str:
    if "returned None" in message:
        return "The handler returned None. Return an AddUpResponse in every case."
    if "_connection_header" in message or "attribute" in message:
        return (
            "The handler uses an attribute that does not exist. The fields of the header are in the "
            "dict request._connection_header."
        )
    if "error processing request: '" in message:
        return (
            "At the first call of a session, the dict has no total for this session. Start with the total 0."
        )
    if "cannot process request: service [" in message:
        return "Your handler called a different service, and this call failed. Calculate the total yourself."
    if "cannot process request" in message:
        return refused
    return (
        "The handler raised the error that you see above. Read the error message, and correct the line "
        "that caused the error."
    )


def _call(
    context: CheckContext, kind: ServiceClass, amount: int, headers: dict[str, str], name: str = NAME
) -> Message:
    context.under_way(f"a call of {name} with amount={amount} and the header fields {headers}")
    proxy = BoundedProxy(name, kind, headers=headers, timeout=TIMEOUT)
    try:
        return proxy.call(amount=amount)
    finally:
        proxy.close()
