"""Example calls of several service types, for clients that do not know the types in advance."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.checking import CheckContext
from course_pkg.checking.plain_values import Fields, Value


@dataclass(frozen=True)
class ExampleCall:
    """An example call: its service type, the fields of the request, and the fields of the response."""

    what: str  # `what` is the name of the call in the titles of assertions.
    kind: str
    fields: Fields
    answer: Fields

    def given(self, received: Value) -> Value:
        """Return a copy of the message `received` that contains only the fields that this call sends.

        In nested messages, fields that this call does not send are also omitted.
        """
        return _given(self.fields, received)

    def mixed_up(self, received: Fields) -> bool:
        """Return whether the values arrived in the wrong fields."""
        return set(map(str, received.values())) == set(map(str, self.fields.values()))


def example_calls(context: CheckContext) -> list[ExampleCall]:
    """Return the example calls, from the easiest to the most difficult."""
    return [_nothing(context), _numbers(context), _texts(context)]


def _nothing(context: CheckContext) -> ExampleCall:
    """Return a call whose request has no fields."""
    return ExampleCall(
        "no fields", "std_srvs/Trigger", {}, {"success": True, "message": context.random.word()}
    )


def _numbers(context: CheckContext) -> ExampleCall:
    """Return a call with two negative numbers; the dict contains the second field before the first field."""
    a, b, total = (-number for number in context.random.integers(3, 100, 999))
    return ExampleCall("negative numbers", "course_pkg/AddTwoInts", {"b": b, "a": a}, {"sum": total})


def _texts(context: CheckContext) -> ExampleCall:
    """Return a call with nested messages and with quotation marks.

    One value is the text "off", which YAML reads as False.
    """
    width, height, offset = context.random.integers(3, 100, 999)
    frame = f'{context.random.word()}\'s "own" $HOME'
    info = {
        "width": width,
        "header": {"frame_id": frame},
        "distortion_model": "off",
        "roi": {"x_offset": offset},
        "height": height,
    }
    answer = {"success": True, "status_message": context.random.word()}
    return ExampleCall("inner messages", "sensor_msgs/SetCameraInfo", {"camera_info": info}, answer)


def _given(fields: Value, received: Value) -> Value:
    if not isinstance(fields, dict) or not isinstance(received, dict):
        return received
    return {name: _given(fields[name], received.get(name)) for name in fields}
