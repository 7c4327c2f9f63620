"""The velocities that the student's program publishes for turtle1."""

from __future__ import annotations

import time
from typing import NoReturn

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import World, outcome, why_it_ended
from course_pkg.checking import CheckContext
from course_pkg.checking.assertions import Hints, same
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.peers.subscription import Arrival, Subscription, rate
from course_pkg.checking.plain_values import Fields
from course_pkg.waiting import wait_until

TWIST = "geometry_msgs/Twist"
KEEP_COMING = "the program publishes velocities all the time"
# SILENCE is the maximum time in s without a message, even at the lowest measured rate of 0.6 Hz.
SILENCE = 4.0
# After a response, a message from before the call may still arrive within this time in s.
FLYING = 0.05
SILENT = (
    "No velocity arrived for 4 s. In each round of the loop, publish a message, even if the velocity is "
    "0, and pause only once."
)
ONE_LATE = (
    "The first message after the call still contained the old velocity. After the pause, read the variables "
    "first, and then publish the message immediately."
)
# A measured rate may differ from the right rate by this fraction, because the machine may be busy.
NEAR = 0.25
TRIES = 3  # A rate is measured up to this number of times.
CALLS = 12  # The check makes this many calls at the same time.


class Stream:
    """A subscription to the velocities of turtle1 in a `World`."""

    def __init__(self, context: CheckContext, world: World, running: Running) -> None:
        self._context = context
        self._world = world
        self._running = running
        self._late: list[bool] = []  # For each call of becomes(): whether an old velocity arrived first.
        self._subscription: Subscription = context.subscribe(world.name("turtle1/cmd_vel"), TWIST)
        self._subscription.published(
            within=4.0,
            hints=[
                (
                    "no publisher",
                    "The node does not publish on /turtle1/cmd_vel. Compare this name with the name of "
                    "the topic in your program.",
                )
            ],
        )

    def next(self, count: int, within: float = SILENCE) -> list[Arrival]:
        """Return the next `count` messages; assert that each message arrives in time.

        The maximum time until a message arrives is `within` (s).
        """
        before = len(self._subscription.arrivals)
        for number in range(before + 1, before + count + 1):
            if len(self._subscription.wait(number, within)) < number:
                self._silent(within)
        self._context.require(KEEP_COMING, holds=True)
        return list(self._subscription.arrivals[before:])

    def _silent(self, within: float) -> NoReturn:
        ended = self._running.status is not None
        done = self._running.stop()
        self._context.fail(
            KEEP_COMING,
            expected="a message",
            actual=outcome(done) if ended else f"no message for {within:g} s",
            hint=why_it_ended(done) if ended else SILENT,
        )

    def becomes(self, wanted: tuple[float, float], assertion: str, hints: Hints) -> None:
        """Assert that the turtle's velocity becomes `wanted` (m/s, rad/s) within about 1 s.

        Messages that arrived before the call of this method are ignored.
        """
        now = time.monotonic()
        arrival, late = self.next(1)[-1], False
        while arrival.at < now + FLYING or (
            not same([*wanted], [*velocity(arrival)]) and arrival.at < now + 1.0
        ):
            late = late or arrival.at > now + FLYING
            arrival = self.next(1)[-1]
        self._late.append(late)
        self._context.expect(assertion, expected=wanted, actual=velocity(arrival), near=1e-6, hints=hints)
        self._context.expect(
            assertion,
            expected=[0.0] * 4,
            actual=_other_fields(arrival),
            hints="A field of the velocity is not 0, but it has to be 0. Set only linear.x and angular.z.",
        )

    def reacts_at_once(self, assertion: str, changes: int) -> None:
        """Assert that, after at least one of the last `changes` calls, the first message was not an old one.

        A program may read a variable just before a call and publish just after the call, but not every time.
        """
        self._context.require(
            assertion,
            holds=not all(self._late[-changes:]),
            expected="the new velocity in the first message after the call",
            actual="the old velocity in the first message after each call",
            hints=ONE_LATE,
        )

    def only(self, *wanted: tuple[float, float]) -> None:
        """Assert that each message so far contains one of the velocities `wanted` (m/s, rad/s)."""
        others = [each for each in map(velocity, self._subscription.arrivals) if each not in wanted]
        self._context.require(
            KEEP_COMING,
            holds=not others,
            expected=f"only the velocities {' and '.join(map(str, wanted))}",
            actual=others[0] if others else "no other velocity",
            hints="A message contained a wrong velocity. Publish only in the loop, not in the handler.",
        )

    def has_rate(
        self, wanted: float, assertion: str, hints: Hints, *, seconds: float = 1.0, near: float = NEAR
    ) -> None:
        """Assert that the messages arrive at the rate `wanted` (Hz).

        One measurement takes about the time `seconds` (s), and at least two periods. The measured rate may
        differ from `wanted` by the fraction `near`. After a change of the rate, the first messages may still
        arrive at the old rate.
        """
        count = max(2, int(wanted * seconds))
        self.next(1)
        for _ in range(TRIES):
            measured = rate(self.next(count + 1))
            if abs(measured - wanted) < near * wanted:
                break
        self._context.require(
            assertion,
            holds=abs(measured - wanted) < near * wanted,
            expected=f"{wanted:g} messages per second",
            actual=f"{measured:.1f} messages per second",
            hints=hints,
        )

    def has_no_extra_messages(self, service: Service, assertion: str, usual: float) -> None:
        """Make `CALLS` calls at the same time, and assert that the program publishes no additional messages.

        `usual` is the number of messages per second without calls.
        """
        before, began = len(self._subscription.arrivals), time.monotonic()
        service.at_once([{}] * CALLS)
        took = self.next(1)[-1].at - began
        arrived = len(self._subscription.arrivals) - before
        self._context.require(
            assertion,
            holds=arrived < took * usual + CALLS / 2,
            expected="the same rate while clients call the service",
            actual=f"{arrived} messages in {took:.1f} s",
            hints="Each call of the service published one more message. Publish only in the loop, not in "
            "the handler.",
        )

    def moves_turtle(self) -> None:
        """Assert that the turtle in the simulator moves."""
        poses = self._context.subscribe(self._world.name("turtle1/pose"), "turtlesim/Pose")
        poses.wait(1, 10.0)

        def moved() -> bool:
            first, last = poses.arrivals[0].fields, poses.arrivals[-1].fields
            return any(first[key] != last[key] for key in ("x", "y", "theta"))

        self._context.require(
            "turtle1 moves in the simulator",
            holds=bool(poses.arrivals) and wait_until(moved, 5.0),
            expected="a pose that changes",
            actual="a pose that stays the same",
        )


def velocity(arrival: Arrival) -> tuple[float, float]:
    """Return the speed (m/s) and the angular velocity (rad/s) in a message."""
    linear, angular = _vectors(arrival)
    return float(linear["x"]), float(angular["z"])


def _other_fields(arrival: Arrival) -> list[float]:
    linear, angular = _vectors(arrival)
    return [float(number) for number in (linear["y"], linear["z"], angular["x"], angular["y"])]


def _vectors(arrival: Arrival) -> tuple[Fields, Fields]:
    linear, angular = arrival.fields["linear"], arrival.fields["angular"]
    assert isinstance(linear, dict)
    assert isinstance(angular, dict)
    return linear, angular
