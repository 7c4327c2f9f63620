"""The recorder's hooks for messages, in rospy's publishers and subscribers.

A message is identified by its connection (the TCP ports) and by its number on this connection. The publisher
counts the messages that it sends: its queue may drop messages before it sends them. The subscriber counts the
messages that arrive: its queue may drop messages after their arrival.

rospy has no hooks for messages, so this module replaces a few methods of rospy. If the installed release of
rospy has different methods, the module changes nothing.
"""

from __future__ import annotations

import socket
import struct
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from io import BytesIO
from typing import TypeVar

import genpy
from rospy.impl import tcpros_pubsub
from rospy.impl.tcpros_base import TCPROSTransport
from rospy.impl.tcpros_pubsub import TCPROSHandler, TCPROSSub
from rospy.topics import _PublisherImpl, _SubscriberImpl

from course_pkg.ros.trace.hooks import TRANSPORT, Hook, Method, install_all
from course_pkg.ros.trace.recorder import Connection, Span, Transfer, recorder
from course_pkg.ros.trace.recording import CALLBACK, PUBLISH

UNSUPPORTED = "messages: this rospy publishes and receives them in another way"
LEFT_OUT = "/rosout"  # Log messages would fill a recording.
# This attribute of a connection's protocol contains the number of arrived messages.
ARRIVED = "arrived_by_course"
TO_ONE = "sent only to one new subscriber"

Args = TypeVar("Args")
R = TypeVar("R")


def hook_topics() -> bool:
    """Record this process's messages from now on; return whether the hooks fit this release of rospy."""
    hooks = (
        Hook(TCPROSSub, "read_messages", ("self", "b", "msg_queue", "sock"), _counting_messages),
        Hook(
            _PublisherImpl,
            "publish",
            ("self", "message", "connection_override"),
            _recording_publish,
            uses=["buff", "getvalue"],
        ),
        Hook(_SubscriberImpl, "receive_callback", ("self", "msgs", "connection"), _numbering_messages),
        Hook(_SubscriberImpl, "_invoke_callback", ("self", "msg", "cb", "cb_args"), _recording_callback),
    )
    connects = ("self", "resolved_name", "pub_uri", "protocol_params")
    accepts = ("self", "sock", "client_addr", "header")
    required = (
        Hook(TCPROSHandler, "create_transport", connects, _unchanged, uses=[TRANSPORT]),
        Hook(TCPROSHandler, "topic_connection_handler", accepts, _unchanged, uses=[TRANSPORT]),
    )
    done = install_all(hooks, tcpros_pubsub, RecordedTopicTransport, required)
    if not done:
        recorder().unsupported.add(UNSUPPORTED)
    return done


class TaggedBytes(bytes):
    """The bytes of a message; `span` records that the message was published."""

    span: Span


class TaggingBuffer(BytesIO):
    """A publisher's buffer; it stores the span of the message that is being published."""

    span: Span | None = None

    def getvalue(self) -> bytes:
        """Return the contents; if the message has a span, return TaggedBytes."""
        if self.span is None:
            return super().getvalue()
        with self.getbuffer() as view:
            data = TaggedBytes(view)
        data.span = self.span
        return data


class RecordedTopicTransport(TCPROSTransport):
    """A publisher's or subscriber's connection that counts its messages."""

    connection: Connection | None = None
    written = 0

    def set_socket(self, sock: socket.socket, endpoint_id: str) -> None:
        """Use a connection that the publisher has accepted."""
        TCPROSTransport.set_socket(self, sock, endpoint_id)
        with suppress(OSError):  # The subscriber may have closed the connection.
            self.connection = (sock.getpeername(), self.local_endpoint[1])

    def connect(self, dest_addr: str, dest_port: int, endpoint_id: str, timeout: float | None = None) -> None:
        """Connect a subscriber to a publisher, for the first time or again."""
        self.connection = None
        setattr(self.protocol, ARRIVED, 0)
        TCPROSTransport.connect(self, dest_addr, dest_port, endpoint_id, timeout)
        self.connection = (self.local_endpoint, dest_port)

    def write_data(self, data: bytes) -> bool:
        """Send a message.

        The message is recorded before it is sent, because a subscriber may receive the message immediately.
        """
        if not isinstance(data, TaggedBytes) or self.connection is None:
            return bool(TCPROSTransport.write_data(self, data))
        self.written += 1
        transfer = (self.connection, self.written, self.endpoint_id)
        data.span.transfers.append(transfer)
        try:
            return bool(TCPROSTransport.write_data(self, data))
        except BaseException:
            data.span.transfers.remove(transfer)
            raise


class Batch:
    """Messages that a subscriber passes to its callbacks, with their numbers on the connection."""

    __slots__ = ("_connection", "_first", "_index", "_msgs", "_peer")

    def __init__(self, msgs: list[genpy.Message], connection: RecordedTopicTransport) -> None:
        protocol = connection.protocol  # The protocol is None if the connection was closed.
        self._peer = str(connection.callerid_pub)
        self._connection = connection.connection if protocol is not None else None
        self._first = getattr(protocol, ARRIVED, 0) - len(msgs) + 1 if protocol is not None else 0
        self._msgs = msgs
        self._index = 0

    def transfers(self, msg: genpy.Message) -> list[Transfer]:
        """Return [(connection, message number, publisher)] of a message.

        Pass the messages in the order of the batch.
        """
        for index in range(self._index, len(self._msgs)):
            if self._msgs[index] is msg and self._connection is not None:
                self._index = index
                return [(self._connection, self._first + index, self._peer)]
        # A callback may subscribe to another topic; `msg` is then a latched message of this other topic.
        return []


class _Current(threading.local):
    """The messages that a thread is passing to callbacks."""

    batch: Batch | None = None


@cache
def _current() -> _Current:
    """Return the only _Current of this process."""
    return _Current()


def _recording_publish(
    method: Callable[[_PublisherImpl, genpy.Message, TCPROSTransport | None], R],
) -> Callable[[_PublisherImpl, genpy.Message, TCPROSTransport | None], R]:
    def publish(
        self: _PublisherImpl, message: genpy.Message, connection_override: TCPROSTransport | None = None
    ) -> R:
        if self.resolved_name == LEFT_OUT:
            return method(self, message, connection_override)
        span = recorder().begin(PUBLISH, self.resolved_name, "", [])
        span.connections = len(self.connections) if connection_override is None else 1
        span.note = "" if connection_override is None else TO_ONE
        if type(self.buff) is BytesIO:
            self.buff = TaggingBuffer()
        if isinstance(self.buff, TaggingBuffer):
            self.buff.span = span
        try:
            return method(self, message, connection_override)
        finally:
            recorder().end(span)

    return publish


def _counting_messages(
    method: Callable[[TCPROSSub, BytesIO, list[genpy.Message], socket.socket], R],
) -> Callable[[TCPROSSub, BytesIO, list[genpy.Message], socket.socket], R]:
    def read_messages(self: TCPROSSub, b: BytesIO, msg_queue: list[genpy.Message], sock: socket.socket) -> R:
        arrived = _whole_messages(b)  # Count the messages before the subscriber's queue can drop messages.
        result = method(self, b, msg_queue, sock)
        setattr(self, ARRIVED, getattr(self, ARRIVED, 0) + arrived)
        return result

    return read_messages


def _numbering_messages(
    method: Callable[[_SubscriberImpl, list[genpy.Message], TCPROSTransport], R],
) -> Callable[[_SubscriberImpl, list[genpy.Message], TCPROSTransport], R]:
    def receive_callback(self: _SubscriberImpl, msgs: list[genpy.Message], connection: TCPROSTransport) -> R:
        current = _current()
        current.batch = Batch(msgs, connection) if isinstance(connection, RecordedTopicTransport) else None
        try:
            return method(self, msgs, connection)
        finally:
            current.batch = None

    return receive_callback


def _recording_callback(
    method: Callable[[_SubscriberImpl, genpy.Message, Callable[..., object], Args], R],
) -> Callable[[_SubscriberImpl, genpy.Message, Callable[..., object], Args], R]:
    def _invoke_callback(
        self: _SubscriberImpl, msg: genpy.Message, cb: Callable[..., object], cb_args: Args
    ) -> R:
        if self.resolved_name == LEFT_OUT:
            return method(self, msg, cb, cb_args)
        batch = _current().batch  # It is None if a new callback receives an old latched message.
        transfers = batch.transfers(msg) if batch is not None else []
        peer = transfers[0][2] if transfers else ""
        span = recorder().begin(CALLBACK, self.resolved_name, peer, transfers)
        try:
            return method(self, msg, cb, cb_args)
        finally:
            recorder().end(span)

    return _invoke_callback


def _unchanged(method: Method) -> Method:
    return method


def _whole_messages(b: BytesIO) -> int:
    """Return the number of complete messages; each message begins with its length (4 bytes)."""
    count, offset, end = 0, 0, b.tell()
    with b.getbuffer() as view:
        while offset + 4 <= end:
            offset += 4 + struct.unpack_from("<I", view, offset)[0]
            count += offset <= end
    return count
