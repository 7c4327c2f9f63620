"""Read many topics on one thread for a panel that draws their messages.

A subscriber of rospy wakes up for each message. At hundreds of messages per second, such a subscriber uses
too much CPU time. The reader therefore uses TCPROS (http://wiki.ros.org/ROS/TCPROS) without rospy, and reads
all new messages every 50 ms. The reader does not register as a subscriber, because a panel should not change
the graph.
"""

from __future__ import annotations

import socket
import struct
import threading
import time
from collections.abc import Callable, Collection
from contextlib import suppress

from course_pkg.errors import GraphError
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.probe import ask_all, encode_header, rpc_answer, rpc_probe
from course_pkg.ros.protocol.xmlrpc import number

INTERVAL = 0.05  # This is the time in s between two reads.
SEARCH = 1.0  # This is the time in s between two requests to the master.
TIMEOUT = 0.5  # A node has to respond within this time in s.
# If a message is longer than this number of bytes, the reader closes the connection.
LONGEST = 1 << 20
CHUNK = 1 << 16  # One read returns at most this number of bytes.
CALLER = "/course"

Place = tuple[str, str]  # The tuple contains a topic, and the address of a node that publishes on this topic.
Received = Callable[[str, list[bytes]], None]


class BulkReader:
    """Reads all topics of the given types, from start() to stop().

    The reader calls the function `received` with a topic and its new messages. The messages are serialised
    and in order. The reader calls the function `missing` with a topic that no longer has a publisher. The
    reader calls the function `done` after each read. All three functions run on the reader's thread.
    """

    def __init__(
        self,
        types: Collection[str],
        received: Received,
        missing: Callable[[str], None],
        done: Callable[[], None],
    ) -> None:
        self._types = frozenset(types)
        self._received = received
        self._missing = missing
        self._done = done
        self._stop: threading.Event | None = None

    def start(self) -> None:
        """Start to read; a second call has no effect."""
        if self._stop is None:
            self._stop = threading.Event()
            thread = threading.Thread(target=self._read, args=(self._stop,), daemon=True, name="bulk-reader")
            thread.start()

    def stop(self) -> None:
        """Stop before the next read; do not wait for the end of the thread."""
        if self._stop is not None:
            self._stop.set()
            self._stop = None

    def _read(self, stop: threading.Event) -> None:
        streams: Streams = {}
        search_at = 0.0
        try:
            while not stop.wait(INTERVAL):
                if time.monotonic() >= search_at:
                    self._search(streams)
                    search_at = time.monotonic() + SEARCH
                if not self._drain(streams):
                    search_at = 0.0
                self._done()
        finally:
            for stream in streams.values():
                stream.close()

    def _drain(self, streams: Streams) -> bool:
        """Pass all new messages to the function `received`; return whether all streams are still open."""
        ended = []
        for place, stream in streams.items():
            messages, goes_on = stream.read()
            if messages:
                self._received(place[0], messages)
            if not goes_on:
                ended.append(place)
        self._forget(streams, ended)
        return not ended

    def _search(self, streams: Streams) -> None:
        """Connect to new publishers, and disconnect from publishers that are no longer registered."""
        try:
            places = self._places()
        except GraphError:  # Without a master, the reader continues with its open streams.
            return
        self._forget(streams, [place for place in streams if place not in places])
        new = sorted(places - streams.keys())
        probes = [rpc_probe(uri, "requestTopic", topic, [["TCPROS"]]) for topic, uri in new]
        ask_all(probes, TIMEOUT)
        for place, probe in zip(new, probes, strict=True):
            answer = rpc_answer(probe)
            if isinstance(answer, list) and answer[:1] == ["TCPROS"]:
                with suppress(OSError):  # The publisher may have ended. The next search tries again.
                    streams[place] = _Stream(place[0], (str(answer[1]), int(number(answer[2]))))

    def _places(self) -> set[Place]:
        master = MasterClient(master_uri(), TIMEOUT)
        kinds, publishers = master.topic_types(), master.system_state().publishers
        wanted = {topic: nodes for topic, nodes in publishers.items() if kinds.get(topic) in self._types}
        uris, _ = master.lookup_all({node for nodes in wanted.values() for node in nodes}, ())
        return {(topic, uris[node]) for topic, nodes in wanted.items() for node in nodes if node in uris}

    def _forget(self, streams: Streams, places: list[Place]) -> None:
        for place in places:
            streams.pop(place).close()
        for topic in {topic for topic, _ in places} - {topic for topic, _ in streams}:
            self._missing(topic)


class _Stream:
    """A connection to one publisher of one topic."""

    def __init__(self, topic: str, address: tuple[str, int]) -> None:
        fields = {"callerid": CALLER, "topic": topic, "type": "*", "md5sum": "*", "tcp_nodelay": "1"}
        self._sock = socket.create_connection(address, TIMEOUT)
        self._sock.sendall(encode_header(fields))
        self._sock.setblocking(False)
        self._rest = b""
        self._header_read = False

    def read(self) -> tuple[list[bytes], bool]:
        """Return the new messages since the previous call, and whether the stream is still open."""
        goes_on = True
        try:
            while part := self._sock.recv(CHUNK):
                self._rest += part
                if len(part) < CHUNK:
                    break
            goes_on = bool(part)
        except BlockingIOError:
            pass
        except OSError:
            goes_on = False
        return self._blocks(), goes_on and len(self._rest) < LONGEST

    def close(self) -> None:
        """Close the connection."""
        self._sock.close()

    def _blocks(self) -> list[bytes]:
        """Take all complete messages out of the received bytes; return them without the connection header."""
        blocks, at = [], 0
        while len(self._rest) >= at + 4:
            (length,) = struct.unpack_from("<I", self._rest, at)
            if len(self._rest) < at + 4 + length:
                break
            blocks.append(self._rest[at + 4 : at + 4 + length])
            at += 4 + length
        self._rest = self._rest[at:]
        if blocks and not self._header_read:
            self._header_read = True
            del blocks[0]
        return blocks


Streams = dict[Place, _Stream]
