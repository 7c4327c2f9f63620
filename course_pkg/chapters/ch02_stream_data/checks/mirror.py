"""02.2: a node that receives joint states, and publishes the mirror image of each joint state."""

import math
import statistics
from collections.abc import Callable, Sequence

from course_pkg.chapters.ch02_stream_data.checks.joint_states import JOINTS, joint_states
from course_pkg.chapters.ch02_stream_data.checks.subscribers import NO_SUBSCRIBER, running_subscribers
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import first_unlike
from course_pkg.checking.peers.subscription import Arrival, Subscription
from course_pkg.checking.plain_values import Fields
from course_pkg.ros.protocol.json_channel import Json

# The list `kept` belongs to the code in subscribers.py that starts and ends the student's subscribers.
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
HEADER = "the header and its time stamp stay the same"
NO_VELOCITIES = (
    "Your callback lost the positions of a message that has no velocities. Change the signs in each "
    "list separately."
)
ONCE = (
    "Some messages were published more than once. In the callback, publish one message for each "
    "received message."
)

MIRRORED = (
    "For each received message, publish one message with the same header. In this message, each "
    "number has the opposite sign."
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
    source, target, other_source, other_target = (f"/{context.random.word()}" for _ in range(4))
    subscription, other = (context.subscribe(topic, JOINTS) for topic in (target, other_target))
    with running_subscribers(
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
        begin = ("begin", Its("start_mirror"), other_source, other_target)
        context.run(*begin, worded="start_mirror(source, target)").returned()
        context.prepare(WITNESS)
        context.run("listen_too", source, worded="start_mirror(source, target)")
        messages = joint_states(context, 40)
        publisher = context.publish(source, JOINTS, messages, every=0.025, once=True)
        publisher.listened()
        publisher.finish(10.0)
        heard = subscription.wait(len(messages), within=1.5)
        _apart(context, other)
        _mirrors(context, messages, heard)
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


def _apart(context: CheckContext, other: Subscription) -> None:
    """Assert that the second mirror, whose source has no publisher, has published nothing.

    `other` is the check's subscription to the target of the second mirror.
    """
    if other.count:
        context.fail(
            "two mirrors are independent of each other",
            expected="messages only on the target of the first mirror",
            actual=f"{other.count} messages on the target of the second mirror",
            hint=(
                "The check started two mirrors, and the messages of the first mirror were published on the "
                "target of the second mirror. Do not store the publisher in a global variable."
            ),
        )


def _changed(messages: Sequence[Fields], witnessed: Sequence[Fields]) -> tuple[Json, Json]:
    """Return two versions of the first message that the student's code changed: before and after the change.

    If no message was changed, return ({}, {}).
    """
    given, seen = (
        [{field: each[field] for field in FIELDS} for each in all_] for all_ in (messages, witnessed)
    )
    return first_unlike(given, seen, near=1e-9)


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
            (
                lambda actual: not actual and not message["velocity"],
                "If the received message has no velocities, your callback publishes a message without names. "
                "Copy the names, and change the signs in each list separately.",
            ),
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
                (
                    _turned(values),
                    "Your callback changed a number to a number between -π and π. A mirrored number may be "
                    "outside of this range.",
                ),
                (ANYTHING, "Change only the sign of each number."),
            ],
        )


def _turned(values: Sequence[float]) -> Callable[[Sequence[float]], bool]:
    """Return a condition for mirrored numbers of which one differs by 2π from the right number."""
    return lambda actual: any(
        math.isclose(abs(one + value), 2 * math.pi, rel_tol=1e-6)
        for one, value in zip(actual, values, strict=True)
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
