"""The process of a station, with its wire: `python -m course_pkg.graph.station.main DESCRIPTOR TOPIC`.

It is told, one command a line, by "do":

    type      name, text           the type of the topic; text is "" for one that is built
    publish   texts, latch, queue, count
    repeat    texts, latch, queue, rate
    stop, withdraw
    plot      path                 draw a curve of this number; "" for none

and tells, at most ten times a second, the parts that have changed:

    trouble   why it cannot see the graph, "" when it can
    node      its own name on the graph
    around    who is on the topic: Neighbourhood, and the sources that are connected
    spoken    what became of what it published: Desk.as_dict
    count     of messages heard
    pace      of these: Pace.figures
    echo      new messages: number, ago (s), peer, type, md5, size, texts (null where they cannot be shown)
    curve     points as [time in s from the start, value], how many values there were, and how many left out

It ends when the wire does.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
import time
from contextlib import suppress
from typing import Any

import genpy
import rospy

from course_pkg.errors import CourseError, FieldError, GraphError
from course_pkg.graph.master import master_uri
from course_pkg.graph.preparation import prepare_node
from course_pkg.graph.registrar import node_known, register_all
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.station.desk import Desk
from course_pkg.graph.station.ears import Ears, Sound
from course_pkg.graph.station.neighbours import look_around
from course_pkg.graph.station.paths import extractor
from course_pkg.graph.station.wire import Wire
from course_pkg.interfaces import MessageType, compile_message, message_type

TELL = 0.1  # s between two reports
SELDOM = 3  # what is long to work out or to send is in every third
LOOK = 1.0  # s between two looks at the graph


class Station:
    """Publishes and listens on `topic`, as a node of its own."""

    def __init__(self, wire: Wire, topic: str) -> None:
        self._wire = wire
        self._topic = topic
        self._start = time.monotonic()
        self._master = MasterClient(master_uri())
        self._desk = Desk(topic)
        self._kind: MessageType | None = None
        self._ears: Ears
        self._sent: dict[str, Any] = {}
        self._told = 0
        self._trouble = ""
        self._around: dict[str, Any] = {}
        self._registering = threading.Lock()  # so that nothing registers once it has signed off

    def run(self) -> None:
        """Do what one is told until the wire ends."""
        with suppress(EOFError):
            self._join()
            for work, pause in ((self._tell, TELL), (self._look, LOOK)):
                threading.Thread(target=self._again, args=(work, pause), daemon=True).start()
            while True:
                command = self._wire.receive()
                assert command is not None
                self._obey(command)

    def leave(self) -> None:
        """Sign off."""
        with self._registering:
            if rospy.core.is_initialized():
                rospy.signal_shutdown("the panel is no longer shown")

    def _join(self) -> None:
        """Become a node; rospy would wait for a master without a word."""
        while True:
            try:
                self._master.pid()
                break
            except GraphError as error:
                self._wire.send({"trouble": str(error)})
                time.sleep(LOOK)
        rospy.init_node(f"topic_panel_{os.getpid()}", disable_signals=True)
        prepare_node()
        self._ears = Ears(self._topic)

    def _obey(self, command: dict[str, Any]) -> None:
        do = command.pop("do")
        self._desk.problem = ""
        try:
            getattr(self, f"_do_{do}")(**command)
        except (CourseError, rospy.ROSException, ValueError) as error:
            self._desk.problem = str(error)

    def _do_type(self, name: str, text: str) -> None:
        self._kind = compile_message(name, text) if text else message_type(name)
        self._desk.kind = self._kind

    def _do_publish(self, **what: Any) -> None:  # noqa: ANN401 -- plain data
        self._desk.publish(**what)

    def _do_repeat(self, **what: Any) -> None:  # noqa: ANN401
        self._desk.repeat(**what)

    def _do_stop(self) -> None:
        self._desk.stop()

    def _do_withdraw(self) -> None:
        self._desk.withdraw()

    def _do_plot(self, path: str) -> None:
        if self._kind is not None:
            self._ears.plot(self._kind.md5, extractor(self._kind, path) if path else None)

    def _again(self, work: Any, pause: float) -> None:  # noqa: ANN401 -- a method
        while not rospy.is_shutdown():
            try:
                work()
            except EOFError:
                return  # the main thread sees it, too
            time.sleep(pause)

    def _look(self) -> None:
        """See who is on the topic, and be on the master's books again after it was restarted."""
        try:
            with self._registering:
                # A node that has signed off is unknown, too, and must not come back.
                if not rospy.is_shutdown() and not node_known(self._master):
                    register_all(self._master)
            self._around = look_around(self._master, self._topic).as_dict()
            self._trouble = ""
        except GraphError as error:
            self._trouble = str(error)

    def _tell(self) -> None:
        parts = {part: value for part, value in self._parts().items() if value != self._sent.get(part)}
        self._sent |= parts
        if echo := [self._echoed(sound) for sound in self._ears.news()]:
            parts["echo"] = echo
        if parts:
            self._wire.send(parts)

    def _parts(self) -> dict[str, Any]:
        sources = [vars(source) for source in self._ears.sources()]
        parts = {
            "trouble": self._trouble,
            "node": rospy.get_name(),
            "around": {**self._around, "sources": sources} if self._around else {},
            "spoken": self._desk.as_dict(),
            "count": self._ears.count,
        }
        self._told += 1
        return parts if self._told % SELDOM else parts | self._seldom_parts()

    def _seldom_parts(self) -> dict[str, Any]:
        ears, now = self._ears, time.monotonic()
        points = [[round(at - self._start, 3), value] for at, value in ears.curve.points(now)]
        curve = {"points": points, "count": ears.curve.count, "left_out": ears.curve.left_out}
        return {"pace": ears.pace.figures(now), "curve": curve}

    def _echoed(self, sound: Sound) -> dict[str, Any]:
        about = {name: getattr(sound, name) for name in ("number", "peer", "type", "md5", "size")}
        return about | {"ago": round(time.monotonic() - sound.at, 3), "texts": self._texts(sound)}

    def _texts(self, sound: Sound) -> Any:  # noqa: ANN401 -- a tree of texts, or None
        kind = self._kind or self._sender_kind(sound.type)
        if kind is None or sound.md5 != kind.md5 or len(sound.body) != sound.size:
            return None
        try:
            return kind.format(kind.to_values(kind.cls().deserialize(sound.body)))
        except (genpy.DeserializationError, FieldError):
            return None

    def _sender_kind(self, name: str) -> MessageType | None:
        """Return the type that a publisher names, as long as nobody has said which is the topic's."""
        try:
            return message_type(name)
        except CourseError:
            return None


def main(argv: list[str]) -> None:
    """Run a station until its wire ends, then sign off."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)  # whoever ends the owner ends the wire, and that is enough
    station = Station(Wire(socket.socket(fileno=int(argv[1]))), argv[2])
    station.run()
    station.leave()
    os._exit(0)  # rospy's threads need not be waited for


if __name__ == "__main__":
    main(sys.argv)
