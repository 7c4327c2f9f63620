"""Asserts that a handler refuses a call with a ServiceException."""

from __future__ import annotations

from course_pkg.checking import CheckContext, matches
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.plain_values import Value

BUG = (
    "The handler raised an error that is not a rospy.ServiceException. Read the error message above "
    "this hint."
)
BY_HANDLER = matches("cannot process request: (?!(service )?handler returned)")


def refused(
    context: CheckContext, service: Service, assertion: str, word: str, hints: Hints, **fields: Value
) -> None:
    """Assert that the service refuses a request with an error message that contains the text `word`.

    `hints` contains the hints for two cases: the call is not refused, or the error message does not contain
    `word`.
    """
    rest = [(matches(""), hints)] if isinstance(hints, str) else list(hints)
    bug = (matches("error processing|handler returned"), BUG)
    text = service.refused(assertion, saying=word, hints=[bug, *rest], **fields)
    context.require(
        "the handler refuses the call with a rospy.ServiceException",
        holds=bool(BY_HANDLER.search(text)),
        expected='an error that contains "cannot process request" and your message',
        actual=text,
        hints=BUG,
    )
