"""The publisher of a topic process. It publishes once, several times without a pause, or at a rate."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

import genpy

from course_pkg.errors import PublisherStopped
from course_pkg.ros.node.publisher import Publisher
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.topic.reports import DeliveryReport, PublisherReport
from course_pkg.ros.topic.statistics import RateStatistics
from course_pkg.types import MessageType, StringTree

BURST = 1000  # One command publishes at most this number of messages without a pause.
# This is the maximum delay of a tick in s. A tick with a longer delay is skipped. A tick with a shorter delay
# is executed at once.
CATCH_UP = 0.25


class Timer:
    """Calls the function `tick` on a separate thread, until stop(); `rate` is in calls per second.

    A delayed tick does not delay the next ticks. A tick with a delay of more than `CATCH_UP` s is skipped;
    `skipped` is the number of skipped ticks. If `tick` raises an exception, the timer calls the function
    `failed` with the exception and ends.
    """

    def __init__(self, rate: float, tick: Callable[[], None], failed: Callable[[Exception], None]) -> None:
        self.rate = rate
        self.skipped = 0
        self._tick = tick
        self._failed = failed
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True, name="publish-timer")
        self._thread.start()

    def stop(self) -> None:
        """Stop the timer; after this method has returned, there are no more ticks."""
        self._stop.set()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def _run(self) -> None:
        start, number = time.monotonic(), 0
        try:
            while not self._stop.wait(max(0.0, start + number / self.rate - time.monotonic())):
                self._tick()
                missed = max(0, int((time.monotonic() - start - CATCH_UP) * self.rate) - number)
                self.skipped += missed
                number += missed + 1
        except Exception as error:  # noqa: BLE001 -- the thread has to report every error
            self._failed(error)


class Commands:
    """Publishes on the topic `topic` when a command arrives.

    The first message creates the publisher. A message with a different latch, queue size or type creates a
    new publisher.
    """

    def __init__(self, topic: str) -> None:
        self.kind: MessageType | None = None
        self.problem = ""
        self._topic = topic
        self._publisher: Publisher | None = None
        self._timer: Timer | None = None
        self._rate = RateStatistics()
        self._lock = threading.Lock()
        self._reached: int | None = None

    def publish(self, texts: dict[str, StringTree], *, latch: bool, queue: int, count: int = 1) -> None:
        """Publish a message `count` times without a pause; `texts` contains the values of its fields.

        publish() and repeat() raise PublisherStopped if the type is not known yet, FieldError if a value is
        wrong, and GraphError without a master.
        """
        message = self._message(texts)
        self._advertise(latch, queue)
        for _ in range(min(count, BURST)):
            self._publish(message)

    def repeat(self, texts: dict[str, StringTree], *, latch: bool, queue: int, rate: float) -> None:
        """Publish the message repeatedly, until another command arrives; `rate` is in messages per second."""
        message = self._message(texts)
        self.stop()
        self._advertise(latch, queue)
        self._rate = RateStatistics()
        self._timer = Timer(rate, lambda: self._publish(message), self._failed)

    def stop(self) -> None:
        """Stop repeating; do not unregister the publisher."""
        timer, self._timer = self._timer, None
        if timer is not None:
            timer.stop()

    def withdraw(self) -> None:
        """Stop the publisher; its counts are available until a new publisher exists."""
        self.stop()
        if self._publisher is not None:
            self._publisher.stop()

    def state(self) -> PublisherReport:
        """Return the state and the counts of the publisher and of the timer."""
        timer, publisher = self._timer, self._publisher
        state: PublisherReport = {
            "problem": self.problem,
            "rate": timer.rate if timer else 0,
            "skipped": timer.skipped if timer else 0,
            "statistics": self._rate.figures(time.monotonic()) if timer else {},
        }
        if publisher is not None:
            state |= {
                "advertised": publisher.advertised,
                "latch": publisher.latch,
                "queue": publisher.queue_size,
                "published": publisher.published,
                "unheard": publisher.unheard,
                "sent": publisher.sent,
                "dropped": publisher.dropped,
                "reached": self._reached,
                "deliveries": [
                    DeliveryReport(peer=each.peer, sent=each.sent, waiting=each.waiting, dropped=each.dropped)
                    for each in (publisher.deliveries if publisher.advertised else ())
                ],
            }
        return state

    def _message(self, texts: dict[str, StringTree]) -> genpy.Message:
        if self.kind is None:
            raise PublisherStopped(f"{self._topic}: the topic has no type yet. Choose a type first.")
        blank = self.kind.format(self.kind.default())
        assert isinstance(blank, dict)
        return self.kind.to_message(self.kind.parse({**blank, **texts}))

    def _advertise(self, latch: bool, queue: int) -> None:
        assert self.kind is not None
        publisher = self._publisher
        wanted = (True, self.kind.name, latch, queue)
        has = publisher and (publisher.advertised, publisher.type, publisher.latch, publisher.queue_size)
        if has == wanted:
            return
        MasterClient(master_uri()).pid()  # Without a master, rospy.Publisher would wait for ever.
        if publisher is not None:
            publisher.stop()
        self._publisher = Publisher(self._topic, self.kind.cls, latch=latch, queue_size=queue)

    def _publish(self, message: genpy.Message) -> None:
        with self._lock:
            publisher = self._publisher
            assert publisher is not None
            before = publisher.unheard
            connected = len(publisher.deliveries)
            publisher.publish(message)
            self._rate.beat(time.monotonic())
            self._reached = 0 if publisher.unheard > before else max(1, connected)

    def _failed(self, error: Exception) -> None:
        self.problem = f"{type(error).__name__}: {error}"
