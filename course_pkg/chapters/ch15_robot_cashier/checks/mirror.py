"""15.5: a node that publishes the mirror image of each valid joint state, and ignores invalid states."""

from __future__ import annotations

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.peers.joint_states import (
    EFFORT,
    EMPTY,
    FEW_EFFORTS,
    FIRST,
    JOINTS,
    LARGE,
    JointState,
    joint_states,
    many_joint_states,
)
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import Interface, student_node
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Arrival, Subscription

NAME = "robot_cashier"
ARM, MIRRORED = "joint_states", "mirrored_joints"
DETECT, RESET = "detect_customer", "till/reset"
INTERFACE = Interface(publishes=[MIRRORED], subscribes=[ARM])
PROMPT = 0.5  # PROMPT is the maximum time in s between a joint state and its mirror image on a busy machine.
EVERY = 0.05  # EVERY is the time in s between two joint states.
RAPID = 0.005  # At the end, the check publishes many joint states; the time between two of them is RAPID s.
LAST = 10.0  # On a busy machine, the last of these mirror images may need this additional time in s.
NOT_HEARD = (
    "The node does not subscribe to joint_states with the right type. Pass sensor_msgs/JointState to "
    "rospy.Subscriber."
)
NONE_CAME = "No mirror image arrived. In the callback, publish the mirror image of each valid joint state."
OTHER_TIME = (
    "The time stamp of a mirror image is different from the time stamp of the joint state. Copy "
    "the header of the joint state."
)
LATE = "The mirror images arrive late. Publish each mirror image in the callback, without a wait or a pause."
STOPPED = (
    "The node published some mirror images, and then published no more. In the callback, publish the mirror "
    "image of each valid joint state, for any number of messages."
)
ZEROS = (
    "The node published zeros for an invalid joint state, so the arm would move to these positions. "
    "Publish nothing in this case."
)


@part(
    "15.5",
    points=2,
    goal="Write robot_cashier.py: publish the mirror image of each valid joint state.",
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME),
)
def the_mirror(context: CheckContext) -> None:
    """Publish valid and invalid joint states, and compare them with the mirror images."""
    with student_node(context, NAME, INTERFACE, calls=[DETECT, RESET]) as space:
        subscription = context.subscribe(f"{space}/{MIRRORED}", JOINTS)
        subscription.published()
        states = joint_states(context)
        messages = [state.fields() for state in states]
        publisher = context.publish(f"{space}/{ARM}", JOINTS, messages, every=EVERY, once=True)
        publisher.listened(hints=NOT_HEARD)
        publisher.finish(10.0)
        _mirrors(context, subscription, states)
        _is_prompt(context, subscription, publisher.sent)
        _mirrors_the_last(context, subscription, f"{space}/{ARM}")


def _secs(arrival: Arrival) -> int:
    return int(arrival.fields["header"]["stamp"]["secs"])


def _mirrors(context: CheckContext, subscription: Subscription, states: list[JointState]) -> None:
    valid = {state.secs: state for state in states if state.is_valid}
    last = max(valid)
    subscription.until(lambda arrivals: any(_secs(arrival) == last for arrival in arrivals), 3.0)
    images = [JointState.of(arrival.fields) for arrival in subscription.arrivals]
    published = {state.secs for state in states}
    strange = [image.secs for image in images if image.secs not in published]
    context.require(
        "each mirror image has the time stamp of its joint state",
        holds=bool(images) and not strange,
        expected="images with the stamps of the published joint states",
        actual=f"the stamp {strange[0]} s" if strange else "no image",
        hints=[(matches("no image"), NONE_CAME), (ANYTHING, OTHER_TIME)],
    )
    _leaves_out(context, images, {state.secs: state for state in states if not state.is_valid})
    for image in images:
        _is_image(context, valid[image.secs], image)
    stamps = list(valid)
    context.expect(
        "the node mirrors every valid joint state once, in the right order",
        expected=stamps,
        actual=[image.secs for image in images],
        hints=_wrong_selection(stamps),
    )


def _is_prompt(context: CheckContext, subscription: Subscription, sent: list[float]) -> None:
    delays = sorted(arrival.at - sent[_secs(arrival) - FIRST] for arrival in subscription.arrivals)
    median = delays[len(delays) // 2]
    context.require(
        "the node publishes each mirror image immediately",
        holds=median < PROMPT,
        expected="an image a few milliseconds after its joint state",
        actual=f"half of the images with a delay of more than {median:.1f} s",
        hints=LATE,
    )


def _mirrors_the_last(context: CheckContext, subscription: Subscription, topic: str) -> None:
    """Publish a random number of valid joint states at a high rate; the node must mirror the last one.

    A node may miss some of these joint states, because its queues can be short.
    """
    states = many_joint_states(context, context.random.integer(150, 250))
    messages = [state.fields() for state in states]
    context.publish(topic, JOINTS, messages, every=RAPID, once=True).finish(LAST)
    context.require(
        "the node mirrors every valid joint state once, in the right order",
        holds=subscription.until(lambda arrivals: _secs(arrivals[-1]) == states[-1].secs, LAST),
        expected=f"an image of the last of {len(states)} joint states",
        actual="no image of the last joint state",
        hints=STOPPED,
    )


def _leaves_out(context: CheckContext, images: list[JointState], invalid: dict[int, JointState]) -> None:
    for image in images:
        if image.secs in invalid:
            actual, hint = _why_invalid(invalid[image.secs])
            if image.position and not any(image.position):
                hint = ZEROS
            context.fail(
                "the node ignores an invalid joint state",
                expected="no image of this joint state",
                actual=actual,
                hint=hint,
            )
    context.require("the node ignores an invalid joint state", holds=True)


def _why_invalid(state: JointState) -> tuple[str, str]:
    """Return two texts: why the joint state `state` is invalid, and the hint for its mirror image."""
    if state.misses_positions:
        return (
            f"a mirror image with {len(state.position)} positions for {len(state.name)} joints",
            (
                "The number of names is different from the number of positions. Compare the "
                "lengths of these two lists, and ignore the message if the lengths are different."
            ),
        )
    if state.misses_velocities:
        return (
            f"a mirror image with {len(state.velocity)} velocities for {len(state.name)} joints",
            (
                "The number of velocities has to be 0 or equal to the number of names. Ignore a "
                "message with a different number of velocities."
            ),
        )
    return (
        "a mirror image with a number that is not finite",
        ("A position or velocity was nan or inf, which is not valid. Check each number with math.isfinite."),
    )


def _is_image(context: CheckContext, state: JointState, image: JointState) -> None:
    if image.header_text != state.header_text:
        context.fail(
            "the mirror image has the same header as the joint state",
            expected=state.header_text,
            actual=image.header_text,
            hint=(
                "The header of the mirror image is different from the header of the joint state. "
                "Copy the whole header: header=joints.header."
            ),
        )
    for field, values, actual in (("name", state.name, image.name), ("effort", state.effort, image.effort)):
        context.expect(
            f"the mirror image has the same field `{field}` as the joint state",
            expected=values,
            actual=actual,
            hints=(
                f"The field `{field}` of the mirror image is different from this field of the "
                "joint state. Copy the list from the joint state."
            ),
        )
    for field, values, actual in (
        ("position", state.position, image.position),
        ("velocity", state.velocity, image.velocity),
    ):
        context.expect(
            f"every {field} in the mirror image has the opposite sign",
            expected=[-value for value in values],
            actual=actual,
            near=1e-9,
            hints=_wrong_signs(field, values),
        )


def _wrong_signs(field: str, values: list[float]) -> Hints:
    return [
        (values, f"The list `{field}` is the same as in the joint state. Change the sign of each number."),
        (
            [],
            (
                f"The list `{field}` is empty in the mirror image, but not in the joint state. Copy the list "
                "with opposite signs."
            ),
        ),
        (
            lambda actual: len(actual) < len(values),
            (
                f"The list `{field}` of the mirror image is too short. An arm can have any number of joints: "
                "change the sign of all numbers in the list."
            ),
        ),
        (
            [-abs(value) for value in values],
            "A negative number has to become a positive number. Use -value, not -abs(value).",
        ),
        (ANYTHING, "Some numbers are wrong. Change only the sign of each number."),
    ]


def _wrong_selection(stamps: list[int]) -> Hints:
    return [
        (
            lambda actual: len(set(actual)) < len(actual),
            "Some mirror images arrived more than once. Publish one mirror image for each joint state.",
        ),
        (
            lambda actual: actual and actual == stamps[: len(actual)] and len(actual) < 5,
            (
                "After the first invalid joint state, the node published no more messages. Ignore only "
                "the invalid message, and continue with the next message."
            ),
        ),
        (
            lambda actual: set(stamps) - set(actual) == {FIRST + EFFORT},
            (
                "The node ignored a joint state with an infinite effort, but this joint state is "
                "valid. Check only positions and velocities with math.isfinite."
            ),
        ),
        (
            lambda actual: set(stamps) - set(actual) == {FIRST + FEW_EFFORTS},
            "The node ignored a joint state in which the number of efforts is different from the "
            "number of names. Publish the mirror image of this joint state, because any number of "
            "efforts is valid.",
        ),
        (
            lambda actual: set(stamps) - set(actual) == {FIRST + LARGE},
            "The node ignored a joint state with two positions of 1e308, which are finite numbers. Check "
            "each number separately, because the sum of finite numbers can be infinite.",
        ),
        (
            lambda actual: set(stamps) - set(actual) == {FIRST + EMPTY},
            "A joint state with 0 names and 0 positions is valid, so publish its mirror image, too.",
        ),
        (
            lambda actual: set(stamps) - set(actual) <= {FIRST + 5 * n for n in range(6)},
            (
                "The node ignored a joint state without velocities, but this joint state is valid. "
                "Publish the mirror image, because many robots send no velocities."
            ),
        ),
        (
            ANYTHING,
            (
                "Some mirror images are missing. Publish each mirror image in the callback, "
                "because a loop with a pause misses messages."
            ),
        ),
    ]
