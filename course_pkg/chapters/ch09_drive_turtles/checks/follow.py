"""09.5: a client that calls three services, and then publishes turtle1's velocities for a second turtle."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from itertools import groupby

from course_pkg.chapters.ch09_drive_turtles.checks.spawn import LATE, LIMIT, SPAWN, TURTLE
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import TurtleProgram, script
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import (
    NO_MESSAGE,
    STARTING,
    World,
    fails_with_one,
    failure,
    has_traceback,
    outcome,
    own_message,
    why_it_ended,
)
from course_pkg.chapters.ch09_drive_turtles.checks.velocities import TWIST
from course_pkg.checking import ANYTHING, CheckContext, Refuse, part
from course_pkg.checking.assertions import Condition, first_unlike, same
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.peers.scripted_server import Act, Late, ScriptedServer
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.result import Finished
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import at_this_load, wait_until

PROGRAM = script("spawn_turtle_plus")
ORDER = ("spawn", "toggle_forward", "change_speed")
KINDS = {"spawn": SPAWN, "toggle_forward": "std_srvs/Empty", "change_speed": "course_pkg/ChangeSpeed"}
SPEED = 2.0  # The speed is in m/s.
DELAY = 2.4  # In one run, /spawn responds after this time in s.
FULL = 4.9  # A program that stops waiting after less than this time in s has not waited for 5 s.
LATER = 2.0  # The service /toggle_forward starts after this time in s.
TOO_LATE = (
    "The service /toggle_forward starts only after your program has called /spawn. Wait for each "
    "service immediately before its call."
)
WHERE = "Publish only on the topic /NAME/cmd_vel. NAME is the name of the turtle in the response of /spawn."
ENDED = "The node ended after the calls, so it receives no messages. Call rospy.spin() at the end."
ENDING = 0.6  # A program without spin() ends within this time in s.
COUNT = 20  # The check sends `COUNT` velocities, and the program must publish each of them.
RAPID = 0.005  # After these, the check publishes many velocities; the time between two of them is RAPID s.
LAST = 10.0  # On a busy machine, the program may need this additional time in s for the last velocity.
STOPS = (
    "if a service is missing for 5 s or refuses a call, the program makes no further call and ends "
    "with exit status 1"
)
CALLED = "Call /spawn, /toggle_forward and /change_speed in this order."
PASSED_ON = "Publish each velocity of turtle1 also for MyTurtle."
FOLLOW_GOALS = {
    CALLED: 3,
    PASSED_ON: 3,
    "End with exit status 1 if a service is missing or refuses a call.": 2,
}


@part(
    "09.5",
    points=4,
    goal=(
        "Write spawn_turtle_plus.py: spawn MyTurtle, call /toggle_forward, set the "
        "speed to 2 m/s, and publish the velocities of turtle1 for MyTurtle."
    ),
    needs=[f"file:{PROGRAM.path}"],
    deadline=60.0,
    start=f"%%writefile {PROGRAM.path}\n...",
    goals=FOLLOW_GOALS,
)
def bring_a_second_turtle(context: CheckContext) -> None:
    """Run the program with all three services, without one service, and with one that refuses calls."""
    follows(context, PROGRAM)


@dataclass
class Driver:
    """Servers of the three services that a program must call; the servers record all calls in order."""

    context: CheckContext
    world: World
    name: str = "MyTurtle"
    delay: float = 0.0  # The server of /spawn responds after this time in s.
    calls: list[str] = field(default_factory=list)
    called: float = 0.0  # The time of the last call (s, time.monotonic()).
    servers: dict[str, ScriptedServer] = field(default_factory=dict)

    def serve(self, *services: str, refusing: str = "") -> None:
        """Start servers for the services; the server of the service `refusing` refuses each call."""
        for service in services:
            self.servers[service] = self.context.serve(
                self.world.name(service),
                KINDS[service],
                lambda _, service=service: self._act(service, refuse=service == refusing),
            )

    def requests(self, service: str) -> list[dict[str, Json]]:
        """Return the requests that the service has received."""
        return [dict(request) for request in self.servers[service].requests]

    def _act(self, service: str, *, refuse: bool) -> Act:
        self.calls.append(service)
        self.called = time.monotonic()
        self.world.examine()
        acts: dict[str, dict[str, Json]] = {
            "spawn": {"name": self.name},
            "toggle_forward": {},
            "change_speed": {"before": 1.0},
        }
        act = Refuse(self.context.random.word()) if refuse else acts[service]
        return Late(self.delay, act) if service == "spawn" and self.delay else act


def follows(context: CheckContext, program: TurtleProgram) -> None:
    """Assert that a program meets the requirements of the exercise about spawn_turtle_plus.

    The runs of the program overlap, because one run takes 5 s.
    """
    copy = program.prepare(context, program)
    name = context.random.word()
    whole = Driver(context, World(context, copy, program, turtle=name), name)
    missing = [Driver(context, World(context, copy, program), delay=DELAY * (each == 1)) for each in range(3)]
    refusing = [Driver(context, World(context, copy, program)) for _ in ORDER]
    for service, without, refused in zip(ORDER, missing, refusing, strict=True):
        without.serve(*(each for each in ORDER if each != service))
        refused.serve(*ORDER, refusing=service)
    with ExitStack() as stack:
        waiting = [stack.enter_context(driver.world.run()) for driver in missing]
        running = stack.enter_context(whole.world.run())
        missing[0].called = missing[0].world.begins(waiting[0])
        whole.serve("spawn")
        _calls_in_order(context, whole, running)
        context.fulfilled(CALLED)
        _passes_on(context, whole, running)
        context.fulfilled(PASSED_ON)
        ending = [stack.enter_context(driver.world.run()) for driver in refusing]
        for number in (1, 0, 2):
            _stops_early(context, refusing[number], ending[number], ORDER[: number + 1], at_this_load(LIMIT))
        for number in (1, 0, 2):
            # On a busy machine, a run with a missing service may take longer than the other runs.
            end = missing[number].called + missing[number].delay + LIMIT + at_this_load(LATE)
            left = end - time.monotonic()
            done = _stops_early(context, missing[number], waiting[number], ORDER[:number], left)
            _waits_in_full(context, missing[number], done)


def _calls_in_order(context: CheckContext, driver: Driver, running: Running) -> None:
    """Assert that the program calls all three services in order; the second and third service start late."""

    def called(count: int, within: float) -> bool:
        return wait_until(lambda: len(driver.calls) >= count or running.status is not None, within, 0.05)

    called(1, STARTING)
    called(2, LATER)
    driver.serve("toggle_forward", "change_speed")
    called(len(ORDER), LIMIT)
    # A program that waited until the service was available has called a service with another name.
    waited = bool(driver.calls) and time.monotonic() - driver.called > LATER + 1
    done = running.status
    actual = ", ".join(f"/{name}" for name in driver.calls)
    if not actual:
        actual = "no call" if done is None else f"no call, {outcome(running.stop())}"
    context.require(
        "the program calls /spawn, /toggle_forward and /change_speed in this order, each service once",
        holds=driver.calls == list(ORDER),
        expected=", ".join(f"/{name}" for name in ORDER),
        actual=actual,
        hints=_why_not_called(driver.calls, running, ended=done is not None and not waited),
    )
    context.expect(
        "the program spawns MyTurtle at x = 3, y = 3, theta = 0",
        expected=TURTLE,
        actual=driver.requests("spawn")[0],
        near=1e-6,
        hints=(
            'The request is wrong. Compare its fields with x = 3, y = 3, theta = 0 and name = "MyTurtle".'
        ),
    )
    context.expect(
        "the program sets the speed to 2.0 m/s",
        expected={"speed": SPEED},
        actual=driver.requests("change_speed")[0],
        near=1e-6,
        hints="The request has the wrong speed. Send 2.0 in the field `speed`.",
    )


def _why_not_called(calls: list[str], running: Running, *, ended: bool) -> str:
    if sorted(calls) == sorted(ORDER):
        return "The program calls the three services in the wrong order. Spawn the turtle first."
    if ended and calls:
        return (
            f"The program ended too early, because /toggle_forward starts {LATER:g} s after the call "
            "of /spawn. Wait for each service before you call it."
        )
    if ended:
        done = running.stop()
        return TOO_LATE if done.status == 1 and "Traceback" not in done.err else why_it_ended(done)
    return (
        "The program waits, but does not call the next service. Compare the service names in your "
        "program with the names in the exercise."
    )


def _passes_on(context: CheckContext, driver: Driver, running: Running) -> None:
    """Assert that the new turtle gets turtle1's velocities.

    The response of /spawn contains a random name for the new turtle.
    """
    standing = _velocity()
    moving = [_velocity(*context.random.numbers(6, -2.0, 2.0)) for _ in range(COUNT - 2)]
    # The last two velocities are equal; the program must publish both.
    velocities = [standing, *moving, moving[-1]]
    subscription = context.subscribe(driver.world.name(f"{driver.name}/cmd_vel"), TWIST)
    wait_until(lambda: running.status is not None, ENDING, 0.1)
    ended: tuple[Condition, str] = ((lambda _: running.status is not None), ENDED)
    subscription.published(
        hints=[
            ended,
            ("no publisher", WHERE),
        ],
        within=4.0,
    )
    publisher = context.publish(
        driver.world.name("turtle1/cmd_vel"), TWIST, velocities, every=0.02, once=True
    )
    context.require(
        "the program subscribes to /turtle1/cmd_vel",
        holds=publisher.has_subscriber(4.0),
        expected="a subscriber",
        actual="no subscriber",
        hints=[
            ended,
            (
                ANYTHING,
                (
                    "The program receives no velocities of the first turtle. Subscribe to the topic "
                    "/turtle1/cmd_vel."
                ),
            ),
        ],
    )
    publisher.finish(5.0)
    subscription.wait(COUNT, 2.0)
    driver.world.runs_own_program()
    _each_once(context, velocities, subscription, driver.world.why_lost())
    own = {driver.world.name(f"{name}/cmd_vel") for name in ("turtle1", driver.name)}
    topics = [topic.name for topic in context.look().topics if topic.publishers]
    context.expect(
        "the program publishes each velocity once",
        expected=[],
        actual=[name for name in topics if name.startswith(driver.world.name("")) and name not in own],
        hints=WHERE,
    )
    _the_last(context, driver, subscription)


def _the_last(context: CheckContext, driver: Driver, subscription: Subscription) -> None:
    """Publish a random number of velocities at a high rate; the program must publish the last one."""
    count = context.random.integer(150, 250)
    velocities = [_velocity(number / 100) for number in range(1, count + 1)]
    topic = driver.world.name("turtle1/cmd_vel")
    context.publish(topic, TWIST, velocities, every=RAPID, once=True).finish(LAST)
    context.require(
        "the program publishes each velocity once",
        holds=subscription.until(lambda arrivals: same(velocities[-1], arrivals[-1].fields, 1e-6), LAST),
        expected=f"the last of {count} velocities",
        actual="another velocity",
        hints=(
            "The program stopped after some velocities. In the callback, publish each message, for any "
            "number of messages."
        ),
    )


def _each_once(
    context: CheckContext, velocities: list[dict[str, Json]], subscription: Subscription, lost: str
) -> None:
    received = [arrival.fields for arrival in subscription.arrivals]
    without_repeats = [velocity for velocity, _ in groupby(velocities)]
    context.expect(
        "the program publishes each velocity once",
        expected=COUNT,
        actual=len(received),
        hints=[
            (
                0,
                (
                    "The callback publishes nothing. In the callback, publish the message that the "
                    "callback receives."
                ),
            ),
            (
                (lambda count: count > COUNT),
                (
                    "Some velocities were published more than once. Publish each message once in the "
                    "callback, not in a loop."
                ),
            ),
            (
                (lambda _: same([*without_repeats], [*received], 1e-9)),
                (
                    "A velocity that is equal to the previous velocity is missing. Publish each message, "
                    "even if the message repeats the previous one."
                ),
            ),
            *([(ANYTHING, lost)] if lost else []),
            (ANYTHING, "Some velocities are missing. Publish each message immediately in the callback."),
        ],
    )
    sent, other = first_unlike(velocities, received, near=1e-9)
    context.expect(
        "the program publishes each message without a change",
        expected=sent,
        actual=other,
        near=1e-9,
        hints=[
            (
                (lambda actual: actual in velocities),
                (
                    "The program did not publish each received velocity once, in the order of arrival. In "
                    "the callback, publish the received message once, and do not publish in a loop."
                ),
            ),
            (
                ANYTHING,
                (
                    "Some fields of the published message differ from the received message. Publish the "
                    "whole received message, not only one or two of its fields."
                ),
            ),
        ],
    )


def _velocity(*numbers: float) -> dict[str, Json]:
    """Return a velocity; `numbers` are its first fields, and the other fields are 0."""
    values = [*numbers, *[0.0] * (6 - len(numbers))]
    linear: dict[str, Json] = dict(zip("xyz", values[:3], strict=True))
    angular: dict[str, Json] = dict(zip("xyz", values[3:], strict=True))
    return {"linear": linear, "angular": angular}


def _stops_early(
    context: CheckContext, driver: Driver, running: Running, calls: Sequence[str], within: float
) -> Finished:
    """Assert that the program makes only the calls `calls`, and that it then ends with an error."""
    done = driver.world.ends(running, max(within, 0.1))
    context.require(
        STOPS,
        holds=driver.calls == [*calls],
        expected=", ".join(f"/{name}" for name in calls) or "no call",
        actual=", ".join(f"/{name}" for name in driver.calls) or "no call",
        hints=(
            "After a failed call, the program still called the next service. End the program as "
            "soon as a service is missing or refuses a call."
        ),
    )
    context.require(
        STOPS,
        holds=fails_with_one(done),
        expected="a message, and the exit status 1",
        actual=failure(done),
        hints=[
            (
                (lambda _: done.status is None and len(driver.servers) == len(ORDER)),
                (
                    "A service refused the call, but the program did not end. Test the result of each call, "
                    "and end the program after a refused call."
                ),
            ),
            (
                (lambda _: done.status is None),
                (
                    "A service is missing, but the program did not end. Wait for each service with a "
                    "timeout of 5 s, and end the program after a timeout."
                ),
            ),
            ((lambda _: done.status == 1 and not own_message(done)), NO_MESSAGE),
            (
                (lambda _: not has_traceback(done)),
                (
                    "The program printed a message, but the exit status is wrong. After this message, end "
                    "the program with exit status 1."
                ),
            ),
            (
                ANYTHING,
                (
                    "The program does not handle this exception. If a service is missing for 5 s or refuses "
                    "a call, print a message and end with exit status 1."
                ),
            ),
        ],
    )
    return done


def _waits_in_full(context: CheckContext, driver: Driver, done: Finished) -> None:
    waited = done.ended - driver.called - driver.delay
    context.require(
        STOPS,
        holds=waited >= FULL,
        expected="a program that waits for the missing service for 5 s",
        actual=f"the program waited for {waited:.1f} s",
        hints=(
            "The program did not wait for 5 s after the previous call. Each of the three waits has its own "
            "limit of 5 s."
        ),
    )
