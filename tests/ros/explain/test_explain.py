"""Tests of explain(), which explains errors of ROS and of the course."""

from __future__ import annotations

import pytest

from course_pkg import explain
from course_pkg.errors import CallTimeout, MasterSilent, NodeFailed
from course_pkg.ros import MasterClient
from course_pkg.ros.explain import Explanation, known
from course_pkg.ros.explain.explanation import CHAPTERS, TABLE

REFUSED = "rospy.service.ServiceException: unable to connect to service: [Errno 111] Connection refused"
TRACEBACK = f"""Traceback (most recent call last):
  File "/usr/lib/python3/dist-packages/rospy/impl/tcpros_base.py", line 562, in connect
    self.socket.connect((dest_addr, dest_port))
ConnectionRefusedError: [Errno 111] Connection refused

During handling of the above exception, another exception occurred:

Traceback (most recent call last):
  File "client.py", line 9, in <module>
    print(call(1))
{REFUSED}
"""
LOG = (
    "[INFO] [1700000000.1]: well\n"
    "[ERROR] [1700000000.2]: Error processing request: boom\n"
    "['Traceback (most recent call last):\\n', 'ValueError: boom\\n']\n"
)
BUILD = """Base path: /home/me/ws
CMake Error at my_services/CMakeLists.txt:6 (add_service_files):
  Unknown CMake command "add_service_files".


-- Configuring incomplete, errors occurred!
"""
# Each entry of `MESSAGES` has an error message of rospy 1.15, and a text that the explanation must contain.
RESPONDED = "ServiceException: service [/x] responded with an error: "
SERVER_REFUSED = f"{RESPONDED}b'service cannot process request: "
HANDLER_FAILED = f"{RESPONDED}b'error processing request: "
UNABLE = "ServiceException: unable to connect to service: "
MESSAGES = {
    f"{SERVER_REFUSED}service handler returned None'": "reached its end without a return",
    f"{SERVER_REFUSED}no fuel'": "to refuse this request",
    f"{SERVER_REFUSED}handler returned invalid value: Invalid number'": "cannot create a response",
    f"{SERVER_REFUSED}handler returned wrong number of values'": "a list or tuple of the wrong length",
    f"{SERVER_REFUSED}sucess is not an attribute of TriggerResponse'": "is misspelt",
    f"{HANDLER_FAILED}boom'": "raised an exception",
    f"{HANDLER_FAILED}field success is not a bool'": "wrong type for its field",
    f"{HANDLER_FAILED}<lambda>() takes 0 positional arguments but 1 was given'": "wrong parameters",
    f"{RESPONDED}b''": "without a reason",
    f"{UNABLE}remote error reported: request from [/c]: md5sums do not match: [a]": "different definitions",
    f"{UNABLE}[Errno 111] Connection refused": "does not run any more",
    f"{UNABLE}[Errno -2] Name or service not known": "host name",
    "ServiceException: service [/nope] unavailable": "No node provides",
    "ServiceException: transport error completing service call: unable to receive data": "ended during",
    "ServiceException: unable to contact master": "No master answers",
    "SerializationError: field a must be an integer type": "wrong type for its field",
    "CallTimeout: service [/x]: no answer within 5 s; its handler is still working": "did not answer in time",
    "CallCancelled: service [/x]: the call was cancelled": "You cancelled the call",
}
PASTED = {
    REFUSED: "still lists a server",
    TRACEBACK: "still lists a server",
    TRACEBACK.replace("\n", "\r\n"): "still lists a server",
    f"\x1b[31m{REFUSED}\x1b[0m": "still lists a server",
    LOG: "raised an exception",
    BUILD: "my_services/CMakeLists.txt, line 6: CMake does not know the command add_service_files",
    "Couldn't find executable named talk.py below /home/me/ws": "has no program talk.py",
    "OSError: [Errno 98] Address already in use": "Another program already uses the port",
    "shutdown request: [/talker] Reason: new node registered with same name": "Two nodes have the same name",
    "ERROR: Unable to communicate with service [/x], address [rosrpc://localhost:1]": "does not answer",
    "ConnectionRefusedError: [Errno 111] Connection refused": "No master answers",
    "ERROR: Unable to communicate with master!": "No master answers",
}


@pytest.mark.parametrize(("text", "stretch"), PASTED.items(), ids=range(len(PASTED)))
def test_pasted_text_is_explained(text: str, stretch: str) -> None:
    """If a pasted text, such as a log, contains several errors, explain() explains the last error."""
    found = explain(text)
    assert found.known
    assert stretch in found.cause
    assert found.remedy.endswith((".", ")"))


def test_an_exception_is_explained_by_its_own_message_first() -> None:
    """For an exception with a cause, explain() explains the exception's own message first."""
    cause = ConnectionRefusedError(111, "Connection refused")
    told = RuntimeError("the robot did not move")
    told.__cause__ = cause
    assert explain(told) == explain(cause)
    clearer = CallTimeout("service [/x]: no answer within 5 s; its handler is still working")
    clearer.__cause__ = cause
    assert "did not answer in time" in explain(clearer).cause


def test_errors_of_the_course_are_explained() -> None:
    """explain() has an explanation for each error of the course."""
    with pytest.raises(Exception, match="No ROS master") as raised:
        MasterClient("http://localhost:1").pid()
    assert "No master answers" in explain(raised.value).cause
    assert "No master answers" in explain(str(raised.value)).cause
    silent = MasterSilent(
        "The program at http://localhost:1 accepts connections, but did not answer within 2 s."
    )
    assert "process is paused" in explain(silent).cause
    assert explain(str(silent)) == explain(silent)
    assert (
        explain(NodeFailed("The node crashed. Start it again.")).cause == "The node crashed. Start it again."
    )


class Unshowable(Exception):
    """An exception that raises an error in __str__."""

    def __str__(self) -> str:
        raise ValueError("no words")


def ring() -> Exception:
    """Return an exception that is the cause of its own cause."""
    one, other = KeyError("one"), KeyError("other")
    one.__cause__, other.__cause__ = other, one
    return one


@pytest.mark.parametrize(
    "thing",
    [None, "", "  \n", "all is well", 7, b"\xff\x00", KeyError("sprocket"), Unshowable(), ring(), object()],
    ids=lambda thing: type(thing).__name__,
)
def test_an_unknown_error_gets_a_next_step(thing: object) -> None:
    """For every unknown object, explain() returns a sentence and advice."""
    found = explain(thing)
    assert isinstance(found, Explanation)
    assert not found.known
    assert found.cause.endswith(".")
    assert found.remedy.endswith(".")


@pytest.mark.parametrize(
    "start",
    ["service [/x", "service cannot process request: ", "error processing request: ", "The manifest "],
)
def test_a_long_text_with_many_partial_matches(start: str) -> None:
    """explain() is fast for a long log and for a very long line."""
    assert "still lists" in explain(f"{start}\n" * 15_000 + REFUSED).cause or "process" in start
    assert isinstance(explain(start * 15_000), Explanation)


def test_an_explanation_in_a_notebook() -> None:
    """In a notebook, an explanation has three lines.

    In the HTML of an explanation, a text between backticks is marked as code.
    """
    found = explain("ServiceException: service [/nope] unavailable")
    assert repr(found).splitlines() == [
        "Cause: No node provides a service with this name: the server never started, has ended, or uses "
        "a different name.",
        "What to do: Start the server, or compare the name with the output of `rosservice list`. "
        "After a restart of the master, start the servers again.",
        "Taught in: chapter 06, Write a client",
    ]
    assert "<code>rosservice list</code>" in found._repr_html_()
    assert "Taught" not in repr(explain("all is well"))
    assert "<script>" not in Explanation("<script>", "x")._repr_html_()


def test_each_row_names_an_existing_chapter() -> None:
    """Each row of the table of explanations names an existing chapter."""
    for pattern, cause, remedy, chapter in TABLE:
        assert chapter in CHAPTERS, pattern
        assert cause.endswith("."), pattern
        assert remedy[-1] in ".)", pattern


@pytest.mark.parametrize(("message", "part"), MESSAGES.items(), ids=range(len(MESSAGES)))
def test_each_error_has_its_own_explanation(message: str, part: str) -> None:
    """Each error that a call can raise has a separate explanation."""
    explanation = known(message)
    assert explanation is not None
    assert part in explanation.cause
    assert explanation.remedy.endswith((".", ")", "]]."))


def test_an_unknown_error_gets_no_explanation() -> None:
    """known() returns None for an unknown error."""
    assert known("KeyError: 'sprocket'") is None
    assert not explain(KeyError("sprocket")).known
