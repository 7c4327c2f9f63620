"""09.4: a driver with services for the direction, the rate and the speed.

A fourth service stops and starts the turtle.
"""

from __future__ import annotations

from course_pkg.chapters.ch09_drive_turtles.checks.rate import (
    AT_FIRST,
    REFUSALS,
    TINY,
    UNCHANGED,
    refuses,
    returns_the_old_rate,
)
from course_pkg.chapters.ch09_drive_turtles.checks.rate import KIND as CHANGE_RATE
from course_pkg.chapters.ch09_drive_turtles.checks.toggle import STRAIGHT, TURNING, toggles_the_stream
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import TurtleProgram, script
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import REFUSED, World
from course_pkg.chapters.ch09_drive_turtles.checks.velocities import Stream
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.peers.service_calls import Service

PROGRAM = script("improved_pubvel_toggle")
CHANGE_SPEED = "course_pkg/ChangeSpeed"
SERVICES = ("toggle_forward", "change_rate", "change_speed", "start_stop")
RATE = 20.0  # The check sets this rate in messages per second; at a higher rate, the check takes less time.
STANDING = (0.0, 0.0)
HUGE = 1e12  # This speed in m/s is allowed, because every finite number is allowed.
ANY_SPEED = (
    "The node refused an allowed speed. Accept every finite number: a negative speed moves the "
    "turtle backwards."
)
NO_REFUSAL = (
    "The node refused a call, because the turtle was already in the requested state. Return "
    'success=True and a message with the word "already".'
)
IGNORED_TOGGLE = (
    "The client called /toggle_forward while the turtle was stopped. After data=True, the turtle has to move "
    "in this new direction."
)
SETS_RATE = "/change_rate sets the rate"
SPEED_SO_FAR = "the response of /change_speed contains the speed before the call"
SETS_ITS_RATE = "Publish the velocities at the rate that /change_rate sets."
SETS_ITS_SPEED = (
    "Change the speed in the handler of /change_speed, and the direction in the handler of /toggle_forward."
)
IMPROVED_GOALS = {
    SETS_ITS_RATE: 2,
    SETS_ITS_SPEED: 3,
    ("Stop and start the turtle in the handler of /start_stop."): 3,
}


@part(
    "09.4",
    points=4,
    goal=(
        "Write improved_pubvel_toggle.py: offer /toggle_forward, /change_rate, /change_speed and /start_stop."
    ),
    needs=[f"file:{PROGRAM.path}"],
    deadline=60.0,
    start=f"%%writefile {PROGRAM.path}\n...",
    goals=IMPROVED_GOALS,
)
def change_speed_and_stop(context: CheckContext) -> None:
    """Set speeds, stop and start the turtle, and compare the published velocities.

    Stop the turtle while it moves straight ahead, and while it turns.
    """
    is_improved(context, PROGRAM)


def is_improved(context: CheckContext, program: TurtleProgram) -> None:
    """Assert that a program meets the requirements of the exercise about improved_pubvel_toggle."""
    world = World(context, program.prepare(context, program), program)
    with world.simulator(), world.run() as running:
        world.serves(running, *SERVICES)
        stream = Stream(context, world, running)
        stream.becomes(
            STRAIGHT,
            "before the first call, the turtle goes straight ahead at 1.0 m/s",
            [
                (
                    STANDING,
                    (
                        "The turtle does not move before the first call. Publish velocities "
                        "immediately after the start of the program."
                    ),
                ),
                (
                    ANYTHING,
                    (
                        "Before the first call, the turtle has to move straight ahead at 1.0 m/s. Check "
                        "the initial values of your variables."
                    ),
                ),
            ],
        )
        change_rate = world.service("change_rate", CHANGE_RATE, REFUSALS)
        returns_the_old_rate(context, change_rate, RATE, [AT_FIRST])
        stream.has_rate(
            RATE,
            SETS_RATE,
            (
                "The node does not publish at the rate that /change_rate has set. Copy the code of "
                "/change_rate from your program pubvel_toggle_plus."
            ),
        )
        for impossible in (0.0, 100.5, float("nan")):
            refuses(context, change_rate, SETS_RATE, rate=impossible)
        returns_the_old_rate(context, change_rate, RATE, [RATE], UNCHANGED)
        context.fulfilled(SETS_ITS_RATE)
        toggle = world.service("toggle_forward", "std_srvs/Empty")
        change_speed = _changes_speed(context, world, stream, toggle)
        context.fulfilled(SETS_ITS_SPEED)
        _starts_and_stops(context, world, stream, toggle, change_speed)
        stream.moves_turtle()
        change_rate(rate=TINY)


def _changes_speed(context: CheckContext, world: World, stream: Stream, toggle: Service) -> Service:
    """Set allowed and impossible speeds; return a proxy of the service that sets the speed."""
    change = world.service(
        "change_speed",
        CHANGE_SPEED,
        [(REFUSED, ANY_SPEED)],
    )
    first, second = context.random.number(2.0, 4.0), -context.random.number(100.0, 900.0)
    before = STRAIGHT[0]
    for wanted in (first, second):
        _returns_the_old_speed(context, change, wanted, before)
        before = wanted
        stream.becomes(
            (wanted, 0.0),
            "the turtle goes straight ahead at the speed that /change_speed has set",
            [
                (
                    STRAIGHT,
                    (
                        "After the call, the turtle still moves at 1.0 m/s. In the loop, use the "
                        "variable that the handler changes."
                    ),
                ),
                (
                    (abs(wanted), 0.0),
                    (
                        "With a negative speed, the turtle has to move backwards. Publish the speed "
                        "with its minus sign."
                    ),
                ),
                (
                    (float(int(wanted)), 0.0),
                    (
                        "The digits after the decimal point are lost. Store the speed as a float in "
                        "Python, or as a double in C++."
                    ),
                ),
                (
                    ANYTHING,
                    (
                        "The turtle does not move at the speed that /change_speed has set. Publish this "
                        "speed without a change."
                    ),
                ),
            ],
        )
    toggles_the_stream(toggle, stream, straight=(second, 0.0))
    for impossible in (float("nan"), float("inf"), -float("inf")):
        refuses(context, change, "/change_speed refuses a speed that is not finite", speed=impossible)
    stream.becomes(
        (second, 0.0),
        "after a refused call, the speed is the same as before",
        (
            "A refused call of /change_speed changed the velocity. Check the speed first, and change your "
            "variables only if the speed is finite."
        ),
    )
    _returns_the_old_speed(context, change, 0.0, second)
    _returns_the_old_speed(context, change, first, 0.0)
    return change


def _returns_the_old_speed(context: CheckContext, change: Service, wanted: float, before: float) -> None:
    context.expect(
        SPEED_SO_FAR,
        expected=before,
        actual=change(speed=wanted).before,
        near=1e-6,
        hints=[
            (
                wanted,
                (
                    "The field `before` contains the new speed. Save the old speed in a second variable "
                    "before you set the new speed."
                ),
            ),
            (
                ANYTHING,
                ("The field `before` is wrong. Set it to the speed that was set before this call."),
            ),
        ],
    )


def _starts_and_stops(
    context: CheckContext, world: World, stream: Stream, toggle: Service, change_speed: Service
) -> None:
    """In each direction, stop the turtle twice, set another speed, and start it twice.

    While the turtle is stopped, toggle its direction twice, and at the end three times.
    """
    switch = world.service(
        "start_stop",
        "std_srvs/SetBool",
        [(REFUSED, NO_REFUSAL)],
    )
    _says(context, switch, moving=True, already=True)
    twice = [(turning, 2) for turning in context.random.shuffled([False, True])]
    for turning, times in (*twice, (context.random.choice([False, True]), 3)):
        if turning:
            toggle()
        _says(context, switch, moving=False, already=False)
        stream.becomes(
            STANDING,
            "data=False stops the turtle: the program publishes velocities of 0",
            (
                "The turtle still moves after a call with data=False. After such a call, publish "
                "messages in which all fields are 0."
            ),
        )
        for _ in range(times):
            toggle()
        turns = turning == (times == 2)
        stream.becomes(
            STANDING,
            "data=False stops the turtle: the program publishes velocities of 0",
            "A call of /toggle_forward started the turtle again. In the handler of /toggle_forward, "
            "change only the direction.",
        )
        _says(context, switch, moving=False, already=True)
        speed = context.random.number(2.0, 9.0)
        before = change_speed(speed=HUGE).before  # The turtle is stopped, so it does not move at this speed.
        change_speed(speed=speed)
        _says(context, switch, moving=True, already=False)
        stream.becomes(
            TURNING if turns else (speed, 0.0),
            "data=True lets the turtle move as before",
            [
                *([((speed, 0.0) if turns else TURNING, IGNORED_TOGGLE)] if times == 3 else []),
                (
                    (before, 0.0),
                    (
                        "The client called /change_speed while the turtle was stopped. After data=True, "
                        "the turtle has to move at this new speed."
                    ),
                ),
                (
                    ANYTHING,
                    (
                        "After data=True, the turtle has to move in the newest direction and at the "
                        "newest speed. When you stop or start the turtle, do not change the variables "
                        "for direction and speed."
                    ),
                ),
            ],
        )
        _says(context, switch, moving=True, already=True)
        if turns:
            toggle()
    # The next calls follow each other without a pause, so that several calls occur between two messages.
    for moving in (False, True):
        for already in (False, True):
            _says(context, switch, moving=moving, already=already)


def _says(context: CheckContext, switch: Service, *, moving: bool, already: bool) -> None:
    response = switch(data=moving)
    context.expect(
        "`success` is True, even if the call changes nothing",
        expected=True,
        actual=response.success,
        hints=(
            "The field `success` is False. Set it to True in every response, even if the call changes "
            "nothing."
        ),
    )
    context.require(
        'the message contains the word "already" only if the call changes nothing',
        holds=("already" in response.message.lower()) == already and response.message.strip() != "",
        expected='a message with the word "already"' if already else 'a message without the word "already"',
        actual=response.message,
        hints=[
            ("", "The message is empty. Return a text that describes what the handler has done."),
            (
                matches("already"),
                'This call changed the state, so the message must not contain "already". Compare `data` '
                "with the old state before you set the new state.",
            ),
            (
                ANYTHING,
                (
                    'This call changed nothing, so the message has to contain "already". Test whether '
                    "`data` is equal to the current state."
                ),
            ),
        ],
    )
