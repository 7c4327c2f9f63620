"""What rospy's words mean."""

from __future__ import annotations

import pytest

from course_pkg.graph.explanations import explain, known

# The words as rospy 1.15 says them on a real graph, with a stretch of the explanation that fits.
SAID = "ServiceException: service [/x] responded with an error: "
REFUSED = f"{SAID}b'service cannot process request: "
FAILED = f"{SAID}b'error processing request: "
CONNECT = "ServiceException: unable to connect to service: "
WORDS = {
    f"{REFUSED}service handler returned None'": "reached its end without a return",
    f"{REFUSED}no fuel'": "on purpose",
    f"{REFUSED}handler returned invalid value: Invalid number'": "cannot be made into a response",
    f"{REFUSED}handler returned wrong number of values'": "length is not the number of fields",
    f"{REFUSED}sucess is not an attribute of TriggerResponse'": "typing slip",
    f"{FAILED}boom'": "raised an exception",
    f"{FAILED}field success is not a bool'": "wrong type for its field",
    f"{FAILED}<lambda>() takes 0 positional arguments but 1 was given'": "wrong arguments",
    f"{SAID}b''": "gave no reason",
    f"{CONNECT}remote error reported: request from [/c]: md5sums do not match: [a]": "different definitions",
    f"{CONNECT}[Errno 111] Connection refused": "no longer there",
    f"{CONNECT}[Errno -2] Name or service not known": "host name",
    "ServiceException: service [/nope] unavailable": "knows no provider",
    "ServiceException: transport error completing service call: unable to receive data": "went away while",
    "ServiceException: unable to contact master": "No master answers",
    "SerializationError: field a must be an integer type": "wrong type for its field",
    "CallTimeout: service [/x]: no answer within 5 s; its handler is still working": "did not answer in time",
    "CallCancelled: service [/x]: the call was cancelled": "You ended the wait",
}


@pytest.mark.parametrize(("words", "stretch"), WORDS.items(), ids=range(len(WORDS)))
def test_each_error_has_its_own_explanation(words: str, stretch: str) -> None:
    """Every error of a call is explained by the row that is meant for it, with something to do."""
    explanation = known(words)
    assert explanation is not None
    assert stretch in explanation.cause
    assert explanation.remedy.endswith((".", ")", "]]."))


def test_unknown_words_are_left_alone() -> None:
    """An error that is not in the table gets no guess."""
    assert known("KeyError: 'sprocket'") is None
    assert not explain(KeyError("sprocket")).known
