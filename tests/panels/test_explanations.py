"""What rospy's words mean."""

from __future__ import annotations

import pytest

from course_pkg.panels.explanations import explain

# The words as rospy 1.15 says them on a real graph, with a stretch of the explanation that fits.
WORDS = {
    "ServiceException: service [/x] responded with an error: b'service cannot process request: service handler "
    "returned None'": "reached its end without a return",
    "ServiceException: service [/x] responded with an error: b'error processing request: boom'": "raised an exception",
    "ServiceException: service [/x] responded with an error: b'service cannot process request: no fuel'": "on purpose",
    "ServiceException: service [/x] responded with an error: b'service cannot process request: handler returned "
    "invalid value: Invalid number of arguments'": "cannot be made into a response",
    "ServiceException: service [/x] responded with an error: b'service cannot process request: handler returned "
    "wrong number of values'": "length is not the number of fields",
    "ServiceException: service [/x] responded with an error: b'service cannot process request: sucess is not an "
    "attribute of TriggerResponse'": "typing slip",
    "ServiceException: service [/x] responded with an error: b'error processing request: field success is not a bool'": (
        "wrong type for its field"
    ),
    "ServiceException: service [/x] responded with an error: b'error processing request: <lambda>() takes 0 "
    "positional arguments but 1 was given'": "wrong arguments",
    "ServiceException: service [/x] responded with an error: b''": "gave no reason",
    "ServiceException: service [/nope] unavailable": "knows no provider",
    "ServiceException: unable to connect to service: remote error reported: request from [/cli]: md5sums do not match: "
    "[a] vs. [b]": "different definitions",
    "ServiceException: unable to connect to service: [Errno 111] Connection refused": "no longer there",
    "ServiceException: transport error completing service call: unable to receive data from sender, check sender's "
    "logs for details": "went away while",
    "ServiceException: unable to connect to service: [Errno -2] Name or service not known": "host name",
    "ServiceException: unable to contact master": "No master answers",
    "SerializationError: field a must be an integer type": "wrong type for its field",
    "CallTimeout: /x did not answer within 5 s": "did not answer in time",
    "CallCancelled: /x was cancelled": "You ended the wait",
}


@pytest.mark.parametrize(("words", "stretch"), WORDS.items(), ids=range(len(WORDS)))
def test_each_error_has_its_own_explanation(words: str, stretch: str) -> None:
    """Every error of a call is explained by the row that is meant for it, with something to do."""
    explanation = explain(words)
    assert explanation is not None
    assert stretch in explanation.cause
    assert explanation.remedy.endswith((".", ")", "]]."))


def test_unknown_words_are_left_alone() -> None:
    """An error that is not in the table gets no guess."""
    assert explain("KeyError: 'sprocket'") is None
