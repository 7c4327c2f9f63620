"""Tests of the service panel's model, without ROS."""

from __future__ import annotations

import threading

import pytest

from course_pkg.errors import CallCancelled, CallInProgress, FieldError, NoServiceSelected, UnknownType
from course_pkg.panels.service.model import HISTORY, Offer, ServiceModel
from course_pkg.ros.node.type_lookup import Message
from course_pkg.types import Plain, ServiceType, compile_service
from tests.support import eventually

GEOMETRY = "float32 length\nfloat32 width\nfloat32 height\n---\nfloat32 area\nfloat32 volume\n"
EMPTY = "---\n"


class Caller:
    """A fake proxy that returns a geometry response or raises an error."""

    def __init__(self) -> None:
        self.requests: list[Message] = []
        self.closed = False
        self.raises: Exception | None = None
        self.release = threading.Event()
        self.release.set()
        self.cancelled = False

    def call(self, request: Message, /, *, timeout: float) -> Message:
        """Store the request, wait until the test releases the call, and respond."""
        self.requests.append(request)
        assert self.release.wait(min(timeout, 10))
        if self.cancelled:
            raise CallCancelled("the call was cancelled")
        if self.raises:
            raise self.raises
        response = TYPES["course_pkg/geometry"].response.cls()
        response.area = request.length * request.width
        response.volume = response.area * request.height
        return response

    def cancel(self) -> None:
        """Release the waiting call."""
        self.cancelled = True
        self.release.set()

    def close(self) -> None:
        """Record that the proxy was closed."""
        self.closed = True


TYPES = {
    name: compile_service(name, text)
    for name, text in {"course_pkg/geometry": GEOMETRY, "a/Empty": EMPTY}.items()
}


def find_type(name: str) -> ServiceType:
    """Return one of the two known types, or raise UnknownType."""
    if name not in TYPES:
        raise UnknownType(name, f"{name} is not known here.")
    return TYPES[name]


class Harness:
    """Stores the messages of a model that uses a fake proxy."""

    def __init__(self) -> None:
        self.caller = Caller()
        self.messages: list[dict[str, Plain]] = []
        self.model = ServiceModel(
            lambda *_: self.caller, lambda **parts: self.messages.append(parts), find_type=find_type
        )

    @property
    def state(self) -> dict[str, Plain]:
        """Return the latest value of each part of the model's state."""
        return {name: value for message in self.messages for name, value in message.items()}

    def ended(self) -> dict[str, Plain]:
        """Wait until the call has finished, and return its outcome."""
        return eventually(
            lambda: (
                self.state["outcome"] if self.state["outcome"]["phase"] not in ("running", "idle") else None
            )
        )


GEOMETRY_OFFER = Offer("/getGeometry", "course_pkg/geometry", "/SERVER_NODE")
GOOD = {"length": "1.2", "width": "5.2", "height": "8.9"}


@pytest.fixture
def harness() -> Harness:
    """Return a model with the geometry service selected."""
    harness = Harness()
    harness.model.offer([GEOMETRY_OFFER])
    harness.model.pick("/getGeometry")
    return harness


def test_a_call_is_two_messages(harness: Harness) -> None:
    """The page receives one message at the start of a call and one message at its end."""
    before = len(harness.messages)
    harness.model.start(GOOD, "5")
    outcome = harness.ended()
    said = harness.messages[before:]
    assert [message["outcome"]["phase"] for message in said] == ["running", "done"]
    assert [row["text"] for row in outcome["rows"]] == ["6.24", "55.536"]
    assert harness.caller.requests[0].height == pytest.approx(8.9)
    assert harness.model.response.area == pytest.approx(6.24)


def test_errors_are_shown_at_their_fields_and_nothing_is_called(harness: Harness) -> None:
    """Each wrong field shows its allowed values, and the model sends no request."""
    harness.model.start({"length": "abc", "width": "5.2", "height": "1e39"}, "5")
    check = harness.state["check"]
    assert set(check["errors"]) == {"length", "height"}
    assert "'abc' is not a number" in check["errors"]["length"]
    assert "float32 from -3.4e38 to 3.4e38" in check["errors"]["height"]
    assert check["refused"] == 1
    assert harness.caller.requests == []


@pytest.mark.parametrize("deadline", ["", "0", "-1", "soon", "nan", "inf", "1e9"])
def test_a_deadline_is_a_number_of_seconds(harness: Harness, deadline: str) -> None:
    """If the timeout is invalid, the panel shows an error at the field of the timeout."""
    harness.model.start(GOOD, deadline)
    assert "at most 3600" in harness.state["check"]["errors"]["@deadline"]
    assert harness.caller.requests == []


def test_the_commands_follow_the_draft(harness: Harness) -> None:
    """The shell command and the Python code contain the typed values.

    If a value is wrong, the panel shows no command and no code.
    """
    harness.model.edit(GOOD)
    check = harness.state["check"]
    assert check["shell"] == "rosservice call /getGeometry 1.2 5.2 8.9"
    assert "length=1.2, width=5.2, height=8.9" in check["python"]
    harness.model.edit({**GOOD, "width": ""})
    assert set(harness.state["check"]) == {"errors"}


def test_a_second_call_waits_for_the_first(harness: Harness) -> None:
    """While a call runs, the model does not start a second call."""
    harness.caller.release.clear()
    harness.model.start(GOOD, "5")
    harness.model.start(GOOD, "5")
    with pytest.raises(CallInProgress, match="A call of /getGeometry is running"):
        harness.model.call("5")
    harness.caller.release.set()
    harness.ended()
    assert len(harness.caller.requests) == 1


def test_cancel_ends_the_call(harness: Harness) -> None:
    """If a call is cancelled, the panel shows that the call was cancelled."""
    harness.caller.release.clear()
    harness.model.start(GOOD, "5")
    eventually(lambda: harness.caller.requests)
    harness.model.cancel()
    outcome = harness.ended()
    assert outcome["phase"] == "cancelled"
    assert "handler continues" in outcome["error"]["cause"]


def test_an_error_message_is_shown_unchanged_and_explained(harness: Harness) -> None:
    """The page gets the unchanged error message and its explanation."""
    harness.caller.raises = RuntimeError("service [/getGeometry] unavailable")
    harness.model.start(GOOD, "5")
    error = harness.ended()["error"]
    assert (error["name"], error["words"]) == ("RuntimeError", "service [/getGeometry] unavailable")
    assert "No node provides" in error["cause"]
    assert harness.model.response is None


def test_history_is_bounded_and_can_refill_the_form(harness: Harness) -> None:
    """The history contains the latest calls with their requests."""
    for number in range(HISTORY + 3):
        harness.model.fill({"length": float(number)})
        harness.model.call("5")
    history = harness.state["history"]
    assert len(history) == HISTORY
    assert history[0]["number"] == HISTORY + 3
    assert history[0]["draft"]["length"] == f"{HISTORY + 2:.1f}"
    assert history[0]["asked"].startswith("length 22.0")
    assert history[0]["said"].startswith("area 0.0")


def test_fill_refuses_a_wrong_value_and_keeps_the_form(harness: Harness) -> None:
    """fill() refuses a wrong value, and the form does not change."""
    harness.model.fill({"length": 1.2})
    with pytest.raises(FieldError, match="width"):
        harness.model.fill({"width": "wide"})
    with pytest.raises(FieldError, match="depth"):
        harness.model.fill({"depth": 1.0})
    assert harness.model.draft == {"length": "1.2", "width": "0.0", "height": "0.0"}


def test_a_call_from_python_raises_what_the_call_raises(harness: Harness) -> None:
    """If a call from Python fails, the cell raises the error, and the panel shows the error."""
    harness.caller.raises = RuntimeError("boom")
    with pytest.raises(RuntimeError, match="boom"):
        harness.model.call("5")
    assert harness.ended()["phase"] == "failed"


def test_a_lost_service_is_reported_and_typed_values_stay(harness: Harness) -> None:
    """If the service disappears, the panel shows a message and does not delete the typed values."""
    harness.model.edit(GOOD)
    harness.model.offer([])
    assert "is on the graph now" in harness.state["form"]["problem"]
    harness.model.offer([GEOMETRY_OFFER])
    assert harness.state["form"]["problem"] == ""
    assert harness.model.draft == GOOD


def test_a_service_that_changes_its_type_gets_a_new_form(harness: Harness) -> None:
    """If the service type changes, the panel shows a new form and a message."""
    harness.model.call("5")
    harness.model.offer([Offer("/getGeometry", "a/Empty", "/other")])
    form = harness.state["form"]
    assert form["request"]["fields"] == []
    assert "has changed from course_pkg/geometry to a/Empty" in form["problem"]
    assert harness.model.draft == {}
    assert harness.caller.closed


def test_a_type_that_is_not_known_here_leaves_no_form() -> None:
    """If the type is unknown, the panel shows the reason instead of the form."""
    harness = Harness()
    harness.model.offer([Offer("/x", "no/Such", "/n")])
    harness.model.pick("/x")
    assert harness.state["form"]["problem"] == "no/Such is not known here."
    assert "request" not in harness.state["form"]
    with pytest.raises(NoServiceSelected, match="no/Such is not known here"):
        harness.model.call("5")


def test_a_call_without_a_service_names_the_next_step() -> None:
    """If no service is selected, a call raises an error that contains the next step."""
    with pytest.raises(NoServiceSelected, match=r"ServicePanel\('/getGeometry'\)"):
        Harness().model.call("5")


def test_logger_services_come_last() -> None:
    """The list shows the student's services before the logger services."""
    harness = Harness()
    harness.model.offer([Offer("/a/get_loggers", "roscpp/GetLoggers", "/a"), Offer("/z", "a/Empty", "/a")])
    assert [(each["name"], each["tool"]) for each in harness.state["services"]] == [
        ("/z", False),
        ("/a/get_loggers", True),
    ]


def test_picking_another_service_ends_the_call_and_its_answer_is_dropped(harness: Harness) -> None:
    """If the student selects another service during a call, the panel does not show the call's response."""
    harness.caller.release.clear()
    harness.model.start(GOOD, "5")
    eventually(lambda: harness.caller.requests)
    harness.model.offer([GEOMETRY_OFFER, Offer("/e", "a/Empty", "/n")])
    harness.model.pick("/e")
    assert harness.state["outcome"] == {"phase": "idle"}
    eventually(lambda: not [thread for thread in threading.enumerate() if thread.name == "panel-call"])
    assert harness.state["outcome"] == {"phase": "idle"}


def test_recording_keeps_request_and_outcome(harness: Harness) -> None:
    """record() calls the service with each request, and stores each request and its outcome."""
    kept = harness.model.record([{"length": 1.2, "width": 5.2, "height": 8.9}, {}], "5")
    assert [each["draft"]["length"] for each in kept] == ["1.2", "0.0"]
    assert [each["outcome"]["rows"][0]["text"] for each in kept] == ["6.24", "0.0"]
    assert kept[0]["check"]["shell"].endswith("1.2 5.2 8.9")
    assert len(harness.caller.requests) == 2
