"""13.3: a C++ client that limits its waiting time and the number of its calls."""

from __future__ import annotations

import itertools
import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from threading import Timer

from course_pkg.chapters.ch13_cpp.checks.compiled_program import BOX, PACKAGE, compiled
from course_pkg.checking import CheckContext, Refuse, part
from course_pkg.checking.commands.folder import Folder, Running
from course_pkg.checking.peers.scripted_server import Act, ScriptedServer
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.roscpp_program import require_no_other_program
from course_pkg.waiting import at_this_load, wait_until

FILE = f"{PACKAGE}/src/patient_client.cpp"
WAIT = 2.0  # WAIT is the time in s for which the client waits for the service.
TRIES = 3  # The client makes at most this many calls.
# Without a server, the client may wait for this additional time in s in the shortest of `ATTEMPTS` runs.
SLACK, ATTEMPTS = 0.5, 3
PAUSE = 0.05  # PAUSE is the minimum time in s between two calls.
TOLERANCE = 0.005  # TOLERANCE is the time in s by which the measured time can be too short.
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
POLL = 0.03  # POLL is the time in s between two examinations of the client.
LIMIT = 5.0  # LIMIT is the time in s after which the check stops the program.

MILLISECONDS = (
    "The program waited only a few milliseconds, because waitForService reads a plain number as "
    "milliseconds. Write ros::Duration(2) for 2 seconds."
)
START = f"""%%writefile {FILE}
#include <course_pkg/geometry.h>
#include <ros/ros.h>

int main(int argc, char** argv) {{
  ros::init(argc, argv, "patient_client", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<course_pkg::geometry>("box");
  course_pkg::geometry box;
  box.request.length = std::stof(argv[1]);
  box.request.width = std::stof(argv[2]);
  box.request.height = std::stof(argv[3]);
  client.call(box);
  std::cout << box.response.volume << std::endl;
  return 0;
}}
"""
REPEATS = (
    "After a refused call, pause and call the service again. End with exit status 1 after the third "
    "refused call."
)


@dataclass
class Client:
    """The student's client. During each call, the check examines the files that the client executes."""

    context: CheckContext
    folder: Folder
    running: Running | None = None

    def serve(self, name: str, act: Callable[[], Act]) -> ScriptedServer:
        """Offer the service `name` until the check ends; the function `act` returns the action for a call."""

        def answer(_: object) -> Act:
            if self.running:
                self.running.examine()
            return act()

        return self.context.serve(name, BOX, answer)

    def run(self, name: str, sides: list[float]) -> Finished:
        """Run the client for at most `LIMIT` s, and discard stderr; the client must not start a program."""
        words = [str(side) for side in sides]
        quiet = ["sh", "-c", 'exec "$0" "$@" 2> /dev/null', "./program", *words, f"/box:={name}"]
        with self.folder.start(*quiet, worded=f"patient_client {' '.join(words)}") as running:
            self.running = running
            wait_until(lambda: running.status is not None, at_this_load(LIMIT), POLL)
            done = running.stop()
        if running.other:
            require_no_other_program(self.context, running)
        return done


@part(
    "13.3",
    points=3,
    goal=(
        "Change patient_client.cpp: wait at most 2 s for the service, and call it at most 3 times. "
        "Print the volume, or end with exit status 1."
    ),
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
    goals=[REPEATS, "Wait at most 2 s for the service."],
)
def patient_client(context: CheckContext) -> None:
    """Run the client with servers that respond, refuse twice, always refuse or start late.

    Run the client also without a server.
    """
    client = Client(context, compiled(context, FILE))
    shapes = _prints_the_answer(context, client)
    calls = _asks_again(context, client)
    _prints_more_answers(context, client)
    calls_in_vain = _gives_up_after_refusals(context, client, shapes)
    _pauses_between_calls(context, calls, calls_in_vain)
    context.fulfilled(REPEATS)
    _waits_for_a_late_server(context, client)
    _gives_up_without_a_server(context, client, shapes)


def _prints_the_answer(context: CheckContext, client: Client) -> set[str]:
    """Run the client; return the printed lines that contain the volume, with # in place of each number."""
    name, sides, volume = _random_box(context)
    server = client.serve(name, lambda: {"volume": volume})
    finished = client.run(name, sides)
    _prints(context, finished, volume, "if the server responds, the program prints the volume")
    given = [round(float(value), 2) for value in list(server.requests[0].values())]
    context.expect(
        "the program sends length, width and height without a change", expected=sides, actual=given, near=0.02
    )
    context.expect(
        "after a response, the program does not call again",
        expected=1,
        actual=len(server.requests),
        hints=(
            "The server sent a response, but the program called the server again. Leave the loop "
            "when call() returns true."
        ),
    )
    shapes = {NUMBER.sub("#", line) for line in _lines(finished.out) if volume in _numbers(line)}
    _prints_a_volume_of_0(context, client)
    _prints_more_answers(context, client)
    return shapes


def _prints_a_volume_of_0(context: CheckContext, client: Client) -> None:
    """Respond with the volume 0.

    The volume 0 does not show whether there was a response, so the program has to use the return value of
    call().
    """
    name, sides, _ = _random_box(context)
    client.serve(name, lambda: {"volume": 0.0})
    _prints(
        context,
        client.run(name, sides),
        0.0,
        "if the server responds, the program prints the volume",
        "A response with the volume 0 is valid. Test the return value of call(), not the volume.",
    )


def _prints_more_answers(context: CheckContext, client: Client) -> None:
    """Run the client a random number of times.

    A client that counts its runs therefore cannot predict the next situation.
    """
    for _ in range(context.random.integer(0, 2)):
        name, sides, volume = _random_box(context)
        client.serve(name, partial(dict, volume=volume))
        _prints(
            context,
            client.run(name, sides),
            volume,
            "if the server responds, the program prints the volume",
        )


def _asks_again(context: CheckContext, client: Client) -> list[float]:
    name, sides, volume = _random_box(context)
    server, calls = _refusing(client, name, TRIES - 1, volume)
    finished = client.run(name, sides)
    assertion = "if the server refuses two calls, the program makes a third call and prints the volume"
    if not _numbers(finished.out) or finished.status != 0 or len(server.requests) != TRIES:
        count = len(server.requests)
        context.fail(
            assertion,
            expected=f"the output {volume:g} after {TRIES} calls",
            actual=_outcome(finished, count),
            hint=_why_not_third(finished, count),
        )
    _prints(context, finished, volume, assertion)
    return calls


def _pauses_between_calls(context: CheckContext, *runs: list[float]) -> None:
    """Assert that there was a pause after each refusal."""
    shortest = min(after - before for calls in runs for before, after in itertools.pairwise(calls))
    if shortest < PAUSE - TOLERANCE:
        context.fail(
            "the program pauses between two calls",
            expected=f"a pause of at least {1000 * PAUSE:.0f} ms after each refusal",
            actual=f"the next call after {1000 * shortest:.1f} ms",
            hint=(
                "The pause after a refused call is missing or too short, so the server probably refuses the "
                "next call, too. Write ros::WallDuration(0.2).sleep() between two calls."
            ),
        )


def _why_not_third(finished: Finished, count: int) -> str:
    if count == 1 and finished.status == 0:
        if any(_numbers(finished.out)):
            return (
                "The server refused the call, but the program printed a volume that the server did not send. "
                "Do not calculate the volume: call the server again."
            )
        return (
            "call() returned false, but the program printed an empty response. Test the return "
            "value of call() before you print the volume."
        )
    return (
        "The server refused the first two calls, but it responds to the third call. While call() "
        "returns false, repeat the call, with at most three calls in total."
    )


def _gives_up_after_refusals(context: CheckContext, client: Client, shapes: set[str]) -> list[float]:
    name, sides, _ = _random_box(context)
    server, calls = _refusing(client, name, 1000, 0.0)
    finished = client.run(name, sides)
    assertion = (
        "if the server refuses every call, the program makes three calls, prints no volume, and ends "
        "with exit status 1"
    )
    good = finished.status == 1 and not _volumes(finished.out, shapes) and len(server.requests) == TRIES
    count = len(server.requests)
    context.require(
        assertion,
        holds=good,
        expected=f"exit status 1 and no number, after {TRIES} calls",
        actual=_outcome(finished, count),
        hints=_why_not_one(finished, count),
    )
    return calls


def _why_not_one(finished: Finished, count: int) -> str:
    if finished.status is None:
        return (
            "The program calls the service again and again. Count the calls, and stop after the third call."
        )
    if count != TRIES:
        return f"The program made {count} calls, but it has to make 3. Also count the first call."
    if finished.status == 0:
        return "No call got a response, but the exit status is wrong. In this case, return 1 from main."
    return (
        "The program printed a volume, although it got no response. Return 1 before the line that "
        "prints the volume."
    )


def _waits_for_a_late_server(context: CheckContext, client: Client) -> None:
    name, sides, volume = _random_box(context)
    timer = Timer(1.0, client.serve, [name, lambda: {"volume": volume}])
    timer.start()
    finished = client.run(name, sides)
    timer.join()
    _prints(
        context,
        finished,
        volume,
        "if the server starts after 1 s, the program calls the service",
        MILLISECONDS
        if re.search(r"waitForService\([^;]*,\s*\d{1,3}\s*\)", context.source(f"file:{FILE}"))
        else (
            "The program did not wait for the service. Write "
            "client.waitForExistence(ros::Duration(2)) before the first call."
        ),
    )


def _gives_up_without_a_server(context: CheckContext, client: Client, shapes: set[str]) -> None:
    for _ in range(ATTEMPTS):
        finished, waited = _run_without_server(context, client)
        if finished.status is None or waited < WAIT + SLACK:
            break
    context.require(
        "without a server, the program prints no volume, and ends with exit status 1 after 2 s",
        holds=finished.status == 1
        and not _volumes(finished.out, shapes)
        and finished.took > 0.8 * WAIT
        and waited < WAIT + SLACK,
        expected="exit status 1 after about 2 s",
        actual=_outcome(finished, 0),
        hints=(
            "The program waits without a time limit. Write waitForExistence(ros::Duration(2))."
            if finished.status is None
            else (
                f"The program waited {waited:.1f} s, which is too long. Write "
                "waitForExistence(ros::Duration(2))."
            )
            if waited > WAIT + SLACK
            else (
                "When the time is over, waitForExistence returns false. Test its return value, and "
                "return 1 from main if it is false."
            )
        ),
    )


def _run_without_server(context: CheckContext, client: Client) -> tuple[Finished, float]:
    """Run the client without a server; return also the time in s for which the client waited.

    On a busy machine, the start of a program takes long. If the run takes too long, the check therefore runs
    the client again with a server, and subtracts the time of this run.
    """
    name, sides, volume = _random_box(context)
    finished = client.run(name, sides)
    if finished.took < WAIT + SLACK:
        return finished, finished.took
    client.serve(name, lambda: {"volume": volume})
    return finished, finished.took - client.run(name, sides).took


def _random_box(context: CheckContext) -> tuple[str, list[float], float]:
    """Return a random service name, three sides, and a volume that differs from the product of the sides.

    The volume is not a whole number, and a client can print it with the usual six digits.
    """
    sides = [round(side, 2) for side in context.random.numbers(3, 0.5, 9.0)]
    return f"/{context.random.word()}", sides, context.random.integer(1000, 9000) + 0.5


def _refusing(client: Client, name: str, times: int, volume: float) -> tuple[ScriptedServer, list[float]]:
    """Start a server that refuses its first calls; return the server, and a list of call times (s)."""
    calls: list[float] = []

    def act() -> Act:
        calls.append(time.monotonic())
        return Refuse("not now") if len(calls) <= times else {"volume": volume}

    return client.serve(name, act), calls


def _numbers(out: str) -> list[float]:
    """Return the printed numbers, without the numbers in roscpp's log messages."""
    return [float(text) for line in _lines(out) for text in NUMBER.findall(line)]


def _lines(out: str) -> list[str]:
    plain = re.sub(r"\x1b\[[\d;]*m|\[[^\]]*\]", "", out)
    return [line.strip() for line in plain.splitlines() if "waitForService" not in line]


def _volumes(out: str, shapes: set[str]) -> list[str]:
    """Return the output lines that contain a volume.

    A line contains a volume if it is only a number, if it is "volume" and a number, or if it matches a text
    in `shapes`.
    """
    volume = rf"(?i)(.*\bvolume\W*(is|was)?\W*)?{NUMBER.pattern}"
    return [line for line in _lines(out) if re.fullmatch(volume, line) or NUMBER.sub("#", line) in shapes]


def _prints(context: CheckContext, finished: Finished, volume: float, assertion: str, hint: str = "") -> None:
    numbers = _numbers(finished.out)
    context.require(
        assertion,
        holds=finished.status == 0 and volume in numbers,
        expected=f"{volume:g} and exit status 0",
        actual=_outcome(finished),
        hints=hint or _why_not_printed(finished, numbers, volume),
    )


def _why_not_printed(finished: Finished, numbers: list[float], volume: float) -> str:
    if finished.status == 0 and any(each.is_integer() and abs(each - volume) < 1 for each in numbers):
        return (
            "The digits after the decimal point are missing in the printed volume. Print box.response.volume "
            "directly, without an int."
        )
    if finished.status == 0 and numbers:
        return (
            "The printed volume is not the volume that the server sent. Print box.response.volume, and do "
            "not calculate the volume in the client."
        )
    return (
        "The program does not print the volume, or it ends with a wrong exit status. Print "
        "box.response.volume to std::cout, and return 0."
    )


def _outcome(finished: Finished, calls: int = -1) -> str:
    printed = ", ".join(f"{each:g}" for each in _numbers(finished.out)) or "no number"
    ending = "still running" if finished.status is None else f"exit status {finished.status}"
    asked = f" after {calls} calls" if calls > 0 else ""
    return f"{printed}, and {ending}{asked}"
