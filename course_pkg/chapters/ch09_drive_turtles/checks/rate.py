"""09.3: a driver with a service that changes the rate."""

from __future__ import annotations

from course_pkg.chapters.ch09_drive_turtles.checks.toggle import ONE_CALL, TURNING, toggles_the_stream
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import TurtleProgram, script
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import REFUSED, World
from course_pkg.chapters.ch09_drive_turtles.checks.velocities import Stream
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.assertions import same
from course_pkg.checking.peers.service_calls import Service

PROGRAM = script("pubvel_toggle_plus")
KIND = "course_pkg/ChangeRate"
AT_FIRST = 2.0  # The program starts with this rate in messages per second.
# At the end, the check sets this rate in messages per second. The program then publishes its next message
# only after 1000 s.
TINY = 0.001
OTHER_RATE = (
    "The program did not publish at the rate that the client had set. Calculate the pause from "
    "the number in the request, and do not change this number."
)
TURNS_BACK = (
    "A call of /change_rate also changed the direction. In the handler of /change_rate, change only the rate."
)
ALLOWED = (
    "The node refused an allowed rate. Accept every number above 0 and up to 100: also 100, and fractions "
    "such as 0.5."
)
REFUSALS = [(REFUSED, ALLOWED)]
BEFORE = "the response contains the rate before the call"
IMPOSSIBLE = "/change_rate refuses impossible rates"
UNCHANGED = "after a refused call, the rate is the same as before"
MOST = 100.0  # This is the highest allowed rate.

START = f"""%%writefile {PROGRAM.path}
#!/usr/bin/env python3
import rospy
from course_pkg.srv import ChangeRate, ChangeRateResponse
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty, EmptyResponse

forward = True
frequency = 2.0


def handle_toggle(request):
    global forward
    forward = not forward
    return EmptyResponse()


def handle_rate(request):
    global frequency
    frequency = request.rate
    return ChangeRateResponse(before=frequency)


if __name__ == "__main__":
    rospy.init_node("pubvel_toggle_plus")
    rospy.Service("toggle_forward", Empty, handle_toggle)
    rospy.Service("change_rate", ChangeRate, handle_rate)
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=10)
    rate = rospy.Rate(frequency)
    while not rospy.is_shutdown():
        message = Twist()
        if forward:
            message.linear.x = 1.0
        else:
            message.angular.z = 1.0
        publisher.publish(message)
        rate.sleep()
"""
CHANGED = "Change the rate, return the old rate, and refuse impossible rates."
RATE_GOALS = {CHANGED: 3, "In the handler of /toggle_forward, change only the direction of the turtle.": 1}


@part(
    "09.3",
    points=3,
    goal=(
        "Repair pubvel_toggle_plus.py: /change_rate has to change the rate, return the old rate, "
        "and refuse impossible rates."
    ),
    needs=[f"file:{PROGRAM.path}"],
    deadline=60.0,
    start=START,
    goals=RATE_GOALS,
)
def change_the_rate(context: CheckContext) -> None:
    """Set rates and measure them; then set rates that are not allowed."""
    changes_its_rate(context, PROGRAM)


def changes_its_rate(context: CheckContext, program: TurtleProgram) -> None:
    """Assert that a program meets the requirements of the exercise about pubvel_toggle_plus."""
    world = World(context, program.prepare(context, program), program)
    with world.simulator(), world.run() as running:
        world.serves(running, "toggle_forward", "change_rate")
        stream = Stream(context, world, running)
        change = world.service("change_rate", KIND, REFUSALS)
        rate = sets_rates(context, change, stream)
        context.fulfilled(CHANGED)
        toggle = world.service("toggle_forward", "std_srvs/Empty")
        toggles_the_stream(toggle, stream)
        toggle()
        context.expect(
            BEFORE,
            expected=rate,
            actual=change(rate=rate).before,
            near=1e-6,
            hints=(
                "A call of /toggle_forward also changed the rate. In the handler of "
                "/toggle_forward, change only the direction."
            ),
        )
        for _ in range(context.random.integer(40, 60)):
            returns_the_old_rate(context, change, rate, [rate])
        stream.becomes(TURNING, ONE_CALL, TURNS_BACK)
        stream.moves_turtle()
        change(rate=TINY)


def sets_rates(context: CheckContext, change: Service, stream: Stream) -> float:
    """Set allowed and forbidden rates, and measure some of the allowed rates; return the last allowed rate.

    The periods of the measured rates are not whole numbers of seconds or of hundredths of a second.
    """
    fast, slow = context.random.number(34.5, 38.5), context.random.number(0.6, 0.7)
    others = context.random.numbers(context.random.integer(1, 4), 5.0, 90.0)
    earlier = [AT_FIRST]
    for wanted in (fast, *others, MOST, slow, fast):
        returns_the_old_rate(context, change, wanted, earlier)
        earlier.append(wanted)
        if wanted in (fast, slow, MOST):
            stream.has_rate(
                wanted,
                "the program publishes at the rate that /change_rate sets",
                [
                    ((lambda actual: float(actual.split()[0]) > 2 * AT_FIRST), OTHER_RATE),
                    (
                        ANYTHING,
                        (
                            "The rate of a Rate object never changes. After a call of /change_rate, "
                            "create a new Rate object."
                        ),
                    ),
                ],
                # A program may not reach the highest rate on a busy machine.
                **({"seconds": 0.4, "near": 0.4} if wanted == MOST else {}),
            )
    for impossible in (0.0, -slow, 100.5, float("nan")):
        refuses(context, change, IMPOSSIBLE, rate=impossible)
    returns_the_old_rate(context, change, fast, [fast], UNCHANGED)
    refuses(context, change, IMPOSSIBLE, rate=context.random.number(150.0, 900.0))
    stream.has_rate(
        fast,
        UNCHANGED,
        (
            "After a refused call, the program publishes at another rate. Check the rate first, and change "
            "your variables only if the rate is allowed."
        ),
        seconds=0.3,
        near=0.5,
    )
    return fast


def returns_the_old_rate(
    context: CheckContext, change: Service, wanted: float, earlier: list[float], assertion: str = BEFORE
) -> None:
    """Set the rate `wanted`; assert that the response contains the last rate in `earlier`.

    The list `earlier` contains the rates that the check has set.
    """
    before = earlier[-1]
    context.expect(
        assertion,
        expected=before,
        actual=change(rate=wanted).before,
        near=1e-6,
        hints=[
            (
                float(int(before)),
                (
                    "The digits after the decimal point are lost. Store the rate as a float in Python, "
                    "or as a double in C++."
                ),
            ),
            (
                wanted,
                (
                    "The field `before` contains the new rate. Save the old rate in a second variable "
                    "before you set the new rate."
                ),
            ),
            (0.0, "The field `before` has its default value, 0.0. Set this field to the old rate."),
            (
                (lambda actual: not 0 < actual <= MOST),
                (
                    "The handler stored the rate before it refused the call. Check the rate first, and "
                    "store only an allowed rate."
                ),
            ),
            (
                (lambda actual: actual in earlier),
                (
                    "The field `before` contains an older rate. Return the rate of the previous call, "
                    "even if the loop does not use this rate yet."
                ),
            ),
            (
                (lambda actual: same(1 / before, actual, 1e-6)),
                (
                    "The field `before` contains the pause between two messages. Set this field to the old "
                    "rate in messages per second."
                ),
            ),
            (
                ANYTHING,
                (
                    "The field `before` has a wrong value. Return the rate of the previous call. In "
                    "the first call, return 2.0, because the program begins with 2 messages per second."
                ),
            ),
        ],
    )


def refuses(context: CheckContext, service: Service, assertion: str, **fields: float) -> None:
    """Assert that the handler refuses a request; an unexpected exception is not a refusal."""
    ((field, number),) = fields.items()
    if number != number:
        why = "Every comparison with nan is False, so test for nan separately"
    elif field == "speed":  # The exercise sets no limits for a speed.
        why = "Accept only finite numbers (math.isfinite, in C++ std::isfinite)"
    else:
        why = "Compare the number with the limits in the exercise"
    hint = (
        f"The value {number:g} is not allowed, but the client got a response without an error. {why}, and "
        "refuse a wrong value: raise rospy.ServiceException, or return false in C++."
    )
    error = service.refused(assertion, saying="", hints=hint, **fields)
    context.require(
        assertion,
        holds="error processing" not in error,
        expected="a refusal",
        actual=error,
        hints=(
            "The handler raised an error of the wrong type. To refuse a call, raise rospy.ServiceException."
        ),
    )
