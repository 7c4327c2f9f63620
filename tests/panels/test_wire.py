"""Tests of how the wire view splits bytes into fields."""

from __future__ import annotations

import io
import json
import random
import struct

import pytest

from course_pkg.errors import UnknownType
from course_pkg.panels import WireView
from course_pkg.panels.wire.anatomy import header_pieces, reply_pieces, request_pieces
from course_pkg.panels.wire.model import STEPS, state
from course_pkg.panels.wire.pieces import MOST, SHOWN, PieceState
from course_pkg.ros.wire.capture import Wire
from course_pkg.ros.wire.relay import Chunk, RelayedConnection
from course_pkg.types import MessageType, Plain, ServiceType, compile_message, compile_service

GEOMETRY = compile_service(
    "course_pkg/geometry", "float32 length\nfloat32 width\nfloat32 height\n---\nfloat32 area\nfloat32 volume"
)
EVERYTHING = """bool a
int8 b
uint8 c
int16 d
uint16 e
int32 f
uint32 g
int64 h
uint64 i
float32 j
float64 k
string l
time m
duration n
char o
byte p
uint8[] q
string[] r
float32[3] s
geometry_msgs/Point t
geometry_msgs/Point[] u
bool[] v
"""
VALUES = {
    "a": True,
    "b": -1,
    "c": 200,
    "d": -2,
    "e": 60000,
    "f": -3,
    "g": 4_000_000_000,
    "h": -(2**40),
    "i": 2**63,
    "j": 1.2,
    "k": -0.1,
    "l": "ä b",
    "m": {"secs": 1, "nsecs": 2},
    "n": {"secs": -1, "nsecs": 3},
    "o": 255,
    "p": -128,
    "q": [7, 8],
    "r": ["", "two"],
    "s": [1.0, 2.0, 3.0],
    "t": {"x": 1.0, "y": 2.0, "z": 3.0},
    "u": [],
    "v": [True, False],
}


def sized(data: bytes) -> bytes:
    """Return the length of the data, followed by the data."""
    return struct.pack("<I", len(data)) + data


def header(**fields: str) -> bytes:
    """Return a connection header."""
    return sized(b"".join(sized(f"{name}={value}".encode()) for name, value in fields.items()))


def body(kind: MessageType, values: dict[str, Plain]) -> bytes:
    """Return the bytes of a message, without the four length bytes at its beginning."""
    buffer = io.BytesIO()
    kind.to_message({**kind.default(), **values}).serialize(buffer)
    return buffer.getvalue()


def values(pieces: list[PieceState]) -> dict[str, str]:
    """Return the values of the fields; the keys are the field names."""
    return {piece["name"]: piece["value"] for piece in pieces}


def covered(pieces: list[PieceState]) -> list[tuple[int, int]]:
    """Return the offset and the size of each field; headings of groups are omitted."""
    return [(piece["at"], piece["size"]) for piece in pieces if piece["role"] != "group"]


def gapless(pieces: list[PieceState], size: int) -> bool:
    """Return whether the fields cover each byte of the message once and in order."""
    at = 0
    for start, count in covered(pieces):
        if start != at:
            return False
        at += count
    return at == size


def connection(*said: tuple[bool, bytes], closed_by: str = "client") -> RelayedConnection:
    """Return a recorded connection with the given blocks of bytes.

    The Boolean of each block says whether the client has sent this block.
    """
    chunks = [Chunk(10 + number / 1000, *each) for number, each in enumerate(said)]
    return RelayedConnection(10.0, chunks, closed_by)


def titles(*conversations: RelayedConnection, kind: ServiceType | None = GEOMETRY, **more: int) -> list[str]:
    """Return the titles of the steps that the wire view shows for the given connections."""
    wire = Wire("/x", uri="rosrpc://localhost:1", connections=conversations, kind=kind, **more)
    return [step["title"] for step in state(wire, unknown)["steps"]]


def unknown(name: str) -> ServiceType:
    """Raise UnknownType for any type name."""
    raise UnknownType(name, f"there is no {name}")


GREETED = (True, header(callerid="/me", md5sum=GEOMETRY.md5, service="/x"))
WELCOME = (False, header(callerid="/srv", md5sum=GEOMETRY.md5, type=GEOMETRY.name))
ASKED = (True, sized(struct.pack("<3f", 1.2, 5.2, 8.9)))
ANSWERED = (False, b"\1" + sized(struct.pack("<2f", 6.24, 55.536)))


def test_every_primitive_has_its_place_and_value() -> None:
    """Each byte belongs to a field, and the fields have the original values."""
    kind = compile_message("x/Everything", EVERYTHING)
    data = sized(body(kind, VALUES))
    pieces = request_pieces(data, kind)
    assert gapless(pieces, len(data))
    said = values(pieces)
    numbers = {name: str(VALUES[name]) for name in "abcdefghijkop"}
    assert {name: said[name] for name in numbers} == numbers
    assert said["l"] == "'ä b'"
    assert [said[name] for name in ("m.secs", "m.nsecs", "n.secs", "n.nsecs")] == ["1", "2", "-1", "3"]
    assert [said[name] for name in ("q[1]", "r[1]", "s[2]", "t.z", "v[0]")] == [
        "8",
        "'two'",
        "3.0",
        "3.0",
        "True",
    ]
    assert said["elements of u"] == "0"


@pytest.mark.parametrize("cut", range(0, 200, 7))
def test_bytes_that_were_cut_off_are_still_shown(cut: int) -> None:
    """The wire view shows the complete fields of a truncated message."""
    kind = compile_message("x/Everything", EVERYTHING)
    data = sized(body(kind, VALUES))[:cut]
    assert gapless(request_pieces(data, kind), len(data))
    assert gapless(reply_pieces(b"\1" + data, kind), len(data) + 1)


@pytest.mark.parametrize("seed", range(20))
def test_any_bytes_are_shown(seed: int) -> None:
    """The wire view can show random bytes without an error."""
    data = random.Random(seed).randbytes(300)  # noqa: S311 -- no secrets
    kind = compile_message("x/Everything", EVERYTHING)
    for pieces in (header_pieces(data), request_pieces(data, kind), reply_pieces(data, kind)):
        assert gapless(pieces, len(data))
        assert len(pieces) <= MOST + 2


def test_a_wrong_count_is_read_in_no_time() -> None:
    """A wrong element count in a message does not make the view slow."""
    kind = compile_message("x/Empties", "std_msgs/Empty[] nothing\nuint8 last")
    pieces = request_pieces(sized(b"\xff\xff\xff\xff\x05"), kind)
    assert values(pieces)["last"] == "5"


def test_long_values_are_shortened() -> None:
    """Long values are shortened to a few kilobytes."""
    kind = compile_message("x/Long", "uint8[] data\nstring text\ngeometry_msgs/Point[] points\nint32 last")
    point = {"x": 1.0, "y": 2.0, "z": 3.0}
    data = sized(
        body(kind, {"data": bytes(3_000_000), "text": "x" * 9999, "points": [point] * 3000, "last": 5})
    )
    pieces = request_pieces(data, kind)
    assert gapless(pieces, len(data))
    said = {piece["name"]: piece for piece in pieces}
    assert said["2,999,992 more of data"]["size"] == 2_999_992
    assert said["2,992 more of points"]["size"] == 2992 * 24
    assert said["last"]["value"] == "5"
    assert max(len(str(piece["hex"])) for piece in pieces) == 2 * SHOWN
    assert len(json.dumps(pieces)) < 20_000


def test_too_many_pieces_are_folded() -> None:
    """If a message has hundreds of fields, the wire view shows the last fields as one item."""
    kind = compile_message("x/Wide", "\n".join(f"int32 f{number}" for number in range(400)))
    data = sized(body(kind, {}))
    pieces = request_pieces(data, kind)
    assert gapless(pieces, len(data))
    assert len(pieces) == MOST + 1


def test_a_header_is_fields_with_their_lengths() -> None:
    """The wire view shows each header field with its length and its text."""
    data = header(callerid="/me", md5sum="30446f", note="ü=1")
    pieces = header_pieces(data)
    assert gapless(pieces, len(data))
    assert [piece["value"] for piece in pieces if piece["role"] in ("key", "md5")] == ["/me", "30446f", "ü=1"]
    assert pieces[-2]["value"] == str(len("note=ü=1".encode()))


def test_the_steps_of_a_call() -> None:
    """A call has these steps: connection, two headers, request, response, and end of the connection.

    The time of each step is in ms since the first step.
    """
    wire = Wire(
        "/x",
        uri="rosrpc://localhost:1",
        connections=[connection(GREETED, WELCOME, ASKED, ANSWERED)],
        kind=GEOMETRY,
    )
    told = state(wire, unknown)
    assert [step["title"] for step in told["steps"]] == [
        "Connects to localhost:1",
        "Connection header of the client",
        "Connection header of the server",
        "Request",
        "Response",
        "The connection is closed",
    ]
    assert [step["ms"] for step in told["steps"]] == [0.0, 0.0, 1.0, 2.0, 3.0, 3.0]
    assert told["names"] == {"client": "/me", "server": "/srv", "master": "master"}


def test_bytes_that_came_in_pieces_are_one_step() -> None:
    """The steps do not depend on how TCP splits the bytes."""
    whole = WELCOME[1] + ANSWERED[1]
    drops = [(False, whole[at : at + 1]) for at in range(len(whole))]
    assert titles(connection((True, GREETED[1] + ASKED[1]), *drops)) == titles(
        connection(GREETED, WELCOME, ASKED, ANSWERED)
    )


def test_a_persistent_connection_has_many_requests() -> None:
    """On a persistent connection, each request comes before its response."""
    steps = titles(connection(GREETED, WELCOME, ASKED, ANSWERED, ASKED, ANSWERED))
    assert steps[3:7] == ["Request", "Response", "Request", "Response"]


def test_failures_are_distinguished() -> None:
    """The view distinguishes an error response, a refused header, a lost connection and a missing server."""
    refusal = (False, b"\0" + sized(b"no"))
    assert "Error" in titles(connection(GREETED, WELCOME, ASKED, refusal))
    turned_away = (False, header(error="md5sums do not match"))
    steps = titles(connection(GREETED, turned_away))
    assert "The server refuses the connection" in steps
    assert "Request" not in steps
    assert (
        titles(connection(GREETED, WELCOME, ASKED, closed_by="server"))[-1]
        == "The server closes without a response"
    )
    assert titles(connection(GREETED))[-1] == "The client gives up"
    assert titles(RelayedConnection(10.0, refused="Connection refused")) == [
        "No process accepts the connection at localhost:1"
    ]
    probe = (True, header(probe="1", md5sum="*", callerid="/me", service="/x"))
    assert "Connection header of the client (only a probe)" in titles(connection(probe, WELCOME))


def test_a_type_that_is_not_known_is_shown_as_bytes() -> None:
    """If the type is unknown, the wire view shows the body as bytes."""
    wire = Wire("/x", connections=[connection(GREETED, WELCOME, ASKED, ANSWERED)])
    request = next(step for step in state(wire, unknown)["steps"] if step["title"] == "Request")
    assert [piece["role"] for piece in request["pieces"]] == ["length", "raw"]


def test_many_steps_are_limited_with_a_note() -> None:
    """If there are too many calls, the wire view shows only the first steps and the total number."""
    wire = Wire(
        "/x", connections=[connection(GREETED, WELCOME, *[ASKED, ANSWERED] * 50)], kind=GEOMETRY, skipped=3
    )
    told = state(wire, unknown)
    assert len(told["steps"]) == STEPS
    assert any(f"first {STEPS} of 104" in note for note in told["notes"])
    assert any("3 more connections" in note for note in told["notes"])


def test_the_widget_has_a_stable_repr_and_a_small_state() -> None:
    """The plain text of the widget is the same in every run."""
    view = WireView(Wire("/x", connections=[connection(GREETED, WELCOME, ASKED, ANSWERED)], kind=GEOMETRY))
    assert repr(view) == "WireView('/x')"
    assert (view.from_client, view.from_server) == (GREETED[1] + ASKED[1], WELCOME[1] + ANSWERED[1])
    assert len(json.dumps(view.exchange)) < 8000
    assert WireView(Wire("/x")).exchange["steps"] == []
