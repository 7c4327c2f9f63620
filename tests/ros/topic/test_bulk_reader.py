"""Tests of the bulk reader, which reads many topics at the same time."""

from __future__ import annotations

import threading

from course_pkg.ros import NodeProcess, PrivateMaster, look
from course_pkg.ros.topic.bulk_reader import BulkReader
from tests.support import eventually


class Notes:
    """Stores everything that a bulk reader passes to its callbacks."""

    def __init__(self) -> None:
        self.heard: dict[str, list[bytes]] = {}
        self.missed: list[str] = []
        self.looks = 0

    def hear(self, topic: str, messages: list[bytes]) -> None:
        """Store messages."""
        self.heard.setdefault(topic, []).extend(messages)

    def look(self) -> None:
        """Count the reads."""
        self.looks += 1

    def reader(self) -> BulkReader:
        """Return a bulk reader that has methods of this object as callbacks."""
        return BulkReader(["std_msgs/UInt32"], self.hear, self.missed.append, self.look)


def pulse(name: str) -> NodeProcess:
    """Start a node that publishes 50 numbers per second."""
    return NodeProcess(["rosrun", "course_pkg", "pulse", f"__name:={name}", f"pulse:={name}", "_rate:=50"])


def test_every_message_in_order(master: PrivateMaster) -> None:
    """The messages of several topics arrive in order, and each message arrives once."""
    notes = Notes()
    reader = notes.reader()
    with pulse("one"), pulse("two"):
        reader.start()
        reader.start()
        eventually(lambda: all(len(notes.heard.get(topic, ())) > 40 for topic in ("/one", "/two")))
        reader.stop()
    numbers = [int.from_bytes(message, "little") for message in notes.heard["/one"]]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_the_reader_is_not_a_subscriber(master: PrivateMaster) -> None:
    """The reader is not a subscriber of the topic."""
    notes = Notes()
    reader = notes.reader()
    with pulse("alone"):
        reader.start()
        eventually(lambda: notes.heard.get("/alone"))
        assert next(topic for topic in look().topics if topic.name == "/alone").subscribers == ()
        reader.stop()


def test_a_publisher_that_ends_and_returns(master: PrivateMaster) -> None:
    """The reader reports the end of a publisher, and reads the messages of a new publisher."""
    notes = Notes()
    reader = notes.reader()
    reader.start()
    with pulse("brief"):
        eventually(lambda: notes.heard.get("/brief"))
    eventually(lambda: notes.missed == ["/brief"])
    notes.heard.clear()
    with pulse("brief"):
        eventually(lambda: notes.heard.get("/brief"))
    reader.stop()


def test_stop_ends_the_reader(master: PrivateMaster) -> None:
    """stop() ends the reader's thread, and start() starts a new thread."""
    notes = Notes()
    reader = notes.reader()
    reader.start()
    eventually(lambda: notes.looks > 2)
    reader.stop()
    eventually(lambda: not _threads())
    reader.start()
    before = notes.looks
    eventually(lambda: notes.looks > before)
    reader.stop()


def _threads() -> list[str]:
    return [thread.name for thread in threading.enumerate() if thread.name == "bulk-reader"]
