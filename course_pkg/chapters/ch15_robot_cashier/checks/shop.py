"""15.11: the shop in which the student's whole system runs; the check acts as the customers."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

from sensor_msgs.msg import Image

from course_pkg.chapters.ch15_robot_cashier.checks.peers.printer import Printer
from course_pkg.chapters.ch15_robot_cashier.checks.refusals import refused
from course_pkg.chapters.ch15_robot_cashier.checks.vision import Camera, image_of
from course_pkg.checking import ANYTHING, CheckContext
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.waiting import wait_until

POLL = 0.1  # POLL is the time in s between two tests of a condition.
REACTION = 5.0  # A greeting, a reset, or the detector's reaction to a change may take up to this time in s.
EVERY = 0.1  # EVERY is the time in s between two frames.
WAIT = 1.5  # The argument `wait` of the launch file has this value in s.
REASON = "out of paper"
# After the restart, the check lets up to this many customers come, until the cashier greets one of them.
VISITS = 2
MANY = 6  # MANY is the number of simultaneous calls of till/set.
NO_CUSTOMER = (
    "The frames show a customer, but detect_customer does not find a customer. Check exercises 15.1 and "
    "15.2 again."
)
NO_MESSAGE = (
    "The camera publishes frames, but no message arrives on customer_seen. Check exercise 15.1 again."
)
NOT_GREETED = "The detector finds the customer, but no greeting arrived. Check exercise 15.6 again."
GREETED_AGAIN = "The node greeted one customer more than once. Check exercise 15.6 again."
ADDING = (
    "After two calls of till/set at the same time, the total was not the sum of the printed lines. "
    "Check exercise 15.8 again."
)
REFUSED_ITEM = (
    "Two customers called till/set at the same time, and one call failed. Check exercise 15.8 again."
)
PRINTER = "The printer refused a line, but till/set did not refuse the item. Check exercise 15.8 again."
UNKNOWN = "The till accepted an item without a name. Check exercise 15.7 again."
COUNTED = "A refused item changed the total of the till. Check exercise 15.8 again."
NOT_RESET = "The customer has left, but the till still has items. Check exercises 15.6 and 15.9 again."
NO_MIRROR = (
    "Joint states arrived all the time, but the node published only a few mirror images. Check "
    "exercises 15.5 and 15.6 again."
)
SILENT = "No frame came for more than 1 s, but detect_customer accepted a call. Check exercise 15.3 again."
NOT_RECOVERED = (
    "New frames came after a pause, but detect_customer still refuses each call. Check exercise 15.3 again."
)
AFTERWARDS = (
    "After all nodes were killed and started again, the next customer was not greeted. Start the "
    "system, kill a node, and read the new output."
)


class Counter:
    """Replaces the camera above the counter.

    The object publishes a frame every 0.1 s; a frame shows one customer or no customer.
    """

    def __init__(self, context: CheckContext, topic: str) -> None:
        self._frames = {there: image_of(context, 40, 30, 500 * there) for there in (False, True)}
        self._camera = Camera(topic)
        self._shown: Image | None = self._frames[False]
        threading.Thread(target=self._publish, daemon=True).start()

    def show(self, customer: bool | None) -> None:
        """Publish frames with a customer (True), without a customer (False), or no frames (None)."""
        self._shown = None if customer is None else self._frames[customer]

    def _publish(self) -> None:
        while True:
            if self._shown is not None:
                self._camera.send(self._shown)
            time.sleep(EVERY)


@dataclass
class Shop:
    """Uses the whole system as a customer does, and examines the reactions of the system."""

    context: CheckContext
    space: str
    printer: Printer
    greetings: Subscription
    seen: Subscription
    counter: Counter

    def service(self, name: str, kind: str, hint: str, timeout: float = 5.0) -> Service:
        """Return a proxy for a service of the system; the report shows `hint` if a call fails."""
        return self.context.service(f"{self.space}/{name}", kind, timeout=timeout, hints=[(ANYTHING, hint)])

    def looks_at_frames(self) -> None:
        """Assert that the node vision publishes a message for the next frame."""
        before = self.seen.count
        self.context.require(
            "the node vision publishes a message for each frame",
            holds=self.seen.until(lambda arrivals: len(arrivals) > before, REACTION),
            expected="a message for each frame",
            actual="no message",
            hints=NO_MESSAGE,
        )

    def knows(self, customer: bool, hint: str) -> bool:
        """Return whether detect_customer returns the value `customer` within `REACTION` s."""
        detect = self.service("detect_customer", "course_pkg/AwaitCustomer", hint)

        def told() -> bool:
            return bool(detect(patience=WAIT).found) == customer

        return bool(wait_until(told, REACTION, POLL))

    def serves_two_customers(self, mirrored: Subscription, arm: Publisher) -> None:
        """Let a customer come and leave.

        Between these two events, make `MANY` calls of till/set at the same time, and let the printer fail.
        """
        context = self.context
        total = self.service("till/total", "course_pkg/TillTotal", COUNTED)
        put = self.service("till/set", "course_pkg/TillSet", REFUSED_ITEM)
        images, sent = mirrored.count, len(arm.sent)
        self.counter.show(True)
        context.require(
            "the system detects a customer", holds=self.knows(True, NO_CUSTOMER), expected="found=True",
            actual="found=False", hints=NO_CUSTOMER,
        )  # fmt: skip
        self.is_greeted(1, NOT_GREETED)
        self.greetings.during(1.0)
        context.require(
            "the system greets each customer once",
            holds=self.greetings.count == 1,
            expected="1 greeting",
            actual=f"{self.greetings.count} greetings",
            hints=GREETED_AGAIN,
        )
        bought = [(context.random.word(), cents) for cents in context.random.integers(MANY, 50, 900)]
        put.at_once([{"item": item, "cents": cents} for item, cents in bought])
        wanted = sum(int(line.rpartition(" ")[2]) for line in self.printer.lines)
        context.expect(
            "two customers at the same time: the till has the sum of the printed lines",
            expected=[wanted, MANY],
            actual=[(now := total()).cents, now.items],
            hints=ADDING,
        )
        self.printer.fault = REASON
        refused(
            context,
            put,
            "if the printer fails, the till refuses the item",
            REASON,
            item="milk",
            cents=1,
            hints=PRINTER,
        )
        self.printer.fault = ""
        refused(context, put, "the till refuses an item without a name", "", item="", cents=1, hints=UNKNOWN)
        context.expect(
            "a refused item does not change the sum", expected=wanted, actual=total().cents, hints=COUNTED
        )
        self.counter.show(False)
        context.require(
            "after the visit, the till is empty",
            holds=bool(wait_until(lambda: total().items == 0, REACTION, POLL)),
            expected="0 items",
            actual=f"{MANY} items",
            hints=NOT_RESET,
        )
        images, sent = mirrored.count - images, len(arm.sent) - sent
        context.require(
            "the system mirrors the arm all the time",
            holds=images > sent / 4,
            expected=f"{sent} images",
            actual=f"{images} images",
            hints=NO_MIRROR,
        )

    def is_greeted(self, count: int, hint: str) -> None:
        """Assert that `count` greetings were published."""
        self.context.require(
            "the system greets a customer",
            holds=len(self.greetings.wait(count, REACTION)) == count,
            expected="a greeting",
            actual="none",
            hints=hint,
        )

    def notices_a_silent_camera(self) -> None:
        """Stop the frames, and assert that detect_customer refuses a call; later, publish frames again."""
        self.counter.show(None)
        time.sleep(1.4)
        detect = self.service("detect_customer", "course_pkg/AwaitCustomer", NOT_RECOVERED)
        refused(
            self.context,
            detect,
            "if the camera is silent, detect_customer refuses each call",
            "camera",
            patience=0.0,
            hints=SILENT,
        )
        self.counter.show(False)
        self.looks_at_frames()
        time.sleep(0.3)
        self.context.require(
            "when frames come again, detect_customer responds", holds=self.knows(False, NOT_RECOVERED),
            expected="found=False", actual="found=True", hints=NOT_RECOVERED,
        )  # fmt: skip

    def greets_after_the_restart(self) -> None:
        """Let customers come; the first greeting may be lost while the node and the check connect."""
        for _ in range(VISITS):
            self.counter.show(True)
            if len(self.greetings.wait(2, REACTION)) == 2:
                break
            self.counter.show(False)
            time.sleep(2 * WAIT)
        self.is_greeted(2, AFTERWARDS)
