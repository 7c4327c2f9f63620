"""The program of a topic process, started by `python -m course_pkg.ros.topic.main DESCRIPTOR TOPIC`.

The process receives commands through its channel. The field "do" contains the name of a command; the other
fields are:

    type      name, text           the type of the topic; text is "" if the type is built
    publish   texts, latch, queue, count
    repeat    texts, latch, queue, rate
    stop, withdraw
    plot      path                 record the values of this number; "" for no number

The process sends a Report at most ten times per second, and ends when the channel is closed.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import suppress

import genpy
import rospy

from course_pkg.errors import ChannelClosed, CourseError, FieldError, GraphError
from course_pkg.ros.node.preparation import prepare_node
from course_pkg.ros.protocol.json_channel import Json, JsonChannel
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.rospy_registrations import node_known, register_all
from course_pkg.ros.topic.connections import find_connections
from course_pkg.ros.topic.field_paths import extractor
from course_pkg.ros.topic.publishing import Commands
from course_pkg.ros.topic.reports import Connections, Curve, MessageReport, Report
from course_pkg.ros.topic.subscription import ReceivedMessage, TopicSubscription
from course_pkg.types import MessageType, StringTree, compile_message, message_type

REPORT_INTERVAL = 0.1  # Two reports have at least this time in s between them.
SELDOM = 3  # Only every third report contains the data that takes long to compute or to send.
GRAPH_INTERVAL = 1.0  # This is the time in s between two requests to the master.


class TopicNode:
    """Publishes and subscribes on the topic `topic`, as a separate node."""

    def __init__(self, channel: JsonChannel, topic: str) -> None:
        self._channel = channel
        self._topic = topic
        self._start = time.monotonic()
        self._master = MasterClient(master_uri())
        self._commands = Commands(topic)
        self._kind: MessageType | None = None
        self._subscription: TopicSubscription
        self._sent: dict[str, object] = {}
        self._reports = 0
        self._trouble = ""
        self._connections: Connections = {}
        self._registering = threading.Lock()  # This lock prevents a registration after leave().

    def run(self) -> None:
        """Execute commands until the channel is closed."""
        with suppress(ChannelClosed):
            self._join()
            for work, pause in ((self._report, REPORT_INTERVAL), (self._look, GRAPH_INTERVAL)):
                threading.Thread(target=self._repeat, args=(work, pause), daemon=True).start()
            while True:
                command = self._channel.receive()
                assert command is not None
                self._follow(command)

    def leave(self) -> None:
        """Unregister the node."""
        with self._registering:
            if rospy.core.is_initialized():
                rospy.signal_shutdown("the panel is no longer shown")

    def _join(self) -> None:
        """Become a node.

        As long as no master answers, report the error; rospy would wait without a message.
        """
        while True:
            try:
                self._master.pid()
                break
            except GraphError as error:
                self._channel.send({"trouble": str(error)})
                time.sleep(GRAPH_INTERVAL)
        rospy.init_node(f"topic_panel_{os.getpid()}", disable_signals=True)
        prepare_node()
        self._subscription = TopicSubscription(self._topic)

    def _follow(self, command: dict[str, Json]) -> None:
        does: dict[str, Callable[..., None]] = {
            "type": self._set_type,
            "publish": self._commands.publish,
            "repeat": self._commands.repeat,
            "stop": self._commands.stop,
            "withdraw": self._commands.withdraw,
            "plot": self._plot,
        }
        self._commands.problem = ""
        try:
            does[str(command.pop("do"))](**command)
        except (CourseError, rospy.ROSException, ValueError) as error:
            self._commands.problem = str(error)

    def _set_type(self, name: str, text: str) -> None:
        self._kind = compile_message(name, text) if text else message_type(name)
        self._commands.kind = self._kind

    def _plot(self, path: str) -> None:
        if self._kind is not None:
            self._subscription.plot(self._kind.md5, extractor(self._kind, path) if path else None)

    def _repeat(self, work: Callable[[], None], pause: float) -> None:
        while not rospy.is_shutdown():
            try:
                work()
            except ChannelClosed:
                return  # The main thread gets the same error, and ends the process.
            time.sleep(pause)

    def _look(self) -> None:
        """Find the nodes on the topic, and register again after a restart of the master."""
        try:
            with self._registering:
                # After leave(), the node is not registered, and this method must not register it again.
                if not rospy.is_shutdown() and not node_known(self._master):
                    register_all(self._master)
            self._connections = find_connections(self._master, self._topic)
            self._trouble = ""
        except GraphError as error:
            self._trouble = str(error)

    def _report(self) -> None:
        parts = self._parts()
        changed = {part: value for part, value in parts.items() if value != self._sent.get(part)}
        self._sent |= changed
        if messages := [self._message(message) for message in self._subscription.new_messages()]:
            changed["messages"] = messages
        if changed:
            self._channel.send(changed)

    def _parts(self) -> Report:
        sources = self._subscription.sources()
        parts: Report = {
            "trouble": self._trouble,
            "node": rospy.get_name(),
            "connections": {**self._connections, "sources": sources} if self._connections else {},
            "publisher": self._commands.state(),
            "count": self._subscription.count,
        }
        self._reports += 1
        if self._reports % SELDOM:
            return parts
        statistics = self._subscription.rate.figures(time.monotonic())
        return parts | {"statistics": statistics, "curve": self._curve()}

    def _curve(self) -> Curve:
        series = self._subscription.series
        points = [[round(at - self._start, 3), value] for at, value in series.points(time.monotonic())]
        return {"points": points, "count": series.count, "left_out": series.left_out}

    def _message(self, message: ReceivedMessage) -> MessageReport:
        return {
            "number": message.number,
            "peer": message.peer,
            "type": message.type,
            "md5": message.md5,
            "size": message.size,
            "ago": round(time.monotonic() - message.at, 3),
            "texts": self._strings(message),
        }

    def _strings(self, message: ReceivedMessage) -> Mapping[str, StringTree] | None:
        kind = self._kind or self._sender_kind(message.type)
        if kind is None or message.md5 != kind.md5 or len(message.body) != message.size:
            return None
        try:
            strings = kind.format(kind.to_values(kind.cls().deserialize(message.body)))
        except (genpy.DeserializationError, FieldError):
            return None
        assert isinstance(strings, dict)  # A message is shown as a dict of its fields.
        return strings

    def _sender_kind(self, name: str) -> MessageType | None:
        """Return the type that a publisher sends, or None if the type is not installed."""
        try:
            return message_type(name)
        except CourseError:
            return None


def main(argv: list[str]) -> None:
    """Run a topic node until its channel is closed, then unregister."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)  # The process ends when its channel is closed.
    node = TopicNode(JsonChannel(socket.socket(fileno=int(argv[1]))), argv[2])
    node.run()
    node.leave()
    os._exit(0)  # The process ends without waiting for rospy's threads.


if __name__ == "__main__":
    main(sys.argv)
