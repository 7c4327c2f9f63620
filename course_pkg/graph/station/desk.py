"""What the station is told to do: publish once, in a burst, or at a rate, with which latch and queue."""

from __future__ import annotations

import threading
import time
from typing import Any

from course_pkg.errors import NotAdvertised
from course_pkg.graph.master import master_uri
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.spoken import Spoken
from course_pkg.graph.station.metronome import Metronome
from course_pkg.graph.station.pace import Pace
from course_pkg.interfaces import MessageType

BURST = 1000  # messages at most


class Desk:
    """The publishing half of a station: one publisher of `topic`, made by the first message.

    A message with another latch, queue size or type than the one before makes a new publisher.
    """

    def __init__(self, topic: str) -> None:
        self.kind: MessageType | None = None
        self.problem = ""
        self._topic = topic
        self._spoken: Spoken | None = None
        self._metronome: Metronome | None = None
        self._pace = Pace()
        self._turn = threading.Lock()
        self._reached: int | None = None

    def publish(self, texts: dict[str, Any], *, latch: bool, queue: int, count: int = 1) -> None:
        """Publish the message of these texts, `count` times without a pause.

        Raises FieldError, and GraphError where there is no master.
        """
        message = self._message(texts)
        self._advertise(latch, queue)
        for _ in range(min(count, BURST)):
            self._say(message)

    def repeat(self, texts: dict[str, Any], *, latch: bool, queue: int, rate: float) -> None:
        """Go on publishing, `rate` times a second, until told to stop or to repeat another message."""
        message = self._message(texts)
        self.stop()
        self._advertise(latch, queue)
        self._pace = Pace()
        self._metronome = Metronome(rate, lambda: self._say(message), self._failed)

    def stop(self) -> None:
        """Publish at no rate any more; the publisher stays."""
        metronome, self._metronome = self._metronome, None
        if metronome is not None:
            metronome.stop()

    def withdraw(self) -> None:
        """End the publisher; what it counted stays until there is another."""
        self.stop()
        if self._spoken is not None:
            self._spoken.stop()

    def as_dict(self) -> dict[str, Any]:
        """Return how it stands, as plain data."""
        metronome, spoken = self._metronome, self._spoken
        about: dict[str, Any] = {
            "problem": self.problem,
            "rate": metronome.rate if metronome else 0,
            "skipped": metronome.skipped if metronome else 0,
            "pace": self._pace.figures(time.monotonic()) if metronome else {},
        }
        if spoken is None:
            return about
        return about | {
            "advertised": spoken.advertised,
            "latch": spoken.latch,
            "queue": spoken.queue_size,
            "published": spoken.published,
            "unheard": spoken.unheard,
            "sent": spoken.sent,
            "dropped": spoken.dropped,
            "reached": self._reached,
            "deliveries": [vars(each) for each in spoken.deliveries] if spoken.advertised else [],
        }

    def _message(self, texts: dict[str, Any]) -> Any:  # noqa: ANN401 -- a generated class
        if self.kind is None:
            raise NotAdvertised(f"{self._topic}: the type of the topic is not known yet.")
        blank = self.kind.format(self.kind.default())
        return self.kind.to_message(self.kind.parse({**blank, **texts}))

    def _advertise(self, latch: bool, queue: int) -> None:
        assert self.kind is not None
        spoken = self._spoken
        wanted = (self.kind.name, latch, queue)
        if spoken and spoken.advertised and (spoken.type, spoken.latch, spoken.queue_size) == wanted:
            return
        MasterClient(master_uri()).pid()  # rospy.Publisher would wait for ever
        if spoken is not None:
            spoken.stop()
        self._spoken = Spoken(self._topic, self.kind.cls, latch=latch, queue_size=queue)

    def _say(self, message: Any) -> None:  # noqa: ANN401
        with self._turn:
            spoken = self._spoken
            assert spoken is not None
            before = spoken.unheard
            connected = len(spoken.deliveries)
            spoken.publish(message)
            self._pace.beat(time.monotonic())
            self._reached = 0 if spoken.unheard > before else max(1, connected)

    def _failed(self, error: Exception) -> None:
        self.problem = f"{type(error).__name__}: {error}"
