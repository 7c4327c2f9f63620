"""11.4: a server that answers several callers side by side, and still counts right."""

from __future__ import annotations

import itertools
import re

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_11.programs import PACKAGE, code_of, compiled, serves, started

FILE = f"{PACKAGE}/src/number_server.cpp"
CALLERS = 6
THINKING, COUNTING = 0.4, 0.05  # s, as the file that is handed out has them
APART = 0.15  # s between two answers: less while all think at once, and more where one began to think later
TRIES = 5  # a server that takes one after the other is never quick; on a busy machine a good one may be slow

START = f"""%%writefile {FILE}
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;

// Takes its time, and touches nothing that others need.
void think() {{
  ros::WallDuration({THINKING}).sleep();
}}

// Reads, takes a moment, and writes.
int count() {{
  int seen = served;
  ros::WallDuration({COUNTING}).sleep();
  served = seen + 1;
  return served;
}}

bool handle(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {{
  think();
  response.message = std::to_string(count());
  response.success = true;
  return true;
}}

int main(int argc, char** argv) {{
  ros::init(argc, argv, "number_server");
  ros::NodeHandle node;
  ros::ServiceServer server = node.advertiseService("number", handle);
  ros::spin();
}}
"""
ONE_THREAD = (
    "ros::spin() hands out one callback after the other. An AsyncSpinner or a MultiThreadedSpinner has "
    "more threads."
)
TOO_FEW = (
    "All callers are to be served at once, and each takes a thread: write how many. (0 means as many as "
    "there are cores.)"
)
LOCKED_TOO_LONG = (
    "Whoever holds the lock while it thinks lets all others wait. Lock where `served` is read and written, "
    "and nowhere else."
)
NOT_STARTED = "An AsyncSpinner does nothing before its start()."
NOT_ATOMIC = (
    "Each access is safe, and the three lines are not: two threads read the same number, and both add 1 "
    "to it. Hold a mutex from the reading to the writing."
)
NO_LOCK = (
    "Two threads read the same number, and both add 1 to it. Hold a mutex from the reading to the writing: "
    "std::lock_guard<std::mutex> lock(mutex);"
)
LET_GO = (
    "There is a lock, and nobody holds it between the reading and the writing: two threads read the same "
    "number. Take it before the first of the three lines, and give the lock a name, or it is gone at once: "
    "std::lock_guard<std::mutex> lock(counting);"
)
OWN_LOCK = "Each call makes a mutex of its own, which nobody else holds. One for all: outside, or static."


@part(
    "11.4",
    points=3,
    goal="Change number_server.cpp so that six callers are served side by side, and counted right.",
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
)
def the_spinner(exam: Exam) -> None:
    """Call alone, and then six times at once: how long it takes, and which numbers come."""
    code = code_of(exam, FILE)
    _still_thinks(exam, code, THINKING + COUNTING)
    folder = compiled(exam, FILE)
    name = f"/{exam.draw.word()}"
    with started(exam, folder, "number", name) as running:
        serves(exam, running, "number", name, code)
        quiet = NOT_STARTED if "Spinner" in code else "Nothing hands out what arrives: ros::spin() is gone."
        number = exam.service(name, "std_srvs/Trigger", hints=[(says("TimesUp"), quiet)], timeout=6.0)
        alone = _number(number().message)
        _still_thinks(exam, code, number.took)
        exam.expect(
            "the first caller gets number 1",
            expected=1,
            seen=alone,
            hints={-1: "The message is the number and nothing else, as it was: std::to_string(count())."},
        )
        _side_by_side(exam, number, code)


def _still_thinks(exam: Exam, code: str, took: float) -> None:
    """Look at the code, and at how long one call `took`, in s; a busy machine only takes longer."""
    exam.hold(
        "it still takes its time",
        len(re.findall(r"\bsleep\(\)", code)) >= 2
        and "think()" in code
        and took > 0.98 * (THINKING + COUNTING),
        expected=f"think() as it was, with its {THINKING:g} s, and count() with its {COUNTING:g} s",
        seen="a server that has nothing to do"
        if took >= THINKING + COUNTING
        else f"{took:.2f} s for a caller",
        hints="Leave think() and count() as slow as they are: they stand for work. Only the callers overlap.",
    )


def _side_by_side(exam: Exam, number: Service, code: str) -> None:
    """Hold that six at once get six numbers, and that in one try they all think at the same time.

    Whoever has to wait for a thread begins to think when the first is done, and is later than the others
    by all of it.
    """
    first, took, apart = 2, [], []
    for _ in range(TRIES):
        replies = number.at_once([{}] * CALLERS)
        numbers = sorted(_number(reply.response.message) for reply in replies)
        exam.expect(
            "callers at the same time get different numbers, and none is left out",
            expected=list(range(first, first + CALLERS)),
            seen=numbers,
            hints=_why_lost(code),
        )
        first += CALLERS
        ends = sorted(reply.took for reply in replies)
        took.append(ends[-1])
        apart.append(max(after - before for before, after in itertools.pairwise(ends)))
        if apart[-1] < APART:
            break
    exam.hold(
        "six callers wait little longer than one",
        min(apart) < APART,
        expected=f"six answers after some {THINKING + CALLERS * COUNTING:.1f} s",
        seen=f"the last of them after {min(took):.1f} s",
        hints=_why_slow(code),
    )


def _number(message: str) -> int:
    """Return the number in a response; -1 where it is none."""
    return int(message) if message.isdecimal() else -1


def _why_lost(code: str) -> str:
    if "atomic" in code:
        return NOT_ATOMIC
    if not re.search(r"lock_guard|unique_lock|scoped_lock|\.lock\(\)", code):
        return NO_LOCK
    return OWN_LOCK if re.search(r"\{[^}]*(?<!static )\b(std|boost)::\w*mutex\s+\w+\s*;", code) else LET_GO


def _why_slow(code: str) -> str:
    if "Spinner" not in code:
        return ONE_THREAD
    few = re.search(r"Spinner\s+\w+\s*[({]\s*[0-5]?\s*[)}]|Spinner\s+\w+\s*;", code)
    return TOO_FEW if few else LOCKED_TOO_LONG
