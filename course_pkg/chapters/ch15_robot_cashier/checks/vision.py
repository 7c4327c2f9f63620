"""15.1: a node that publishes for each valid frame whether the frame shows a customer."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import rospy
from sensor_msgs.msg import Image

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import Interface, student_node
from course_pkg.checking import CheckContext, part
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.waiting import wait_until

NAME = "vision"
FRAMES, SEEN = "frames", "customer_seen"
INTERFACE = Interface(publishes=[SEEN], subscribes=[FRAMES])
BOOL = "std_msgs/Bool"
DARK = 96
# On a busy machine, the message after a frame may take up to this time in s; it usually takes 5 ms.
ANSWER = 8.0
RAPID = 0.005  # In a long series, the time between two frames is RAPID s.
LAST = 10.0  # On a busy machine, the message for the last frame of the series may need this time in s.
AGAIN = 0.03  # A wrong second message would arrive within this time in s.
SILENT = 0.25  # A wrong message after a malformed frame would arrive within this time in s.

AVERAGE = (
    "A fifth of the points is dark, so this frame shows a customer. Count the dark points, and do "
    "not use the average of all points."
)
NOISE = (
    "Only a twentieth of the points is dark, so this frame shows no customer. A frame shows a "
    "customer if at least a tenth of all points is dark."
)
TENTH = "Exactly a tenth of the points is dark, so this frame shows a customer. Compare with >=, not with >."
ROUNDED = (
    "The number of dark points is less than a tenth of all points, so this frame shows no "
    "customer. Compare without rounding: 10 * dark >= width * height."
)
LIMIT = (
    "Some points have the value 96, but a point is dark only if its value is below 96. Compare with <, "
    "not with <=."
)
PADDING = (
    "Each row has frame.step bytes, but only the first frame.width bytes are points. The row with "
    "the index r begins at byte r * frame.step. The frame has width * height points."
)
ENCODING = (
    "The encoding of this frame is not mono8, so the frame is not valid. Publish nothing if "
    'frame.encoding is not "mono8".'
)
EMPTY = "No point is dark, so this frame shows no customer. Publish False."
STOPPED = (
    "The node stopped after some frames. In the callback, publish a message for each valid frame, for any "
    "number of frames."
)
NOTHING = (
    "The node published nothing for a valid frame. Check whether the callback reaches the line that "
    "publishes."
)
TWICE = "The node published more than one message for a frame. Publish one message for each valid frame."
BROKE = (
    "The node published nothing for a valid frame after a malformed frame. Check each frame before "
    "you read its points."
)
SHOWN = "For each valid frame, publish whether the frame shows a customer."


@part(
    "15.1",
    points=2,
    goal=(
        "Write vision.py: for each valid frame, publish on customer_seen whether the frame shows a customer."
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME),
    goals={SHOWN: 3, "Publish nothing for malformed frames.": 1},
)
def the_vision(context: CheckContext) -> None:
    """Send padded frames, invalid frames, and frames with a number of dark points near the limit."""
    with student_node(context, NAME, INTERFACE) as space:
        seen = context.subscribe(f"{space}/{SEEN}", BOOL)
        seen.published()
        camera = Camera(f"{space}/{FRAMES}")
        camera.is_heard(context)
        width, height = (10 * number for number in context.random.integers(2, 2, 5))
        for frame in _valid_frames(context, width, height):
            _shows(context, camera, seen, frame)
        _shows_the_last(context, camera, seen, image_of(context, width, height, width * height))
        context.fulfilled(SHOWN)
        for what, malformed, hint in _malformed_frames(context, width, height):
            _leaves_out(context, camera, seen, malformed, what, hint)


@dataclass(frozen=True)
class Frame:
    """A valid frame, the right message for this frame, and the hint for a wrong message."""

    assertion: str
    image: Image
    customer: bool
    hint: str


@dataclass(frozen=True)
class Style:
    """The brightness of dark points, the number of padding bytes in a row, and the value of these bytes."""

    dark: tuple[int, int] = field(default=(0, DARK - 1))
    padding: int = 0
    filling: int = 0


class Camera:
    """Publishes frames, one at a time."""

    def __init__(self, topic: str) -> None:
        self._publisher = rospy.Publisher(topic, Image, queue_size=10, tcp_nodelay=True)

    def is_heard(self, context: CheckContext) -> None:
        """Assert that the student's node receives the frames."""
        context.require(
            "the node subscribes to the frames with the type sensor_msgs/Image",
            holds=bool(wait_until(self._publisher.get_num_connections, 5.0)),
            expected="a subscriber of the type sensor_msgs/Image",
            actual="a subscriber of another type",
            hints=(
                "The node subscribes to the topic of the frames with a wrong type. Pass Image from "
                "sensor_msgs.msg to rospy.Subscriber."
            ),
        )

    def send(self, image: Image) -> None:
        """Publish one frame."""
        image.header.stamp = rospy.Time.now()
        self._publisher.publish(image)


def image_of(context: CheckContext, width: int, height: int, dark: int, style: Style | None = None) -> Image:
    """Return a frame with `dark` dark points at random positions; all other points are very bright."""
    style = style or Style()
    points = [context.random.integer(*style.dark) for _ in range(dark)]
    points += [context.random.integer(230, 255) for _ in range(width * height - dark)]
    points = context.random.shuffled(points)
    rows = [points[start : start + width] for start in range(0, len(points), width)]
    data = bytes(byte for row in rows for byte in [*row, *[style.filling] * style.padding])
    return Image(width=width, height=height, step=width + style.padding, encoding="mono8", data=data)


def _valid_frames(context: CheckContext, width: int, height: int) -> list[Frame]:
    tenth = width * height // 10
    odd_width, odd_height = width + 1, height + 1
    # The number of dark points in this frame is just below the limit, which is a tenth of all points.
    odd_dark = odd_width * odd_height // 10
    return [
        Frame(assertion, image_of(context, width, height, dark, style), customer, hint)
        for assertion, dark, customer, style, hint in (
            ("a bright frame shows no customer", 0, False, Style(), EMPTY),
            ("a frame with many dark points shows a customer", 2 * tenth, True, Style(), AVERAGE),
            ("a frame with few dark points shows no customer", tenth // 2, False, Style(), NOISE),
            (
                "a frame shows a customer if exactly a tenth of its points is dark",
                tenth,
                True,
                Style(),
                TENTH,
            ),
            (
                "a frame shows no customer if less than a tenth of its points is dark",
                tenth - 1,
                False,
                Style(),
                ROUNDED,
            ),
            ("a point with the value 96 is not dark", 2 * tenth, False, Style(dark=(DARK, DARK)), LIMIT),
            ("the node ignores the padding at the end of each row", 0, False, Style(padding=7), PADDING),
            (
                "the node ignores the padding at the end of each row",
                tenth,
                True,
                Style(padding=9, filling=255),
                PADDING,
            ),
        )
    ] + [
        Frame(
            "a frame shows no customer if less than a tenth of its points is dark",
            image_of(context, odd_width, odd_height, odd_dark),
            customer=False,
            hint=ROUNDED,
        )
    ]


def _shows(context: CheckContext, camera: Camera, seen: Subscription, frame: Frame) -> None:
    before = seen.count
    camera.send(frame.image)
    came = seen.until(lambda arrivals: len(arrivals) > before, ANSWER if before else 3.0)
    context.require(
        "the node publishes a message for a valid frame",
        holds=came,
        expected="a message on customer_seen",
        actual="none",
        hints=frame.hint if frame.hint is PADDING else NOTHING,
    )
    _once(context, seen, before)
    context.expect(
        frame.assertion,
        expected=frame.customer,
        actual=seen.arrivals[before].fields["data"],
        hints=frame.hint,
    )


def _shows_the_last(context: CheckContext, camera: Camera, seen: Subscription, dark: Image) -> None:
    """Send a random number of bright frames at a high rate, and then a frame that shows a customer."""
    bright = image_of(context, dark.width, dark.height, 0)
    count = context.random.integer(150, 250)
    for _ in range(count):
        camera.send(bright)
        time.sleep(RAPID)
    camera.send(dark)
    context.require(
        "the node publishes a message for a valid frame",
        holds=seen.until(lambda arrivals: arrivals[-1].fields["data"], LAST),
        expected=f"True, after {count} bright frames and a dark frame",
        actual="no message for the last frame",
        hints=STOPPED,
    )


def _malformed_frames(context: CheckContext, width: int, height: int) -> list[tuple[str, Image, str]]:
    dark = width * height
    frames = [image_of(context, width, height, dark) for _ in range(8)]
    frames[0].data = frames[0].data[:-3]
    frames[1].data += b"\0"
    frames[2].encoding, frames[2].step, frames[2].data = "rgb8", 3 * width, frames[2].data * 3
    frames[3].step, frames[3].data = width - 1, frames[3].data[height:]
    frames[4].height, frames[4].data = 0, b""
    frames[5].width, frames[5].step, frames[5].data = 0, 4, bytes(4 * height)
    frames[6].encoding = "8UC1"
    frames[7].encoding, frames[7].step, frames[7].data = "mono16", 2 * width, frames[7].data * 2
    return [
        (
            "too few bytes",
            frames[0],
            (
                "Bytes are missing in this frame. Before you read the points, compare len(frame.data) "
                "with height * step."
            ),
        ),
        (
            "too many bytes",
            frames[1],
            (
                "This frame has more bytes than height * step, so it is not valid. A valid frame has "
                "exactly height * step bytes."
            ),
        ),
        ("another encoding", frames[2], ENCODING),
        ("another encoding", frames[6], ENCODING),
        ("another encoding", frames[7], ENCODING),
        (
            "a step below the width",
            frames[3],
            (
                "In this frame, a row has fewer bytes than points, which is impossible. Compare "
                "frame.step with frame.width."
            ),
        ),
        (
            "no rows",
            frames[4],
            "The height of this frame is 0, so it has no points. Publish nothing if frame.width or "
            "frame.height is 0.",
        ),
        (
            "no points in a row",
            frames[5],
            "The width of this frame is 0, so all its bytes are padding. Publish nothing if "
            "frame.width or frame.height is 0.",
        ),
    ]


def _leaves_out(
    context: CheckContext, camera: Camera, seen: Subscription, malformed: Image, what: str, hint: str
) -> None:
    """Send a malformed frame and then a valid frame; exactly one message must arrive."""
    before = seen.count
    camera.send(malformed)
    seen.until(lambda arrivals: len(arrivals) > before, SILENT)
    context.require(
        f"the node publishes nothing for a malformed frame: {what}",
        holds=seen.count == before,
        expected="no message",
        actual="a message on customer_seen",
        hints=hint,
    )
    camera.send(image_of(context, 10, 10, 0))
    came = seen.until(lambda arrivals: len(arrivals) > before, ANSWER)
    context.require(
        "the node continues after a malformed frame",
        holds=came,
        expected="a message",
        actual="none",
        hints=BROKE,
    )
    _once(context, seen, before)


def _once(context: CheckContext, seen: Subscription, before: int) -> None:
    """Assert that exactly one message arrives after the first `before` messages."""
    seen.until(lambda arrivals: len(arrivals) > before + 1, AGAIN)
    context.require(
        "the node publishes one message for each frame",
        holds=seen.count == before + 1,
        expected="one message",
        actual=f"{seen.count - before} messages",
        hints=TWICE,
    )
