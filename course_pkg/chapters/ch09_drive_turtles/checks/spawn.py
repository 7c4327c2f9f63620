"""09.1: a client of /spawn that waits for the simulator for a limited time."""

from __future__ import annotations

import time

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
from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.peers.scripted_server import Act, Refuse, Script
from course_pkg.checking.result import Finished
from course_pkg.errors import CheckError
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import at_this_load, wait_until

PROGRAM = script("spawn_turtle")
SPAWN = "turtlesim/Spawn"
TURTLE: dict[str, Json] = {"x": 3.0, "y": 3.0, "theta": 0.0, "name": "MyTurtle"}
LIMIT = 5.0  # LIMIT is the time in s for which the student's program waits for a service.
NO_WAIT = (
    "The program ended before the service started. Wait for the service for at most 5 s (in C++: "
    "ros::Duration(5), because roscpp reads a plain number as milliseconds)."
)
# If a program ends within this time in s, the hint says that the program does not wait for the service.
NO_WAIT_ENDS = 1.0
WITHOUT_A_WAIT = 0.5  # A program that does not wait ends within this time in s.
LATE = 2.5  # LATE is the additional time in s that the program may need to start and to end.
EARLY = 4.0  # If a program ends within this time in s, it has not waited for 5 s.
REFUSED = "if the simulator refuses a second MyTurtle, the exit status is 1"
GIVES_UP = "without /spawn, the program ends after 5 s with exit status 1"

START = f"""%%writefile {PROGRAM.path}
#!/usr/bin/env python3
import rospy
from turtlesim.srv import Spawn

if __name__ == "__main__":
    rospy.init_node("spawn_turtle")
    spawn = rospy.ServiceProxy("spawn", Spawn)
    response = spawn(3, 3, 0, "MyTurtle")
    print("spawned", response.name)
"""
SPAWNED = "Wait for /spawn, spawn the turtle, and print its name."
ENDS = "End with exit status 1 if no turtle was spawned."
SPAWN_GOALS = {SPAWNED: 3, ENDS: 1}


@part(
    "09.1",
    points=2,
    goal=(
        "Change spawn_turtle.py: wait at most 5 s for /spawn, and end with exit status 1 if no turtle "
        "was spawned."
    ),
    needs=[f"file:{PROGRAM.path}"],
    deadline=60.0,
    start=START,
    goals=SPAWN_GOALS,
)
def wait_and_spawn(context: CheckContext) -> None:
    """Run the program with a server, without a server, and with a server that starts later."""
    spawns(context, PROGRAM)


def spawns(context: CheckContext, program: TurtleProgram) -> None:
    """Assert that a program meets the requirements of the exercise about spawn_turtle.

    The runs overlap, because one run takes 5 s.
    """
    copy = program.prepare(context, program)
    alone, early, served, real = (World(context, copy, program) for _ in range(4))
    with real.simulator(), alone.run() as running_alone, early.run() as running_early:
        began = alone.begins(running_alone)
        early_end, waited = _served_late(context, early, running_early)
        _prints_the_name(context, served)
        _waits_for_the_service(context, early_end, waited)
        context.fulfilled(SPAWNED)
        _gives_up(context, alone, running_alone, began)
        _spawns_in_the_simulator(context, real)
        _is_refused(context, served)


def _served_late(context: CheckContext, world: World, running: Running) -> tuple[Finished, float]:
    """Start a server while the program is waiting.

    Return (the result of the program, the time in s for which the program ran).
    """
    began = world.begins(running)
    wait_until(lambda: running.status is not None, at_this_load(WITHOUT_A_WAIT), 0.05)
    world.runs_own_program()
    server = context.serve(world.name("spawn"), SPAWN, _answer(world, {"name": "MyTurtle"}))
    done = world.ends(running, LIMIT)
    server.leave()
    return done, done.ended - began


def _answer(world: World, act: Act) -> Script:
    """Return a script that examines the student's program during each call, and then returns `act`."""

    def answer(_: object) -> Act:
        world.examine()
        return act

    return answer


def _prints_the_name(context: CheckContext, world: World) -> None:
    """Respond with another name than the requested name; assert that the program prints this name."""
    given = context.random.word()
    server = context.serve(world.name("spawn"), SPAWN, _answer(world, {"name": given}))
    with world.run() as running:
        wait_until(lambda: bool(server.requests) or running.status is not None, STARTING, 0.05)
        done = world.ends(running, 3.0)
    requests = server.requests
    server.leave()
    context.require(
        "the program calls /spawn once",
        holds=len(requests) == 1,
        expected="one request",
        actual=f"{len(requests)} requests, and {outcome(done)}",
        hints=(
            "The program called /spawn more than once, and each call creates a turtle. Call /spawn only once."
        )
        if requests
        else _why_no_call(done),
    )
    context.expect(
        "the request contains x = 3, y = 3, theta = 0 and the name MyTurtle",
        expected=TURTLE,
        actual=requests[0],
        near=1e-6,
        hints=[
            (
                (lambda actual: actual["name"] == ""),
                "The name is empty, so the simulator chooses a name. Send the name MyTurtle.",
            ),
            (
                (lambda actual: actual["name"] != "MyTurtle"),
                (
                    "The name of the turtle is wrong. Compare the name in your request with MyTurtle, "
                    "letter by letter."
                ),
            ),
            (
                ANYTHING,
                (
                    "The numbers in the request are wrong. Compare the order of your numbers with the "
                    "order of the fields that `rossrv show turtlesim/Spawn` prints."
                ),
            ),
        ],
    )
    context.require(
        "the program prints the name that the response contains",
        holds=given in done.out + done.err,
        expected=f"spawned {given}",
        actual=outcome(done),
        hints=(
            "The program printed a wrong name. The simulator chooses the name, so print the field "
            "`name` of the response."
        ),
    )
    context.require(
        "after the call, the program ends with exit status 0",
        holds=done.status == 0,
        expected="exit status 0",
        actual=outcome(done),
        hints=(
            "The program does not end after the call. Remove rospy.spin(), because the program has "
            "nothing more to do."
        )
        if done.status is None
        else (
            "The turtle was spawned, so the exit status has to be 0. Use exit status 1 only after a failure."
        ),
    )


def _why_no_call(done: Finished) -> str:
    if done.status is None:
        return (
            "The program waits, but sends no request. Check the name of the service for which the "
            "program waits."
        )
    if done.status == 0:
        return (
            "The program ended without a request to /spawn. Call the service after your program has "
            "waited for it."
        )
    return why_it_ended(done)


def _waits_for_the_service(context: CheckContext, done: Finished, waited: float) -> None:
    context.require(
        "if /spawn starts after the program, the program waits for it",
        holds=done.status == 0,
        expected="exit status 0",
        actual=outcome(done),
        hints=_why_it_ended_early(waited),
    )


def _spawns_in_the_simulator(context: CheckContext, world: World) -> None:
    if not world.appears("spawn"):
        raise CheckError(
            "The simulator did not start in time, because the machine is busy. Run this cell again."
        )
    with world.run() as running:
        world.ends(running, STARTING)
    poses = context.subscribe(world.name("MyTurtle/pose"), "turtlesim/Pose").wait(1, 10.0)
    context.require(
        "MyTurtle is in the simulator, at (3, 3)",
        holds=bool(poses) and [poses[0].fields[key] for key in ("x", "y")] == [3.0, 3.0],
        expected="a pose of MyTurtle",
        actual="no pose of MyTurtle at this position",
    )


def _is_refused(context: CheckContext, world: World) -> None:
    refuses = _answer(world, Refuse(context.random.word()))
    server = context.serve(world.name("spawn"), SPAWN, refuses)
    with world.run() as running:
        done = world.ends(running, STARTING)
    server.leave()
    context.require(
        REFUSED,
        holds=len(server.requests) <= 1,
        expected="one request",
        actual=f"{len(server.requests)} requests",
        hints=(
            "The server refused the call, and the program called the service again. Call /spawn "
            "only once, and end the program after a failure."
        ),
    )
    _fails_with_one(
        context,
        done,
        REFUSED,
        (
            "The server refused the call. In this case, print a message, and end with exit status 1. In C++, "
            "test what call() returns."
        ),
    )


def _gives_up(context: CheckContext, world: World, running: Running, began: float) -> None:
    done = world.ends(running, max(began + LIMIT + at_this_load(LATE) - time.monotonic(), 0.1))
    took = max(done.ended - began, 0.0)
    context.require(
        GIVES_UP,
        holds=done.status is not None,
        expected="the program ends after 5 s",
        actual="the program still waits after 7 s",
        hints=(
            "The program waits too long for the service, or without a time limit. Set the timeout of "
            "the wait to 5 s."
        ),
    )
    context.require(
        GIVES_UP,
        holds=took >= EARLY,
        expected="the program ends after 5 s",
        actual=f"the program ended after {took:.0f} s",
        hints=_why_it_ended_early(took),
    )
    _fails_with_one(
        context,
        done,
        GIVES_UP,
        ("The service did not start in time. In this case, print a message and end with exit status 1."),
    )


def _why_it_ended_early(waited: float) -> str:
    if waited < NO_WAIT_ENDS:
        return NO_WAIT
    return (
        "The program stopped waiting too early. Set the timeout of the wait to 5 s (in roscpp: "
        "ros::Duration(5))."
    )


def _fails_with_one(context: CheckContext, done: Finished, assertion: str, hint: str) -> None:
    context.require(
        assertion,
        holds=fails_with_one(done),
        expected="a message, and the exit status 1",
        actual=failure(done),
        hints=[
            (
                (lambda _: has_traceback(done) and assertion == REFUSED),
                "The program does not handle the exception of a refused call. For each ServiceException, "
                "print a message, and end with exit status 1.",
            ),
            ((lambda _: done.status == 1 and not own_message(done)), NO_MESSAGE),
            (ANYTHING, hint),
        ],
    )
