"""The simulator on the graph: one thread moves the world tick by tick, others wait for their turn."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from queue import Empty as NothingToDo
from queue import SimpleQueue
from typing import Any, TypeVar

import rospy
from std_srvs.srv import Empty, EmptyResponse
from turtlesim.srv import Kill, KillResponse, Spawn, SpawnResponse

from course_pkg.turtlesim.actor import Actor
from course_pkg.turtlesim.answering import Answering, Refused
from course_pkg.turtlesim.names import objection
from course_pkg.turtlesim.paper import Colour
from course_pkg.turtlesim.world import BACKGROUND, TICK, NameTaken, Turtle, UnknownTurtle, World, sound

FIRST = "turtle1"  # the turtle that is there after a reset
BUDGET = 0.008  # s of a tick for requests: a flood of them delays nobody's pose by more
LATEST = 0.25  # s; a machine that slept does not catch up with more
DEFAULTS = dict(zip(("background_r", "background_g", "background_b"), BACKGROUND, strict=True))

Result = TypeVar("Result")


class Simulator:
    """The services of the node, and the loop that everything happens in."""

    def __init__(self) -> None:
        self._jobs: SimpleQueue[tuple[Callable[[], Any], Future[Any]]] = SimpleQueue()
        self._changes = threading.RLock()  # who comes and goes, one at a time
        for name, value in DEFAULTS.items():
            if not rospy.has_param(f"~{name}"):
                rospy.set_param(f"~{name}", value)
        self._world = World(self._background())
        self._actors: dict[str, Actor] = {}  # replaced, never changed: the loop may be going through it
        turtle = self._world.turtles[FIRST]
        self._announce(turtle)
        self._enter(Actor(turtle, self._world.paper, self.in_tick))
        self._services = [
            Answering("clear", Empty, self._clear),
            Answering("reset", Empty, self._reset),
            Answering("spawn", Spawn, self._spawn),
            Answering("kill", Kill, self._kill),
        ]

    def run(self) -> None:
        """Move the world every 16 ms until the node is shut down."""
        due = time.monotonic()
        while not rospy.is_shutdown():
            due = max(due + TICK, time.monotonic() - LATEST)
            while (rest := due - time.monotonic()) > 0:
                time.sleep(rest)
            self._do_jobs()
            for warning in self._world.tick(time.monotonic()):
                rospy.logwarn(warning)
            for actor in self._actors.values():
                actor.publish()

    def in_tick(self, job: Callable[[], Result]) -> Result:
        """Have `job` done between two ticks, and return what it returns."""
        return self._in_next_tick(job).result()

    def _in_next_tick(self, job: Callable[[], Result]) -> Future[Result]:
        done: Future[Result] = Future()
        self._jobs.put((job, done))
        return done

    def _do_jobs(self) -> None:
        until = time.monotonic() + BUDGET
        while time.monotonic() < until:
            try:
                job, done = self._jobs.get_nowait()
            except NothingToDo:
                return
            try:
                done.set_result(job())
            except Exception as error:  # noqa: BLE001 -- it belongs to the client that waits for it
                done.set_exception(error)

    def _spawn(self, request: Any) -> SpawnResponse:  # noqa: ANN401 -- a class that catkin generates
        if request.name and (words := objection(request.name)):
            raise Refused(words)
        if not sound(request.x, request.y, request.theta):
            raise Refused("A turtle cannot be where a number is not finite.")
        place = (request.x, request.y, request.theta)
        with self._changes:
            try:
                turtle = self._world.make(*place, request.name)
            except NameTaken as error:
                rospy.logerr(str(error))
                raise Refused("") from error
            added = self._in_next_tick(lambda: self._world.add(turtle))
            actor = Actor(turtle, self._world.paper, self.in_tick)  # six questions, while the tick comes
            added.result()
            self._announce(turtle)
            self._enter(actor)
        return SpawnResponse(turtle.name)

    def _kill(self, request: Any) -> KillResponse:  # noqa: ANN401
        with self._changes:
            try:
                actor = self.in_tick(lambda: self._take_out(request.name))
            except UnknownTurtle as error:
                rospy.logerr(str(error))
                raise Refused("") from error
            actor.close()
        return KillResponse()

    def _clear(self, _request: Any) -> EmptyResponse:  # noqa: ANN401
        rospy.loginfo("Clearing turtlesim.")
        background = self._background()
        self.in_tick(lambda: self._world.clear(background))
        return EmptyResponse()

    def _reset(self, _request: Any) -> EmptyResponse:  # noqa: ANN401
        rospy.loginfo("Resetting turtlesim.")
        background = self._background()
        with self._changes:
            leaving = self._sent_off()
            begun = self._in_next_tick(lambda: self._begin_anew(background))
            for actor in leaving:  # while the tick comes: each is six questions to the master
                actor.close()
            begun.result()
            turtle = self._world.turtles[FIRST]
            self._announce(turtle)
            if turtle.name not in self._actors:  # it had been killed
                self._enter(Actor(turtle, self._world.paper, self.in_tick))
        return EmptyResponse()

    def _take_out(self, name: str) -> Actor:
        actor = self._actors[self._world.kill(name).name]
        self._actors = {name: other for name, other in self._actors.items() if other is not actor}
        return actor

    def _sent_off(self) -> list[Actor]:
        """Take all actors off the stage but the first turtle's, whose listeners go on listening."""
        leaving = [actor for name, actor in self._actors.items() if name != FIRST]
        self._actors = {name: actor for name, actor in self._actors.items() if name == FIRST}
        return leaving

    def _begin_anew(self, background: Colour) -> None:
        """Reset the world."""
        self._world.reset(background)
        for name, actor in self._actors.items():
            actor.turtle = self._world.turtles[name]

    def _enter(self, actor: Actor) -> None:
        self._actors = dict(sorted({**self._actors, actor.turtle.name: actor}.items()))

    def _announce(self, turtle: Turtle) -> None:
        place = f"x=[{turtle.x:f}], y=[{turtle.y:f}], theta=[{turtle.theta:f}]"
        rospy.loginfo(f"Spawning turtle [{turtle.name}] at {place}")

    def _background(self) -> Colour:
        """Return the colour that the parameters name; what is no number counts as the usual one."""
        own = rospy.get_param(rospy.get_name(), {})  # all at once: each question is a round trip
        given = {**DEFAULTS, **own} if isinstance(own, dict) else DEFAULTS
        red, green, blue = (
            given[name] % 256 if isinstance(given[name], int) else usual for name, usual in DEFAULTS.items()
        )
        return red, green, blue
