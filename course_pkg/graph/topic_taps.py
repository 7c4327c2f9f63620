"""Where rospy's messages are listened to, on both ends, for the flight recorder.

A message is known by what is on the wire: the connection it went over, named by its TCP ports, and its number
there. A queue may drop messages before they are written, so they are counted as they are written; a
subscriber may throw messages away after they have arrived, so they are counted as they arrive. rospy has no
hooks for any of this, so a few of its methods are replaced; a rospy that is built differently is left alone.
"""

from __future__ import annotations

import struct
from contextlib import suppress
from io import BytesIO
from typing import Any

from rospy.impl import tcpros_pubsub
from rospy.impl.tcpros_pubsub import TCPROSHandler, TCPROSSub
from rospy.topics import _PublisherImpl, _SubscriberImpl

from course_pkg.graph.events import CALLBACK, PUBLISH
from course_pkg.graph.taps import MADE_HERE, Method, Tap, Transport, put_all
from course_pkg.graph.trace import Connection, Mark, Wire, recorder

BLIND = "messages: this rospy publishes and receives them otherwise"
LEFT_OUT = "/rosout"  # what nodes log is not what a recording is made for, and each call may log
ARRIVED = "arrived_by_course"  # an attribute of what reads a connection: how many messages have arrived on it
TO_ONE = "sent to one new subscriber alone"


def tap_topics() -> bool:
    """Have what this process publishes and hears recorded; say whether it could be done."""
    taps = (
        Tap(TCPROSSub, "read_messages", ("self", "b", "msg_queue", "sock"), _reading),
        Tap(
            _PublisherImpl,
            "publish",
            ("self", "message", "connection_override"),
            _publishing,
            uses=["buff", "getvalue"],
        ),
        Tap(_SubscriberImpl, "receive_callback", ("self", "msgs", "connection"), _receiving),
        Tap(_SubscriberImpl, "_invoke_callback", ("self", "msg", "cb", "cb_args"), _calling_back),
    )
    connects = ("self", "resolved_name", "pub_uri", "protocol_params")
    accepts = ("self", "sock", "client_addr", "header")
    used = (
        Tap(TCPROSHandler, "create_transport", connects, _same, uses=[MADE_HERE]),
        Tap(TCPROSHandler, "topic_connection_handler", accepts, _same, uses=[MADE_HERE]),
    )
    done = put_all(taps, tcpros_pubsub, RecordedTopicTransport, used)
    if not done:
        recorder().blind.add(BLIND)
    return done


class Stamped(bytes):
    """The bytes of a message, which know as what they were published."""

    mark: Mark


class StampingBuffer(BytesIO):
    """A publisher's buffer, whose contents bear the mark of the message that is being published."""

    mark: Mark | None = None

    def getvalue(self) -> bytes:
        """Return the contents."""
        if self.mark is None:
            return super().getvalue()
        with self.getbuffer() as view:
            data = Stamped(view)
        data.mark = self.mark
        return data


class RecordedTopicTransport(Transport):  # type: ignore[misc]  # rospy has no types
    """One end of a topic's connection, which counts what passes."""

    connection: Connection | None = None
    written = 0

    def set_socket(self, sock: Any, endpoint_id: str) -> None:  # noqa: ANN401
        """Take over a connection, at the publisher."""
        super().set_socket(sock, endpoint_id)
        with suppress(OSError):  # it may have gone already
            self.connection = (sock.getpeername(), self.local_endpoint[1])

    def connect(self, dest_addr: str, dest_port: int, endpoint_id: str, timeout: float | None = None) -> None:
        """Connect, or connect again, at the subscriber."""
        self.connection = None
        setattr(self.protocol, ARRIVED, 0)
        super().connect(dest_addr, dest_port, endpoint_id, timeout)
        self.connection = (self.local_endpoint, dest_port)

    def write_data(self, data: bytes) -> Any:  # noqa: ANN401
        """Send a message, of which it is on record where it goes before anybody can have it."""
        if not isinstance(data, Stamped) or self.connection is None:
            return super().write_data(data)
        self.written += 1
        wire = (self.connection, self.written, self.endpoint_id)
        data.mark.wires.append(wire)
        try:
            return super().write_data(data)
        except BaseException:
            data.mark.wires.remove(wire)
            raise


class _Batch:
    """Messages that a subscriber is handing to its callbacks, with the number of each on its connection."""

    __slots__ = ("_connection", "_first", "_msgs", "_peer", "_place")

    def __init__(self, msgs: list[Any], connection: RecordedTopicTransport) -> None:
        protocol = connection.protocol  # gone when the connection has been closed meanwhile
        self._peer = str(connection.callerid_pub)
        self._connection = connection.connection if protocol is not None else None
        self._first = getattr(protocol, ARRIVED, 0) - len(msgs) + 1 if protocol is not None else 0
        self._msgs = msgs
        self._place = 0

    def wires(self, msg: Any) -> list[Wire]:  # noqa: ANN401
        """Return how the message is known on both ends; callbacks get them in the order of the batch."""
        for place in range(self._place, len(self._msgs)):
            if self._msgs[place] is msg and self._connection is not None:
                self._place = place
                return [(self._connection, self._first + place, self._peer)]
        return []  # a latched message of another topic, to which this callback subscribes


def _publishing(bare: Method) -> Method:
    def publish(self: _PublisherImpl, message: Any, connection_override: Any = None) -> Any:  # noqa: ANN401
        if self.resolved_name == LEFT_OUT:
            return bare(self, message, connection_override)
        mark = recorder().begin(PUBLISH, self.resolved_name, "", [])
        mark.asked = len(self.connections) if connection_override is None else 1
        mark.note = "" if connection_override is None else TO_ONE
        if type(self.buff) is BytesIO:
            self.buff = StampingBuffer()
        if isinstance(self.buff, StampingBuffer):
            self.buff.mark = mark
        try:
            return bare(self, message, connection_override)
        finally:
            recorder().end(mark)

    return publish


def _reading(bare: Method) -> Method:
    def read_messages(self: TCPROSSub, b: BytesIO, msg_queue: list[Any], sock: Any) -> None:  # noqa: ANN401
        arrived = _whole_messages(b)  # more than what a subscriber's own queue lets through
        bare(self, b, msg_queue, sock)
        setattr(self, ARRIVED, getattr(self, ARRIVED, 0) + arrived)

    return read_messages


def _receiving(bare: Method) -> Method:
    def receive_callback(self: _SubscriberImpl, msgs: list[Any], connection: Any) -> None:  # noqa: ANN401
        here = recorder().here
        here.batch = _Batch(msgs, connection) if isinstance(connection, RecordedTopicTransport) else None
        try:
            bare(self, msgs, connection)
        finally:
            here.batch = None

    return receive_callback


def _calling_back(bare: Method) -> Method:
    def _invoke_callback(self: _SubscriberImpl, msg: Any, cb: Any, cb_args: Any) -> None:  # noqa: ANN401
        if self.resolved_name == LEFT_OUT:
            bare(self, msg, cb, cb_args)
            return
        batch = recorder().here.batch  # None for a latched message that a later callback gets
        wires = batch.wires(msg) if batch is not None else []
        peer = wires[0][2] if wires else ""
        mark = recorder().begin(CALLBACK, self.resolved_name, peer, wires)
        try:
            bare(self, msg, cb, cb_args)
        finally:
            recorder().end(mark)

    return _invoke_callback


def _same(bare: Method) -> Method:
    return bare


def _whole_messages(b: BytesIO) -> int:
    """Count the messages that have arrived in full: each is its length (4 bytes) and so many bytes."""
    count, place, end = 0, 0, b.tell()
    with b.getbuffer() as view:
        while place + 4 <= end:
            place += 4 + struct.unpack_from("<I", view, place)[0]
            count += place <= end
    return count
