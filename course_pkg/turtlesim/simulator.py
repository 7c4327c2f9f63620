"""The simulator as a node.

One thread updates the simulation; all other threads put jobs into the queue of this thread.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty as NoJob
from queue import SimpleQueue
from typing import TypeVar

import rospy
from std_srvs.srv import Empty, EmptyRequest, EmptyResponse
from turtlesim.srv import Kill, KillRequest, KillResponse, Spawn, SpawnRequest, SpawnResponse

from course_pkg.turtlesim.canvas import Colour
from course_pkg.turtlesim.roscpp_services import Refused, RoscppService, name_error
from course_pkg.turtlesim.turtle_interface import TurtleInterface
from course_pkg.turtlesim.world import BACKGROUND, TICK, NameTaken, Turtle, UnknownTurtle, World, all_finite

FIRST = "turtle1"  # This turtle exists after a reset.
# In one tick, the simulator handles requests for at most this time in s. Many requests therefore delay a pose
# by at most this time.
BUDGET = 0.008
# A tick with a longer delay than this time in s is skipped, for example after the machine was suspended.
MAX_DELAY = 0.25
DEFAULTS = dict(zip(("background_r", "background_g", "background_b"), BACKGROUND, strict=True))

Result = TypeVar("Result")


class Simulator:
    """The node's services, and the loop that updates the simulation."""

    def __init__(self) -> None:
        self._jobs: SimpleQueue[Callable[[], None]] = SimpleQueue()
        self._changes = threading.RLock()  # A thread acquires this lock before it adds or removes turtles.
        for name, value in DEFAULTS.items():
            if not rospy.has_param(f"~{name}"):
                rospy.set_param(f"~{name}", value)
        self._world = World(self._background())
        # run() iterates over this dict on another thread. Therefore, the dict is never changed, but replaced.
        self._interfaces: dict[str, TurtleInterface] = {}
        turtle = self._world.turtles[FIRST]
        self._announce(turtle)
        self._add(TurtleInterface(turtle, self._world.canvas, self.in_tick))
        self._services = [
            RoscppService("clear", Empty, self._clear),
            RoscppService("reset", Empty, self._reset),
            RoscppService("spawn", Spawn, self._spawn),
            RoscppService("kill", Kill, self._kill),
        ]

    def run(self) -> None:
        """Update the simulation every 16 ms until the node is shut down."""
        due = time.monotonic()
        while not rospy.is_shutdown():
            due = max(due + TICK, time.monotonic() - MAX_DELAY)
            while (rest := due - time.monotonic()) > 0:
                time.sleep(rest)
            self._do_jobs()
            for warning in self._world.tick(time.monotonic()):
                rospy.logwarn(warning)
            for interface in self._interfaces.values():
                interface.publish()

    def in_tick(self, job: Callable[[], Result]) -> Result:
        """Run the function `job` between two ticks, and return its result."""
        return self._in_next_tick(job).result()

    def _in_next_tick(self, job: Callable[[], Result]) -> Future[Result]:
        done: Future[Result] = Future()

        def run() -> None:
            try:
                done.set_result(job())
            except Exception as error:  # noqa: BLE001 -- raised in the thread that waits for the result
                done.set_exception(error)

        self._jobs.put(run)
        return done

    def _do_jobs(self) -> None:
        until = time.monotonic() + BUDGET
        while time.monotonic() < until:
            try:
                job = self._jobs.get_nowait()
            except NoJob:
                return
            job()

    def _spawn(self, request: SpawnRequest) -> SpawnResponse:
        if request.name and (message := name_error(request.name)):
            raise Refused(message)
        if not all_finite(request.x, request.y, request.theta):
            raise Refused("A position or an angle is not finite.")
        place = (request.x, request.y, request.theta)
        with self._changes:
            try:
                turtle = self._world.make(*place, request.name)
            except NameTaken as error:
                rospy.logerr(str(error))
                raise Refused("") from error
            added = self._in_next_tick(lambda: self._world.add(turtle))
            # This thread registers the turtle's topics and services at the master while the job waits for the
            # next tick.
            interface = TurtleInterface(turtle, self._world.canvas, self.in_tick)
            added.result()
            self._announce(turtle)
            self._add(interface)
        return SpawnResponse(turtle.name)

    def _kill(self, request: KillRequest) -> KillResponse:
        with self._changes:
            try:
                interface = self.in_tick(lambda: self._remove(request.name))
            except UnknownTurtle as error:
                rospy.logerr(str(error))
                raise Refused("") from error
            interface.close()
        return KillResponse()

    def _clear(self, _request: EmptyRequest) -> EmptyResponse:
        rospy.loginfo("Clearing turtlesim.")
        background = self._background()
        self.in_tick(lambda: self._world.clear(background))
        return EmptyResponse()

    def _reset(self, _request: EmptyRequest) -> EmptyResponse:
        rospy.loginfo("Resetting turtlesim.")
        background = self._background()
        with self._changes:
            removed = self._remove_others()
            done = self._in_next_tick(lambda: self._reset_world(background))
            # Closing the topics and services of a turtle takes six calls to the master. This thread makes
            # these calls while the job waits for the next tick.
            for interface in removed:
                interface.close()
            done.result()
            turtle = self._world.turtles[FIRST]
            self._announce(turtle)
            if turtle.name not in self._interfaces:  # turtle1 was killed before the reset.
                self._add(TurtleInterface(turtle, self._world.canvas, self.in_tick))
        return EmptyResponse()

    def _remove(self, name: str) -> TurtleInterface:
        removed = self._interfaces[self._world.kill(name).name]
        self._interfaces = {name: other for name, other in self._interfaces.items() if other is not removed}
        return removed

    def _remove_others(self) -> list[TurtleInterface]:
        """Remove and return the topics and services of all turtles except turtle1."""
        removed = [each for name, each in self._interfaces.items() if name != FIRST]
        self._interfaces = {name: each for name, each in self._interfaces.items() if name == FIRST}
        return removed

    def _reset_world(self, background: Colour) -> None:
        """Reset the world, and connect the topics and services to the new turtles."""
        self._world.reset(background)
        for name, interface in self._interfaces.items():
            interface.turtle = self._world.turtles[name]

    def _add(self, interface: TurtleInterface) -> None:
        self._interfaces = dict(sorted({**self._interfaces, interface.turtle.name: interface}.items()))

    def _announce(self, turtle: Turtle) -> None:
        place = f"x=[{turtle.x:f}], y=[{turtle.y:f}], theta=[{turtle.theta:f}]"
        rospy.loginfo(f"Spawning turtle [{turtle.name}] at {place}")

    def _background(self) -> Colour:
        """Return the background colour from the node's parameters, with defaults for invalid parameters."""
        own = rospy.get_param(rospy.get_name(), {})  # One call to the master reads all parameters.
        given = {**DEFAULTS, **own} if isinstance(own, dict) else DEFAULTS
        red, green, blue = (
            given[name] % 256 if isinstance(given[name], int) else default
            for name, default in DEFAULTS.items()
        )
        return red, green, blue
