"""11.3: a client that waits, but not for ever, and asks again, but not for ever."""

from __future__ import annotations

import itertools
import re
import time
from threading import Timer

from course_pkg.examiner import Exam, Refuse, part
from course_pkg.examiner.checks.chapter_11.programs import BOX, PACKAGE, compiled
from course_pkg.examiner.folder import Folder
from course_pkg.examiner.outcome import Finished
from course_pkg.examiner.scripted import ScriptedServer

FILE = f"{PACKAGE}/src/patient_client.cpp"
WAITING = 2.0  # s that the client waits for a service
ASKING = 3  # times
TOO_LONG = 2.0  # s beyond that: no longer a busy machine
PAUSE = 0.01  # s between two calls; without a pause they follow within two thousandths
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
ENDLESS = 8.0  # s after which a program that should have ended is broken off

MILLISECONDS = (
    "It did not wait, or not for long: a plain number in ros::service::waitForService means milliseconds. "
    "ros::Duration(2) means seconds."
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


@part(
    "11.3",
    points=3,
    goal="Change patient_client.cpp: wait at most 2 s, ask at most 3 times, print the volume or end with 1.",
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
)
def the_client(exam: Exam) -> None:
    """Offer a server that answers, one that refuses twice, one that always does, a late one, and none."""
    folder = compiled(exam, FILE)
    shapes = _answered_at_once(exam, folder)
    calls = _refused(exam, folder)
    _pauses(exam, calls, _refused_always(exam, folder, shapes))
    _late(exam, folder)
    _nobody(exam, folder, shapes)


def _answered_at_once(exam: Exam, folder: Folder) -> set[str]:
    """Return how the lines look that tell the volume, with # for each number."""
    name, sides, volume = _drawn(exam)
    server = exam.serve(name, BOX, lambda _: {"volume": volume})
    done = _run(folder, name, sides)
    _prints(exam, done, volume, "a server that answers: the volume is printed")
    given = [round(float(value), 2) for value in list(server.requests[0].values())]
    exam.expect("length, width and height are sent as they were given", expected=sides, seen=given, near=0.02)
    exam.expect(
        "after an answer it does not ask again",
        expected=1,
        seen=len(server.requests),
        hints="The server answered, and was asked again: leave the loop as soon as call returns true.",
    )
    return {NUMBER.sub("#", line) for line in _lines(done.out) if volume in _numbers(line)}


def _refused(exam: Exam, folder: Folder) -> list[float]:
    name, sides, volume = _drawn(exam)
    server, calls = _refusing(exam, name, ASKING - 1, volume)
    done = _run(folder, name, sides)
    rule = "refused twice: the third answer counts"
    if not _numbers(done.out) or done.status != 0 or len(server.requests) != ASKING:
        count = len(server.requests)
        exam.fail(
            rule,
            expected=f"{volume:g}, after {ASKING} calls",
            seen=_seen(done, count),
            hint=_why_not_third(done, count),
        )
    _prints(exam, done, volume, rule)
    return calls


def _pauses(exam: Exam, *runs: list[float]) -> None:
    """Hold that no call followed at once on a refusal."""
    shortest = min(after - before for calls in runs for before, after in itertools.pairwise(calls))
    if shortest < PAUSE:
        exam.fail(
            "between two calls it pauses",
            expected="a short pause after each refusal",
            seen=f"the next call after {1000 * shortest:.1f} ms",
            hint="Who was refused now is refused a millisecond later, too. ros::WallDuration(0.2).sleep().",
        )


def _why_not_third(done: Finished, count: int) -> str:
    if count == 1 and done.status == 0:
        return "call returned false, and the 0 of an empty response was printed. Look at what call returns."
    if count < ASKING:
        return "It gave up too early. Ask again as long as call returns false, three times in all."
    return "The third call was answered. Print its volume, and end with 0."


def _refused_always(exam: Exam, folder: Folder, shapes: set[str]) -> list[float]:
    name, sides, _ = _drawn(exam)
    server, calls = _refusing(exam, name, 1000, 0.0)
    done = _run(folder, name, sides)
    rule = "always refused: after three calls it gives up, prints no volume, and ends with 1"
    good = done.status == 1 and not _told(done.out, shapes) and len(server.requests) == ASKING
    count = len(server.requests)
    exam.hold(
        rule,
        good,
        expected=f"exit status 1 and no number, after {ASKING} calls",
        seen=_seen(done, count),
        hints=_why_not_one(done, count),
    )
    return calls


def _why_not_one(done: Finished, count: int) -> str:
    if done.status is None:
        return "It asks for ever. Count the calls, and stop after the third."
    if count != ASKING:
        return f"It asked {count} times. The first call is one of the three."
    if done.status == 0:
        return "No call was answered. Return 1 then, so that a script can tell, and print no volume."
    return (
        "A number that nobody gave must not be printed: leave by return 1 before it."
        if done.status == 1
        else ""
    )


def _late(exam: Exam, folder: Folder) -> None:
    name, sides, volume = _drawn(exam)
    timer = Timer(1.0, exam.serve, [name, BOX, lambda _: {"volume": volume}])
    timer.start()
    done = _run(folder, name, sides)
    timer.join()
    _prints(
        exam,
        done,
        volume,
        "a server that comes after 1 s is waited for",
        MILLISECONDS
        if re.search(r"waitForService\([^;]*,\s*\d{1,3}\s*\)", exam.source(f"file:{FILE}"))
        else "It did not wait. client.waitForExistence(ros::Duration(2)) stands before the first call.",
    )


def _nobody(exam: Exam, folder: Folder, shapes: set[str]) -> None:
    name, sides, _ = _drawn(exam)
    done = _run(folder, name, sides)
    if done.status is not None and done.took > WAITING + TOO_LONG:  # perhaps the machine was busy: once more
        done = _run(folder, name, sides)
    exam.hold(
        "a server that never comes: after 2 s it ends with 1, and prints no volume",
        done.status == 1 and not _told(done.out, shapes) and 0.8 * WAITING < done.took < WAITING + TOO_LONG,
        expected="exit status 1 after some 2 s",
        seen=_seen(done, 0),
        hints=(
            "It waits for ever. Give the waiting a limit: waitForExistence(ros::Duration(2))."
            if done.status is None
            else f"It waited too long, {done.took:.1f} s in all: waitForExistence(ros::Duration(2))."
            if done.took > WAITING + TOO_LONG
            else "waitForExistence returns false when the time is up. Return 1 then."
        ),
    )


def _drawn(exam: Exam) -> tuple[str, list[float], float]:
    """Return a name, three sides and a volume that is not their product."""
    sides = [round(side, 2) for side in exam.draw.numbers(3, 0.5, 9.0)]
    return f"/{exam.draw.word()}", sides, float(exam.draw.integer(1000, 9000))


def _refusing(exam: Exam, name: str, times: int, volume: float) -> tuple[ScriptedServer, list[float]]:
    """Serve with so many refusals first; return the server, and when it was called, in s."""
    calls: list[float] = []

    def act(_: object) -> Refuse | dict[str, float]:
        calls.append(time.monotonic())
        return Refuse("not now") if len(calls) <= times else {"volume": volume}

    return exam.serve(name, BOX, act), calls


def _run(folder: Folder, name: str, sides: list[float]) -> Finished:
    words = [str(side) for side in sides]
    line = f"patient_client {' '.join(words)}"
    return folder.command("./program", *words, f"/box:={name}", within=ENDLESS, worded=line)


def _numbers(out: str) -> list[float]:
    """Return the numbers that were printed; roscpp's own lines have brackets and words."""
    return [float(text) for line in _lines(out) for text in NUMBER.findall(line)]


def _lines(out: str) -> list[str]:
    plain = re.sub(r"\x1b\[[\d;]*m|\[[^\]]*\]", "", out)
    return [line.strip() for line in plain.splitlines() if "waitForService" not in line]


def _told(out: str, shapes: set[str]) -> list[str]:
    """Return the lines that tell a volume: a number alone, one behind that word, or as the answer was told.

    The number of a try, or of the seconds, is none.
    """
    volume = rf"(?i)(.*\bvolume\W*(is|was)?\W*)?{NUMBER.pattern}"
    return [line for line in _lines(out) if re.fullmatch(volume, line) or NUMBER.sub("#", line) in shapes]


def _prints(exam: Exam, done: Finished, volume: float, rule: str, hint: str = "") -> None:
    numbers = _numbers(done.out)
    exam.hold(
        rule,
        done.status == 0 and volume in numbers,
        expected=f"{volume:g} and exit status 0",
        seen=_seen(done),
        hints=hint or _why_not_printed(done, numbers),
    )


def _why_not_printed(done: Finished, numbers: list[float]) -> str:
    if done.status is None:
        return "It does not end. After the answer, print it and return 0."
    if done.status == 0 and not numbers:
        return "Print box.response.volume to std::cout."
    if done.status == 0:
        return "That is not what the server answered: print box.response.volume, and compute nothing."
    return "The server answered. Return 0 then."


def _seen(done: Finished, calls: int = -1) -> str:
    printed = ", ".join(f"{each:g}" for each in _numbers(done.out)) or "no number"
    ending = "no end" if done.status is None else f"exit status {done.status}"
    asked = f" after {calls} calls" if calls > 0 else ""
    return f"{printed}, and {ending}{asked}"
