"""The service panel's model: no page, no kernel, no ROS."""

from __future__ import annotations

import threading
from typing import Any

import pytest

from course_pkg.errors import CallCancelled, CallUnderWay, FieldError, NothingPicked, UnknownType
from course_pkg.interfaces import ServiceType, compile_service
from course_pkg.panels.service.model import HISTORY, Offer, ServiceModel
from tests.support import eventually

GEOMETRY = "float32 length\nfloat32 width\nfloat32 height\n---\nfloat32 area\nfloat32 volume\n"
EMPTY = "---\n"


class Caller:
    """Answers a geometry request, or does what the test says."""

    def __init__(self) -> None:
        self.requests: list[Any] = []
        self.closed = False
        self.raises: Exception | None = None
        self.release = threading.Event()
        self.release.set()
        self.cancelled = False

    def call(self, request: Any, /, *, timeout: float) -> Any:  # noqa: ANN401 - a generated class
        """Note the request, wait to be released, answer."""
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
        """End the wait."""
        self.cancelled = True
        self.release.set()

    def close(self) -> None:
        """Note that it was let go."""
        self.closed = True


TYPES = {
    name: compile_service(name, text)
    for name, text in {"course_pkg/geometry": GEOMETRY, "a/Empty": EMPTY}.items()
}


def find_type(name: str) -> ServiceType:
    """Know two types only."""
    if name not in TYPES:
        raise UnknownType(name, f"{name} is not known here.")
    return TYPES[name]


class Desk:
    """A model with everything that it said."""

    def __init__(self) -> None:
        self.caller = Caller()
        self.messages: list[dict[str, Any]] = []
        self.model = ServiceModel(
            lambda *_: self.caller, lambda **parts: self.messages.append(parts), find_type=find_type
        )

    @property
    def state(self) -> dict[str, Any]:
        """Everything said, the latest of each part."""
        return {name: value for message in self.messages for name, value in message.items()}

    def ended(self) -> dict[str, Any]:
        """Wait for the call to end and give its outcome."""
        return eventually(
            lambda: (
                self.state["outcome"] if self.state["outcome"]["phase"] not in ("running", "idle") else None
            )
        )


GEOMETRY_OFFER = Offer("/getGeometry", "course_pkg/geometry", "/SERVER_NODE")
GOOD = {"length": "1.2", "width": "5.2", "height": "8.9"}


@pytest.fixture
def desk() -> Desk:
    """Pick the geometry service."""
    desk = Desk()
    desk.model.offer([GEOMETRY_OFFER])
    desk.model.pick("/getGeometry")
    return desk


def test_a_call_is_two_messages(desk: Desk) -> None:
    """The page hears of the start and of the end, each once."""
    before = len(desk.messages)
    desk.model.start(GOOD, "5")
    outcome = desk.ended()
    said = desk.messages[before:]
    assert [message["outcome"]["phase"] for message in said] == ["running", "done"]
    assert [row["text"] for row in outcome["rows"]] == ["6.24", "55.536"]
    assert desk.caller.requests[0].height == pytest.approx(8.9)
    assert desk.model.response.area == pytest.approx(6.24)


def test_what_is_wrong_is_said_at_its_field_and_nothing_is_called(desk: Desk) -> None:
    """Every wrong field is named with what is allowed, and no request leaves."""
    desk.model.start({"length": "abc", "width": "5.2", "height": "1e39"}, "5")
    check = desk.state["check"]
    assert set(check["errors"]) == {"length", "height"}
    assert "'abc' is not a number" in check["errors"]["length"]
    assert "float32 from -3.4e38 to 3.4e38" in check["errors"]["height"]
    assert check["refused"] == 1
    assert desk.caller.requests == []


@pytest.mark.parametrize("deadline", ["", "0", "-1", "soon", "nan", "inf", "1e9"])
def test_a_deadline_is_a_number_of_seconds(desk: Desk, deadline: str) -> None:
    """A deadline that bounds nothing is refused like a wrong field."""
    desk.model.start(GOOD, deadline)
    assert "at most 3600" in desk.state["check"]["errors"]["@deadline"]
    assert desk.caller.requests == []


def test_the_commands_follow_the_draft(desk: Desk) -> None:
    """Both commands are those of the values typed; while something is wrong, there are none."""
    desk.model.edit(GOOD)
    check = desk.state["check"]
    assert check["shell"] == "rosservice call /getGeometry 1.2 5.2 8.9"
    assert "length=1.2, width=5.2, height=8.9" in check["python"]
    desk.model.edit({**GOOD, "width": ""})
    assert set(desk.state["check"]) == {"errors"}


def test_a_second_call_waits_for_the_first(desk: Desk) -> None:
    """While a call is under way another is not begun."""
    desk.caller.release.clear()
    desk.model.start(GOOD, "5")
    desk.model.start(GOOD, "5")
    with pytest.raises(CallUnderWay, match="getGeometry is being called already"):
        desk.model.call("5")
    desk.caller.release.set()
    desk.ended()
    assert len(desk.caller.requests) == 1


def test_cancel_ends_the_call(desk: Desk) -> None:
    """A cancelled call is shown as cancelled, and the next one works."""
    desk.caller.release.clear()
    desk.model.start(GOOD, "5")
    eventually(lambda: desk.caller.requests)
    desk.model.cancel()
    outcome = desk.ended()
    assert outcome["phase"] == "cancelled"
    assert "handler runs on" in outcome["error"]["cause"]


def test_an_error_is_shown_in_its_own_words_and_explained(desk: Desk) -> None:
    """The words are not changed, and the table says what they mean."""
    desk.caller.raises = RuntimeError("service [/getGeometry] unavailable")
    desk.model.start(GOOD, "5")
    error = desk.ended()["error"]
    assert (error["name"], error["words"]) == ("RuntimeError", "service [/getGeometry] unavailable")
    assert "knows no provider" in error["cause"]
    assert desk.model.response is None


def test_history_is_bounded_and_can_refill_the_form(desk: Desk) -> None:
    """The latest call comes first with the draft that made it, and old ones fall off."""
    for number in range(HISTORY + 3):
        desk.model.fill({"length": float(number)})
        desk.model.call("5")
    history = desk.state["history"]
    assert len(history) == HISTORY
    assert history[0]["number"] == HISTORY + 3
    assert history[0]["draft"]["length"] == f"{HISTORY + 2:.1f}"
    assert history[0]["asked"].startswith("length 22.0")
    assert history[0]["said"].startswith("area 0.0")


def test_fill_refuses_what_does_not_fit_and_keeps_the_form(desk: Desk) -> None:
    """A value from Python is checked like one that is typed."""
    desk.model.fill({"length": 1.2})
    with pytest.raises(FieldError, match="width"):
        desk.model.fill({"width": "wide"})
    with pytest.raises(FieldError, match="depth"):
        desk.model.fill({"depth": 1.0})
    assert desk.model.draft == {"length": "1.2", "width": "0.0", "height": "0.0"}


def test_a_call_from_python_raises_what_the_call_raises(desk: Desk) -> None:
    """In a cell the error is an error, and the panel shows it as well."""
    desk.caller.raises = RuntimeError("boom")
    with pytest.raises(RuntimeError, match="boom"):
        desk.model.call("5")
    assert desk.ended()["phase"] == "failed"


def test_a_service_that_goes_away_is_said_and_what_was_typed_stays(desk: Desk) -> None:
    """The form stays, with a sentence; it goes when the service is back."""
    desk.model.edit(GOOD)
    desk.model.offer([])
    assert "is on the graph now" in desk.state["form"]["problem"]
    desk.model.offer([GEOMETRY_OFFER])
    assert desk.state["form"]["problem"] == ""
    assert desk.model.draft == GOOD


def test_a_service_that_changes_its_type_gets_a_new_form(desk: Desk) -> None:
    """The old draft does not fit any more; the panel says why it is gone and lets the old connection go."""
    desk.model.call("5")
    desk.model.offer([Offer("/getGeometry", "a/Empty", "/other")])
    form = desk.state["form"]
    assert form["request"]["fields"] == []
    assert "was course_pkg/geometry and is now a/Empty" in form["problem"]
    assert desk.model.draft == {}
    assert desk.caller.closed


def test_a_type_that_is_not_known_here_leaves_no_form() -> None:
    """The reason stands in place of the form."""
    desk = Desk()
    desk.model.offer([Offer("/x", "no/Such", "/n")])
    desk.model.pick("/x")
    assert desk.state["form"]["problem"] == "no/Such is not known here."
    assert "request" not in desk.state["form"]
    with pytest.raises(NothingPicked, match="no/Such is not known here"):
        desk.model.call("5")


def test_nothing_picked_says_how_to_pick() -> None:
    """A call from Python without a service says what to do."""
    with pytest.raises(NothingPicked, match=r"ServicePanel\('/getGeometry'\)"):
        Desk().model.call("5")


def test_logger_services_come_last() -> None:
    """The services of the student's own come before those of every node."""
    desk = Desk()
    desk.model.offer([Offer("/a/get_loggers", "roscpp/GetLoggers", "/a"), Offer("/z", "a/Empty", "/a")])
    assert [(each["name"], each["tool"]) for each in desk.state["services"]] == [
        ("/z", False),
        ("/a/get_loggers", True),
    ]


def test_picking_another_service_ends_the_call_and_its_answer_is_dropped(desk: Desk) -> None:
    """What comes back for the service before does not show under the new one."""
    desk.caller.release.clear()
    desk.model.start(GOOD, "5")
    eventually(lambda: desk.caller.requests)
    desk.model.offer([GEOMETRY_OFFER, Offer("/e", "a/Empty", "/n")])
    desk.model.pick("/e")
    assert desk.state["outcome"] == {"phase": "idle"}
    eventually(lambda: not [thread for thread in threading.enumerate() if thread.name == "panel-call"])
    assert desk.state["outcome"] == {"phase": "idle"}


def test_recording_keeps_request_and_outcome(desk: Desk) -> None:
    """Each input is really called; what came of it stands beside it."""
    kept = desk.model.record([{"length": 1.2, "width": 5.2, "height": 8.9}, {}], "5")
    assert [each["draft"]["length"] for each in kept] == ["1.2", "0.0"]
    assert [each["outcome"]["rows"][0]["text"] for each in kept] == ["6.24", "0.0"]
    assert kept[0]["check"]["shell"].endswith("1.2 5.2 8.9")
    assert len(desk.caller.requests) == 2
