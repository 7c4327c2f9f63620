"""09.4: a server that tells its clients apart by what they put in the connection header."""

from __future__ import annotations

import rospy

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.plain import Message, ServiceClass
from course_pkg.graph.calls import BoundedProxy

NAME, KIND = "/my_add_up", "course_pkg/AddUp"
PATIENCE = 4.0  # s for a call, on a machine that is busy
REFUSED = "It was refused, and its header had the field session. Look in request._connection_header."


@part(
    "09.4",
    points=3,
    goal="Add up for each session apart; it stands in the connection header, and without one: refuse.",
    needs=["Sessions"],
)
def a_total_for_each(exam: Exam) -> None:
    """Two sessions in turn, from one node and from another; then a client that has none."""
    kind = exam.service(NAME, KIND).kind
    first, second = exam.draw.word(), exam.draw.word()
    amounts = exam.draw.integers(6, 1, 900)
    totals = {first: 0, second: 0}
    counts = {first: 0, second: 0}
    everything = 0
    turns = [first, second, first, first, second, second]
    for session, amount in zip(turns, amounts, strict=True):
        totals[session] += amount
        everything += amount
        counts[session] += 1
        answer = _asked(exam, kind, amount, {"session": session})
        _right(exam, answer, amount, totals[session], counts[session], everything)
    more = exam.draw.integer(1000, 2000)
    header = {"session": first, "callerid": f"/{exam.draw.word()}"}
    answer = _asked(exam, kind, more, header, "Another node may go on with a session: it goes by the name.")
    exam.expect(
        "a session goes on from another node",
        expected=totals[first] + more,
        seen=answer.total,
        hints={more: "It began anew: it goes by the node that calls, and has to go by the session."},
    )
    _without(exam, kind)


def _right(exam: Exam, answer: Message, amount: int, total: int, calls: int, everything: int) -> None:
    exam.expect(
        "the total is that of the session",
        expected=total,
        seen=answer.total,
        hints={
            amount: "That is this amount alone: what was added up before has to be kept, in self.",
            everything: "That is everybody's amounts in one total. Keep one for each session, in a dict.",
            total - amount: "That is what this session had before. Add the amount to it.",
            calls: "That is the number of calls. AddUpResponse(total, calls): the total comes first.",
            0: "total is 0: the field is left out, or this amount was not added.",
            says(""): "Add the amount to what this session had before, and return the sum.",
        },
    )
    exam.expect(
        "calls counts those of the session",
        expected=calls,
        seen=answer.calls,
        hints={
            0: "calls is 0, as a field is that is left out, or this call is not counted.",
            says(""): "Count for each session apart, as with the total.",
        },
    )


def _without(exam: Exam, kind: ServiceClass) -> None:
    rule = "a client without a session is refused, in words that say what is missing"
    for headers in ({}, {"session": ""}):
        try:
            answer = _called(kind, 1, headers)
        except rospy.ServiceException as error:
            words = str(error)
        else:
            words = f"a total of {answer.total}"
        exam.hold(
            rule,
            "cannot process request" in words and "session" in words.partition("cannot process")[2],
            expected="a ServiceException that names the field session",
            seen=words,
            hints={
                says("a total of"): (
                    "Nobody knows whose total that is. Look whether the field is there and not empty; "
                    "raise rospy.ServiceException if not."
                ),
                says("error processing request: 'session'|NoneType"): (
                    "The handler stumbled over the missing field. Look for it with .get, and refuse."
                ),
                says("error processing request"): (
                    "Another exception came out of the handler. Look for the field with .get, and refuse by "
                    "rospy.ServiceException."
                ),
                says("returned None"): (
                    "The handler returned nothing, and rospy says so in words of its own. Refuse: raise "
                    "rospy.ServiceException with words that name the field session."
                ),
                says(""): "Name the field in the refusal: session. Then a programmer knows what to add.",
            },
        )


def _asked(
    exam: Exam, kind: ServiceClass, amount: int, headers: dict[str, str], refused: str = REFUSED
) -> Message:
    try:
        return _called(kind, amount, headers)
    except rospy.ServiceException as error:
        exam.fail(
            "a call with a session is answered",
            expected="a response",
            seen=str(error),
            hint=_why(str(error), refused),
        )


def _why(words: str, refused: str) -> str:
    if "returned None" in words:
        return "Return an AddUpResponse: a function without a return line gives None."
    if "_connection_header" in words or "attribute" in words:
        return "The fields of the header are in request._connection_header, a dict."
    if "error processing request: '" in words:
        return "A session that calls for the first time is in no dict yet: begin with 0."
    if "cannot process request" in words:
        return refused
    return "Read the error: it comes from the handler."


def _called(kind: ServiceClass, amount: int, headers: dict[str, str]) -> Message:
    proxy = BoundedProxy(NAME, kind, headers=headers, timeout=PATIENCE)
    try:
        return proxy.call(amount=amount)
    finally:
        proxy.close()
