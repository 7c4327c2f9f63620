"""02.3: a class that publishes each change of a value."""

import math
import statistics

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.peers.subscription import Subscription

SOON = 4.0  # SOON is the maximum time in s until a message arrives on a busy machine.
AT_ONCE = 0.3  # AT_ONCE is the maximum median duration of several calls in s.

WAITS = (
    "Do not wait in set(). With a latched publisher, each node that subscribes later receives the last "
    "message."
)
LATE = "a late subscriber receives only the last value"
KEEPER = """
notices = {}


def create(kind, topic):
    notices[topic] = kind(topic)


def set_value(topic, value):
    notices[topic].set(value)
"""
LATCHED = "Send the last value to every node that subscribes later."


@part(
    "02.3",
    points=2,
    goal="Publish a value when it changes. A node that subscribes later has to receive the last value.",
    needs=["Notice"],
    deadline=30.0,
    goals=[LATCHED, "Publish each new value once. Do not publish a value again if it has not changed."],
)
def a_notice(context: CheckContext) -> None:
    """Call set() without a subscriber and with a subscriber; another subscriber connects after the calls.

    On one topic, the first value is 0, which must also be published.
    """
    context.prepare(KEEPER)
    zero, topic, twin = (f"/{context.random.word()}" for _ in range(3))
    earlier, first = context.random.numbers(2, 1.0, 90.0)
    third = context.random.number(101.0, 9000.0)  # The unit of the charge may be different from percent.
    second = math.nextafter(first, 100.0)  # Even the smallest difference counts as a change of the value.
    for name in (zero, topic, twin):
        context.run("create", Its("Notice"), name, worded="Notice(topic)").returned()
    took = [_set(context, *each) for each in ((zero, 0.0), (topic, earlier), (topic, first), (twin, first))]
    context.require(
        "without a subscriber, set() returns immediately",
        holds=statistics.median(took) < AT_ONCE,
        expected=f"set() returns within {AT_ONCE} s",
        actual=f"set() returned after {statistics.median(took):.1f} s",
        hints=WAITS,
    )
    subscriber = _subscribed(context, topic)
    _receives(context, subscriber, [first], LATE)
    listener = _subscribed(context, zero)
    _receives(context, listener, [0.0], "the first value is published, even if it is 0")
    _receives(context, _subscribed(context, twin), [first], LATE)
    context.fulfilled(LATCHED)
    took = [_set(context, zero, 0.0)]
    _receives(context, listener, [0.0], "a value that stays the same is not published again")
    took.append(_set(context, topic, first))
    _receives(context, subscriber, [first], "a value that stays the same is not published again")
    if min(took) > AT_ONCE:
        context.fail(
            "set() returns immediately if the value stays the same",
            expected=f"set() returns within {AT_ONCE} s",
            actual=f"set() returned after {min(took):.1f} s",
            hint="The value was the same as in the previous call, but set() waited. Return without a pause.",
        )
    took = [_set(context, topic, second)]
    _receives(context, subscriber, [first, second], "a subscriber receives the next value once")
    took.append(_set(context, topic, third))
    # Wait until the third value arrives, because the next value could replace it in a short publisher queue.
    subscriber.wait(3, within=SOON)
    took.append(_set(context, topic, second))
    if statistics.median(took) > AT_ONCE:
        context.fail(
            "with a subscriber, set() returns immediately",
            expected=f"set() returns within {AT_ONCE} s",
            actual=f"set() returned after {statistics.median(took):.1f} s",
            hint=WAITS,
        )
    _receives(
        context,
        subscriber,
        [first, second, third, second],
        "an earlier value is published again if set() gets it again",
    )
    subscriber.leave()
    _receives(context, _subscribed(context, topic), [second], LATE)


def _set(context: CheckContext, topic: str, value: float) -> float:
    """Call set(value) of the student's object Notice(topic); return the duration of the call in s."""
    hints = [
        (
            matches("TimesUp"),
            "set() does not return. Publish the value only once, without a loop and without a pause.",
        )
    ]
    done = context.run("set_value", topic, value, worded="Notice(topic).set(value)", hints=hints)
    done.returned()
    return done.took


def _subscribed(context: CheckContext, topic: str) -> Subscription:
    """Subscribe to the topic `topic`; a latched publisher then sends its last message immediately."""
    subscription = context.subscribe(topic, "std_msgs/Float64")
    hint = "Create a rospy.Publisher for the given topic, and do not unregister this publisher."
    subscription.published(hints=[(matches("no publisher"), hint)])
    return subscription


def _receives(context: CheckContext, subscription: Subscription, values: list[float], assertion: str) -> None:
    """Assert that the values `values` arrive, and that no further message arrives in the next 0.3 s."""
    subscription.wait(len(values), within=SOON)
    subscription.during(0.3)
    received = [arrival.fields["data"] for arrival in subscription.arrivals]
    context.expect(
        assertion,
        expected=values,
        actual=received,
        near=1e-9,
        hints=[
            (
                lambda actual: not actual and values == [0.0],
                "The first value was 0, and it was not published. Before the first call, the stored "
                "value has to be None, not a number.",
            ),
            (
                [],
                "No value arrived. Create the publisher with `latch=True`, and store the last "
                "value in `self`, not in the class or in a global variable.",
            ),
            (
                lambda actual: len(actual) > len(values) + 2,
                "The same value is published again and again. Publish only in set(), and only "
                "if the value has changed.",
            ),
            (
                lambda actual: actual == values * 2,
                "The same value was published again. Publish a new value only if it differs "
                "from the last value.",
            ),
            (
                lambda actual: len(actual) > len(values) and set(actual) == set(values),
                "A value was published twice. Publish each new value only once.",
            ),
            (
                lambda actual: len(actual) > len(values),
                (
                    "A late subscriber received an older value. A late subscriber has to receive "
                    "only the last value."
                ),
            ),
            (
                lambda actual: len(actual) < len(values),
                "A changed value was not published. Publish each value that differs from the last value, "
                "even if the difference is very small.",
            ),
            (
                ANYTHING,
                (
                    "The published value is not the value that was set. Publish the argument of set() "
                    "without any change."
                ),
            ),
        ],
    )
