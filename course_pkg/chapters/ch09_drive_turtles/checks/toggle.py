"""09.2: a driver with a service that toggles the direction."""

from __future__ import annotations

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import TurtleProgram, script
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import World
from course_pkg.chapters.ch09_drive_turtles.checks.velocities import Stream
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.service_calls import Service

PROGRAM = script("pubvel_toggle")
RATE = 2.0  # The program must publish this many messages per second.
STRAIGHT, TURNING = (1.0, 0.0), (0.0, 1.0)  # The speed is in m/s, and the angular velocity is in rad/s.
ONE_CALL = "after a call, the turtle turns at 1.0 rad/s"
NEXT_CALL = "after the next call, the turtle goes straight ahead again"
AT_FIRST: Hints = [
    (TURNING, "Before the first call, the turtle has to go straight ahead. Begin with `forward = True`."),
    (
        ANYTHING,
        (
            "The turtle does not move at 1.0 m/s. To drive straight ahead, set linear.x = 1.0 and leave the "
            "other fields at 0."
        ),
    ),
]
TOGGLED: Hints = [
    (
        STRAIGHT,
        "After the call, the turtle still goes straight ahead. In the handler, change the variable that "
        "the loop reads. In Python, a handler that changes a global variable needs a `global` line.",
    ),
    (
        (1.0, 1.0),
        (
            "The turtle turns, but it also moves ahead. Create a new message in each round of the "
            "loop, or set both linear.x and angular.z in each round."
        ),
    ),
    (ANYTHING, "The velocity is wrong while the turtle turns. Set linear.x to 0.0 and angular.z to 1.0."),
]
TOGGLED_AGAIN: Hints = [
    (
        STRAIGHT,
        "The first call changed the direction, but a later call did not change it. Change the direction "
        "in each call, for any number of calls.",
    ),
    *TOGGLED,
]
BACK: Hints = [
    (
        TURNING,
        (
            "The second call changed nothing. In each call, change the variable from True to False, or "
            "from False to True."
        ),
    ),
    (
        ANYTHING,
        (
            "After the second call, the turtle has to go straight ahead again. Set both linear.x and "
            "angular.z."
        ),
    ),
]

START = f"""%%writefile {PROGRAM.path}
#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist

if __name__ == "__main__":
    rospy.init_node("pubvel_toggle")
    publisher = rospy.Publisher("turtle1/cmd_vel", Twist, queue_size=10)
    rate = rospy.Rate(2)
    while not rospy.is_shutdown():
        message = Twist()
        message.linear.x = 1.0
        publisher.publish(message)
        rate.sleep()
"""
TOGGLED_BY_CALL = "Drive straight ahead until the first call, and change the direction in each call."
TOGGLE_GOALS = {TOGGLED_BY_CALL: 3, "Publish twice per second, and move the turtle.": 1}


@part(
    "09.2",
    points=2,
    goal=(
        "Add the service /toggle_forward to pubvel_toggle.py: one call makes the turtle turn, and the "
        "next call makes it go straight ahead."
    ),
    needs=[f"file:{PROGRAM.path}"],
    deadline=60.0,
    start=START,
    goals=TOGGLE_GOALS,
)
def toggle_direction(context: CheckContext) -> None:
    """Toggle the direction a few times, and check the velocities that the program publishes."""
    toggles(context, PROGRAM)


def toggles(context: CheckContext, program: TurtleProgram, *, pairs: tuple[int, int] = (25, 40)) -> None:
    """Assert that a program meets the requirements of the exercise about pubvel_toggle.

    The check makes a random number of pairs of calls; `pairs` contains the smallest and the largest number.
    """
    world = World(context, program.prepare(context, program), program)
    with world.simulator(), world.run() as running:
        world.serves(running, "toggle_forward")
        stream = Stream(context, world, running)
        stream.becomes(STRAIGHT, "before the first call, the turtle goes straight ahead at 1.0 m/s", AT_FIRST)
        toggle = world.service("toggle_forward", "std_srvs/Empty")
        toggles_the_stream(toggle, stream, context.random.integer(1, 2))
        _counts_each_call(toggle, stream, 2 * context.random.integer(*pairs) + 1)
        stream.only(STRAIGHT, TURNING)
        context.fulfilled(TOGGLED_BY_CALL)
        stream.has_rate(
            RATE,
            "the program publishes twice per second",
            (
                "The program does not publish twice per second. Create rospy.Rate(2) (in C++: "
                "ros::Rate(2)), and call its method sleep() once after each message."
            ),
        )
        stream.has_no_extra_messages(toggle, "the program publishes twice per second", RATE)
        stream.moves_turtle()
        world.stops(running)


def _counts_each_call(toggle: Service, stream: Stream, many: int) -> None:
    """Make several calls between two messages; then make `many` more calls."""
    for _ in range(2):
        toggle()
    stream.becomes(STRAIGHT, NEXT_CALL, BACK)
    for _ in range(many):
        toggle()
    stream.becomes(TURNING, ONE_CALL, TOGGLED_AGAIN)


def toggles_the_stream(
    toggle: Service, stream: Stream, times: int = 1, straight: tuple[float, float] = STRAIGHT
) -> None:
    """Toggle the direction to turning and back to straight ahead; `times` is the number of repetitions."""
    for before in range(times):
        toggle()
        stream.becomes(TURNING, ONE_CALL, TOGGLED_AGAIN if before else TOGGLED)
        toggle()
        stream.becomes(straight, NEXT_CALL, BACK)
    stream.reacts_at_once(NEXT_CALL, 2 * times)
