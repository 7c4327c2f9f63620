"""What a node says on a topic, counted, so that a cell can see what became of its messages."""

from __future__ import annotations

import threading
import time
from types import TracebackType
from typing import Any

import rospy

from course_pkg.errors import NobodyListens, NotAdvertised
from course_pkg.graph.deliveries import Deliveries, Delivery
from course_pkg.graph.master import master_uri
from course_pkg.graph.rpc import MasterClient


class Spoken:
    """A publisher; `published` counts its messages, `unheard` those for which nobody was connected.

    With `latch` the last message is kept for whoever connects later; `queue_size` messages wait for each
    subscriber; 0 sets no limit.
    """

    def __init__(self, topic: str, cls: Any, *, queue_size: int = 10, latch: bool = False) -> None:  # noqa: ANN401
        self.name = str(rospy.resolve_name(topic))
        self.type = str(cls._type)
        self.queue_size = queue_size
        self.latch = latch
        self.published = 0
        self.unheard = 0
        self._cls = cls
        self._turn = threading.Lock()
        self._publisher: rospy.Publisher | None = None
        self._deliveries: list[Deliveries] = []
        self._advertise()

    def publish(self, *args: Any, **fields: Any) -> None:  # noqa: ANN401
        """Publish a message: whole, by position, or by field. Raises NotAdvertised after stop()."""
        with self._turn:
            if self._publisher is None:
                raise NotAdvertised(f"{self.name}: this publisher was stopped. Advertise the topic again.")
            self._deliveries[-1].watch()
            alone = not self._publisher.get_num_connections()
            self._publisher.publish(*args, **fields)
            self.published += 1
            self.unheard += alone

    @property
    def advertised(self) -> bool:
        """Whether it can publish."""
        return self._publisher is not None

    @property
    def deliveries(self) -> tuple[Delivery, ...]:
        """What was sent to each subscriber that is connected, what waits, and what was dropped."""
        return self._deliveries[-1].of_now()

    @property
    def sent(self) -> int:
        """How many messages were sent, counted once for each subscriber."""
        return sum(each.sent for each in self._deliveries)

    @property
    def dropped(self) -> int:
        """How many messages were dropped from full queues, counted once for each subscriber."""
        return sum(each.dropped for each in self._deliveries)

    def wait(self, count: int = 1, timeout: float = 5.0) -> None:
        """Return as soon as `count` subscribers are connected.

        Raises NobodyListens when there are fewer after `timeout` s.
        """
        deadline = time.monotonic() + timeout
        while len(self.deliveries) < count:
            if time.monotonic() > deadline:
                raise NobodyListens(
                    f"{self.name}: {len(self.deliveries)} of {count} subscribers connected within "
                    f"{timeout:g} s. Does somebody subscribe to it, and to {self.type}? See "
                    f"`rostopic info {self.name}`."
                )
            time.sleep(0.005)

    def stop(self, *, withdraw: bool = True) -> None:
        """Publish no more, and take the topic off the graph; what was counted stays.

        A second stop changes nothing. Raises MasterUnreachable or MasterSilent where rospy would wait for
        ever, and publishes nothing more.
        """
        with self._turn:
            publisher, self._publisher = self._publisher, None
        if publisher is not None and withdraw:
            MasterClient(master_uri()).pid()
            publisher.unregister()

    def renew(self) -> None:
        """Advertise again in a rospy that has begun anew, if nobody has stopped it."""
        if self._publisher is not None:
            self._advertise()

    def __enter__(self) -> Spoken:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<{self.name} of type {self.type}, {'published' if self._publisher else 'stopped'}>"

    def _advertise(self) -> None:
        self._publisher = rospy.Publisher(self.name, self._cls, queue_size=self.queue_size, latch=self.latch)
        self._deliveries.append(Deliveries(self._publisher))
