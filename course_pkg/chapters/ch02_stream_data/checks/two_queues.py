"""02.4: a node with two subscribers that have different queue sizes."""

import threading
import time
from collections.abc import Mapping
from itertools import pairwise

from course_pkg.chapters.ch02_stream_data.checks.subscribers import running_subscribers
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value
from course_pkg.waiting import at_this_load, wait_until

# A call of draw() takes `DRAWING` s, and a call of prepare() takes `PREPARING` s.
DRAWING, PREPARING = 0.25, 0.02
OLDEST = 0.5  # OLDEST is the maximum age in s of an angle when a drawing begins.
ANGLES, ORDERS = 60, 20
SOME = 8  # A short series contains this many angles before the last angle.


class Work:
    """A replacement for draw() or prepare() that only sleeps for `pause` s.

    The object records the beginning of each call, and the maximum number of simultaneous calls.
    """

    def __init__(self, pause: float) -> None:
        self.done: list[tuple[float, Value]] = []
        self.at_once = 0
        self.pause = pause
        self._busy = 0
        self._lock = threading.Lock()

    @remote
    def __call__(self, value: Value) -> None:
        """Record the call, and sleep for the duration `pause` (s)."""
        with self._lock:
            self._busy += 1
            self.at_once = max(self.at_once, self._busy)
            self.done.append((time.monotonic(), value))
        time.sleep(self.pause)
        with self._lock:
            self._busy -= 1


NEWEST, ALL_ORDERS = (
    "Draw only the newest angle.",
    "Prepare each order only once, and begin with the oldest order.",
)


@part(
    "02.4",
    points=3,
    goal="Draw only the newest angle of one topic, but prepare all orders of another topic.",
    needs=["start_robot"],
    deadline=30.0,
    goals={NEWEST: 2, ALL_ORDERS: 1},
)
def two_queues(context: CheckContext) -> None:
    """Publish angles faster than draw() can draw them, and many orders for prepare() within a short time."""
    topics = [f"/{context.random.word()}" for _ in range(2)]
    # The last angle and one of the orders are 0, which Python treats as false.
    negative, positive = ANGLES // 2, ANGLES - ANGLES // 2 - 1
    angles = [*context.random.numbers(negative, -900.0, -1.0), *context.random.numbers(positive, 1.0, 900.0)]
    angles = [*context.random.shuffled(angles), 0.0]
    numbers = context.random.integers(ORDERS - 2, 1000, 9999)
    numbers = context.random.shuffled([*numbers, numbers[0], 0])  # Two orders contain the same number.
    draw, prepare = Work(DRAWING), Work(PREPARING)
    context.place("checked_draw", draw)
    context.place("checked_prepare", prepare)
    arguments = (topics[0], Its("checked_draw"), topics[1], Its("checked_prepare"))
    worded = "start_robot(angles, draw, orders, prepare)"
    with running_subscribers(context, "start_robot", *arguments, worded=worded, topics=topics):
        values = [{"data": angle} for angle in angles]
        arm = context.publish(topics[0], "std_msgs/Float64", values, every=0.02, once=True)
        arm.listened(
            hints="Create a rospy.Subscriber of type Float64 for the topic whose name is in `angles`."
        )
        orders = [{"data": number} for number in numbers]
        customers = context.publish(topics[1], "std_msgs/UInt32", orders, every=0.001, once=True)
        customers.listened(
            hints="Create a rospy.Subscriber of type UInt32 for the topic whose name is in `orders`."
        )
        arm.finish(10.0)
        customers.finish(10.0)
        # Wait until draw() and prepare() have handled the last values.
        time.sleep(max(2 * DRAWING, ORDERS * PREPARING))
        drawn, prepared = [*draw.done], [value for _, value in prepare.done]
        draw.pause = 0.0
        last = context.random.number(1000.0, 2000.0)
        _publish_again(context, topics[0], [*context.random.numbers(SOME, 1.0, 900.0), last], draw)
    with context.goal(NEWEST):
        _drawn(context, draw.at_once, drawn, dict(zip(angles, arm.sent, strict=True)))
        context.expect(
            "the last angle is drawn",
            expected=last,
            actual=draw.done[-1][1],
            hints=(
                "In a second series of angles, draw() returned immediately, but the last angle was not "
                "drawn. Do not skip an angle because draw() was called a short time before."
            ),
        )
    with context.goal(ALL_ORDERS):
        _prepared(context, prepare.at_once, prepared, numbers)


def _publish_again(context: CheckContext, topic: str, angles: list[float], draw: Work) -> None:
    """Publish more angles, and wait until the last angle is drawn, at most 1 s."""
    values = [{"data": angle} for angle in angles]
    context.publish(topic, "std_msgs/Float64", values, every=0.02, once=True).finish(10.0)
    wait_until(lambda: [value for _, value in draw.done][-1:] == angles[-1:], at_this_load(1.0))


def _drawn(
    context: CheckContext, at_once: int, drawn: list[tuple[float, Value]], sent: Mapping[float, float]
) -> None:
    """Assert that each drawn angle was the newest published angle when the drawing began.

    `drawn` contains the time and the angle of each drawing. `sent` maps each published angle to its
    publishing time.
    """
    angles = [angle for _, angle in drawn]
    context.require(
        "draw() is called with angles from the topic",
        holds=bool(angles) and set(map(str, angles)) <= set(map(str, sent)),
        expected="numbers that were published",
        actual=angles[:3] or "no call",
        hints=[
            (matches("no call"), "draw() was not called. Call draw() in the callback for `angles`."),
            (
                matches("data"),
                "draw() got the whole message. Pass only the number, which is in the field `data`.",
            ),
            (
                ANYTHING,
                "draw() got an angle that was not published. Pass the field `data` of the message unchanged.",
            ),
        ],
    )
    context.require(
        "draw() is called again and again",
        holds=len(angles) > 2,
        expected="a call after each drawing",
        actual=f"{len(angles)} calls",
        hints=(
            "draw() got only one angle. Do not unregister the subscriber, because it has to "
            "receive more messages."
        ),
    )
    # A new angle arrives during each drawing, so the next drawing begins immediately.
    pause = min(later - earlier for (earlier, _), (later, _) in pairwise(drawn))
    context.require(
        "draw() is called again and again",
        holds=pause < 2.2 * DRAWING,
        expected=f"a call every {DRAWING} s, because one drawing takes this time",
        actual=f"at least {pause:.2f} s between two calls",
        hints=(
            "draw() was not called often enough, although new angles arrived. Call draw() again as "
            "soon as a drawing has ended."
        ),
    )
    overlap = any(later - earlier < 0.9 * DRAWING for (earlier, _), (later, _) in pairwise(drawn))
    _one_at_a_time(context, "draw", max(at_once, 1 + overlap))
    order = [list(sent).index(angle) for angle in angles]
    context.require(
        "each drawn angle is newer than the previous drawn angle",
        holds=order == sorted(set(order)),
        expected="a newer angle in each call",
        actual=angles,
        hints=(
            "An angle was drawn twice, or an old angle was drawn after a newer angle. Wait for a new "
            "angle before the next call of draw()."
        ),
    )
    oldest = max(at - sent[angle] for at, angle in drawn)
    context.require(
        f"no angle is older than {OLDEST} s when it is drawn",
        holds=oldest < OLDEST,
        expected=f"at most {OLDEST} s between the message and the call of draw()",
        actual=f"up to {oldest:.1f} s",
        hints=(
            "Too many angles wait in the queue. Limit the length of this queue, because only "
            "the newest angle is useful."
        ),
    )
    context.expect(
        "the last angle is drawn",
        expected=list(sent)[-1],
        actual=angles[-1],
        hints=(
            "The last angle was 0, and it was not drawn. Do not skip a fixed number of angles: always draw "
            "the newest angle, even if it is 0."
        ),
    )


def _prepared(context: CheckContext, at_once: int, prepared: list[Value], numbers: list[int]) -> None:
    context.expect(
        "each order is prepared once, and the oldest order is always first",
        expected=numbers,
        actual=prepared,
        hints=[
            ([], "prepare() was not called. Call prepare() in the callback for `orders`."),
            (
                matches("data"),
                "prepare() got the whole message. Pass only the number, which is in the field `data`.",
            ),
            (
                lambda actual: any(actual.count(number) > numbers.count(number) for number in numbers),
                "An order was prepared twice. Call prepare() once for each message.",
            ),
            (
                [number for number in numbers if number],
                "An order has the number 0, and it was not prepared. Call prepare() for each message, even "
                "if the number is 0.",
            ),
            (
                lambda actual: actual == list(dict.fromkeys(numbers)),
                "Two orders contained the same number, and only one of them was prepared. Call prepare() for "
                "each message.",
            ),
            (
                lambda actual: sorted(actual) == sorted(numbers),
                "The orders were prepared in the wrong sequence. Prepare one order after the "
                "other, in the sequence of arrival.",
            ),
            (
                lambda actual: set(actual) <= set(numbers),
                "Some orders were lost. Up to twenty orders can wait at the same time, so do not "
                "limit the queue for orders.",
            ),
            (
                ANYTHING,
                "prepare() got an order that was not published. Pass the field `data` of the "
                "message unchanged.",
            ),
        ],
    )
    _one_at_a_time(context, "prepare", max(at_once, 1))


def _one_at_a_time(context: CheckContext, function: str, at_once: int) -> None:
    """Assert that the calls did not overlap.

    `at_once` is the measured maximum number of simultaneous calls.
    """
    context.expect(
        f"only one call of {function}() runs at a time",
        expected=1,
        actual=at_once,
        hints=f"Two calls of {function}() ran at the same time. Do not start a thread for each message.",
    )
