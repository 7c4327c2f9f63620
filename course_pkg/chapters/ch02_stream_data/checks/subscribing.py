"""Checks of subscribers: a node that mirrors joint states, and a node with two different queue sizes."""

import statistics
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import pairwise

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import first_unlike
from course_pkg.checking.peers.subscription import Arrival
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Fields, Value
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import at_this_load

JOINTS = "sensor_msgs/JointState"
KEEPER = """
import rospy

kept = []


def begin(start, *args):
    started = start(*args)
    kept.extend(started if isinstance(started, (list, tuple)) else [started])
    subscribers = [each for each in kept if isinstance(each, rospy.Subscriber)]
    return [each.resolved_name for each in subscribers]


def end():
    while kept:
        subscriber = kept.pop()
        if hasattr(subscriber, "unregister"):
            subscriber.unregister()
"""
WITNESS = """
import rospy
from sensor_msgs.msg import JointState

witnessed = []


def listen_too(topic):
    kept.append(rospy.Subscriber(topic, JointState, witness))


def witness(message):
    witnessed.append(message)
"""
FIELDS = ("name", "position", "velocity")
# A call of draw() takes DRAWING s, and a call of prepare() takes PREPARING s.
DRAWING, PREPARING = 0.25, 0.02
# The student's function must return within this time in s; on an idle machine, it takes a few ms.
RETURNS = 1.5
OLDEST = 0.5  # OLDEST is the maximum age in s of an angle when a drawing begins.
ANGLES, ORDERS = 60, 20
HEADER = "the header and its time stamp stay the same"
NO_SUBSCRIBER = "Return the rospy.Subscriber object. The check uses this object to unregister the subscriber."
OTHER_ORDER = (
    "The two subscribers are in the wrong order. Return the subscriber of the topic `angles` first, "
    "and then the subscriber of the topic `orders`."
)
NO_VELOCITIES = (
    "Your callback lost the positions of a message that has no velocities. Change the signs in each "
    "list separately."
)
NO_TWO = (
    "Return a list of two rospy.Subscriber objects. The check uses these objects to unregister the "
    "subscribers."
)
ONCE = (
    "Some messages were published more than once. In the callback, publish one message for each "
    "received message."
)
NEVER_RETURNS = (
    "The function does not return. Return after you create the subscriber: rospy calls the "
    "callback in another thread."
)


class Work:
    """A replacement for draw() or prepare() that only sleeps; `pause` is the duration in s.

    The object records the beginning of each call, and the maximum number of simultaneous calls.
    """

    def __init__(self, pause: float) -> None:
        self.done: list[tuple[float, Value]] = []
        self.at_once = 0
        self._pause = pause
        self._busy = 0
        self._lock = threading.Lock()

    @remote
    def __call__(self, value: Value) -> None:
        """Record the call, and sleep for the duration `pause` (s)."""
        with self._lock:
            self._busy += 1
            self.at_once = max(self.at_once, self._busy)
            self.done.append((time.monotonic(), value))
        time.sleep(self._pause)
        with self._lock:
            self._busy -= 1


MIRRORED = (
    "For each received message, publish one message with the same header. In this message, each "
    "number has the opposite sign."
)
NEWEST, ALL_ORDERS = (
    "Draw only the newest angle.",
    "Prepare each order only once, and begin with the oldest order.",
)


@part(
    "02.2",
    points=2,
    goal=(
        "Receive every message of one topic. Change the sign of each number, and immediately publish "
        "the result on another topic."
    ),
    needs=["start_mirror"],
    deadline=30.0,
    goals={MIRRORED: 3, "Publish the new message immediately, and do not change the received message.": 1},
)
def a_mirror(context: CheckContext) -> None:
    """Publish random joint states, and compare each joint state with its mirrored message."""
    source, target = (f"/{context.random.word()}" for _ in range(2))
    subscription = context.subscribe(target, JOINTS)
    with _begun(
        context, "start_mirror", source, target, worded="start_mirror(source, target)", topics=[source]
    ):
        subscription.published(
            hints=[
                (
                    matches("no publisher"),
                    "The topic `target` has no publisher when start_mirror() returns. Create "
                    "the publisher in start_mirror(), not in the callback.",
                )
            ]
        )
        context.prepare(WITNESS)
        context.run("listen_too", source, worded="start_mirror(source, target)")
        messages = _stances(context, 40)
        publisher = context.publish(source, JOINTS, messages, every=0.025, once=True)
        publisher.listened()
        publisher.finish(10.0)
        _mirrors(context, messages, subscription.wait(len(messages), within=1.5))
        subscription.during(0.3)
        context.expect(
            "the mirror publishes one message for each received message",
            expected=len(messages),
            actual=subscription.count,
            hints=ONCE,
        )
        context.fulfilled(MIRRORED)
        _promptly(context, publisher.sent, subscription.arrivals)
        expected, seen = _changed(messages, context.read("witnessed", list))
        context.expect(
            "the callback does not change the received message",
            expected=expected,
            actual=seen,
            near=1e-9,
            hints=(
                "Your callback changed the received message, and other callbacks of this "
                "program get the changed message. Create a new JointState message."
            ),
        )
    before = subscription.count
    context.publish(source, JOINTS, messages, every=0.02)
    subscription.during(0.4)
    if subscription.count > before:
        context.fail(
            "the subscriber is returned",
            expected="no mirrored message after the check has called unregister() of the subscriber",
            actual=f"{subscription.count - before} messages",
            hint=NO_SUBSCRIBER,
        )


def _changed(messages: Sequence[Fields], witnessed: Sequence[Fields]) -> tuple[Json, Json]:
    """Return the first message that the student's code changed, as it was before and after the change.

    If no message was changed, return ({}, {}).
    """
    given, seen = (
        [{field: each[field] for field in FIELDS} for each in all_] for all_ in (messages, witnessed)
    )
    return first_unlike(given, seen, near=1e-9)


def _stances(context: CheckContext, count: int) -> list[Fields]:
    """Return a list of `count` joint states.

    The joint states in the second half have fewer joints. If the student's node stores values of earlier
    joint states, its messages are then wrong. One joint state has no velocities.
    """
    names = [context.random.word() for _ in range(4)]
    counts = [4 if number < count / 2 else 3 for number in range(count)]
    states: list[Fields] = [
        {
            "header": {
                "stamp": {"secs": 1000 + number, "nsecs": context.random.integer(1, 999_999_999)},
                "frame_id": context.random.word(),
            },
            "name": names[:joints],
            "position": _of_both_signs(context, joints),
            "velocity": _of_both_signs(context, joints),
        }
        for number, joints in enumerate(counts)
    ]
    states[context.random.integer(2, count // 2)]["velocity"] = []
    return states


def _of_both_signs(context: CheckContext, count: int) -> list[float]:
    """Return `count` random numbers: two are positive, and the others are negative.

    The numbers have both signs, so that each wrong sign in a mirror image is visible.
    """
    return context.random.shuffled(
        [*context.random.numbers(2, 0.1, 3.0), *context.random.numbers(count - 2, -3.0, -0.1)]
    )


@contextmanager
def _begun(
    context: CheckContext, start: str, *args: object, worded: str, topics: Sequence[str]
) -> Iterator[None]:
    """Call the student's function, which returns its subscribers; unregister them after the `with` block."""
    context.prepare(KEEPER)
    try:
        started = context.run(
            "begin",
            Its(start),
            *args,
            within=at_this_load(RETURNS),
            worded=worded,
            hints=[(matches("TimesUp"), NEVER_RETURNS)],
        )
        names = started.returned()
        swapped = len(topics) > 1 and names == list(reversed(topics))
        context.require(
            "the subscriber is returned" if len(topics) == 1 else "two subscribers are returned",
            holds=isinstance(names, list) and len(names) == len(topics) and not swapped,
            expected=f"subscribers: {len(topics)}, in the order that the exercise describes",
            actual=names,
            hints=OTHER_ORDER if swapped else NO_SUBSCRIBER if len(topics) == 1 else NO_TWO,
        )
        yield
    finally:
        context.run("end", worded=worded)


def _mirrors(context: CheckContext, messages: Sequence[Fields], heard: Sequence[Arrival]) -> None:
    """Compare each mirrored message with the original message that has the same time stamp."""
    stamps = [message["header"]["stamp"] for message in messages]
    seen = [arrival.fields["header"]["stamp"] for arrival in heard]
    context.require(
        HEADER,
        holds=bool(heard) and seen[0] in stamps,
        expected="the time stamp of a published message",
        actual=seen[:3] if heard else "nothing arrived",
        hints=[
            (
                matches("nothing arrived"),
                "Your callback published no message. Look below the cell for an error message of "
                "the callback.",
            ),
            (
                matches("'secs': 0, 'nsecs': 0"),
                (
                    "The time stamp is 0, because your callback created a new header. Copy the "
                    "header of the received message."
                ),
            ),
            (
                ANYTHING,
                "The time stamp differs from the time stamp of the received message. Copy the "
                "whole header without any change.",
            ),
        ],
    )
    for arrival in heard:
        message = messages[stamps.index(arrival.fields["header"]["stamp"])]
        context.expect(
            HEADER,
            expected=message["header"]["frame_id"],
            actual=arrival.fields["header"]["frame_id"],
            hints="The `frame_id` in the header is wrong. Copy the whole header of the received message.",
        )
        _is_image(context, message, arrival.fields)
    context.expect(
        "every message is mirrored, and the order of the messages stays the same",
        expected=[stamp["secs"] for stamp in stamps],
        actual=[stamp["secs"] for stamp in seen],
        hints=[
            (
                lambda actual: len(actual) == 1,
                "Your callback published only one message. Do not unregister the subscriber: rospy "
                "calls the callback for each message.",
            ),
            (
                lambda actual: len(set(actual)) < len(actual),
                ONCE,
            ),
            (
                [message["header"]["stamp"]["secs"] for message in messages if message["velocity"]],
                NO_VELOCITIES,
            ),
            (
                lambda actual: len(actual) < len(stamps),
                "Some messages are missing. Do not pause in the callback, and do not limit the "
                "queue to a few messages.",
            ),
        ],
    )


def _is_image(context: CheckContext, message: Fields, image: Fields) -> None:
    context.expect(
        "the names of the joints stay the same",
        expected=message["name"],
        actual=image["name"],
        hints=[
            ((), "The names of the joints are missing. Copy the names from the received message."),
            (
                tuple(reversed(message["name"])),
                (
                    "Your callback reversed the order of the list. Keep the order, and change the "
                    "sign of each number."
                ),
            ),
            (
                ANYTHING,
                (
                    "The names are wrong, or their order is wrong. Copy the list of names from the "
                    "received message without any change."
                ),
            ),
        ],
    )
    for field, other in (("position", "velocity"), ("velocity", "position")):
        values = message[field]
        context.expect(
            f"every {field} has the opposite sign",
            expected=[-value for value in values],
            actual=image[field],
            near=1e-9,
            hints=[
                (values, f"The field `{field}` was not changed. Change the sign of each number."),
                (
                    [],
                    f"The list in the field `{field}` is empty. Fill this list, too."
                    if message["velocity"]
                    else NO_VELOCITIES,
                ),
                (
                    values[::-1],
                    (
                        "Your callback reversed the order of the list. Keep the order, and change the "
                        "sign of each number."
                    ),
                ),
                (
                    [abs(value) for value in values],
                    (
                        "A negative number has to become positive, too. Change the sign of each "
                        "number with -value."
                    ),
                ),
                (
                    [-value for value in message[other]],
                    (
                        f"In your message, the field `{field}` contains the numbers of the field "
                        f"`{other}`. Compare the names of the fields."
                    ),
                ),
                (
                    _of_another_length(values),
                    (
                        "The length of your list differs from the length of the list in the received "
                        "message. For each message, create a new list with a loop over all numbers."
                    ),
                ),
                (ANYTHING, "Change only the sign of each number."),
            ],
        )


def _of_another_length(values: Sequence[float]) -> Callable[[Sequence[float]], bool]:
    return lambda actual: len(actual) != len(values)


def _promptly(context: CheckContext, sent: Sequence[float], arrivals: Sequence[Arrival]) -> None:
    delays = [arrival.at - at for at, arrival in zip(sent, arrivals, strict=False)]
    # On a busy machine, many messages are late, but at least one message arrives in time.
    median, fast = statistics.median(delays), min(delays)
    context.require(
        "each message is mirrored without delay",
        holds=median < 0.15 and fast < 0.08,
        expected="a mirrored message a few milliseconds after the original",
        actual=(
            f"a delay of at least {fast:.2f} s for each message, and of at least {median:.2f} s for "
            "half of the messages"
        ),
        hints="Your messages are late. Publish in the callback, and do not wait in the callback.",
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
    angles = context.random.numbers(ANGLES, -900.0, 900.0)
    numbers = context.random.integers(ORDERS, 1000, 9999)
    draw, prepare = Work(DRAWING), Work(PREPARING)
    context.place("checked_draw", draw)
    context.place("checked_prepare", prepare)
    arguments = (topics[0], Its("checked_draw"), topics[1], Its("checked_prepare"))
    worded = "start_robot(angles, draw, orders, prepare)"
    with _begun(context, "start_robot", *arguments, worded=worded, topics=topics):
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
    with context.goal(NEWEST):
        _drawn(context, draw.at_once, drawn, dict(zip(angles, arm.sent, strict=True)))
    with context.goal(ALL_ORDERS):
        _prepared(context, prepare.at_once, prepared, numbers)


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
            "The last angle was not drawn. Do not skip a fixed number of angles: always draw the "
            "newest angle."
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
                lambda actual: len(set(actual)) < len(actual),
                "An order was prepared twice. Call prepare() once for each message.",
            ),
            (
                lambda actual: set(actual) == set(numbers),
                "The orders were prepared in the wrong sequence. Prepare one order after the "
                "other, in the sequence of arrival.",
            ),
            (
                lambda actual: set(actual) < set(numbers),
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
