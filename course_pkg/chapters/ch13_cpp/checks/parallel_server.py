"""13.4: a C++ server that handles several calls at the same time, and still counts correctly."""

from __future__ import annotations

import itertools
import re
from math import inf

from course_pkg.chapters.ch13_cpp.checks.compiled_program import PACKAGE, code_of, compiled, serves, started
from course_pkg.checking import CheckContext, matches, part
from course_pkg.checking.peers.service_calls import Service
from course_pkg.waiting import at_this_load, wait_until

FILE = f"{PACKAGE}/src/number_server.cpp"
CALLERS = 6
THINKING, COUNTING = 0.4, 0.05  # These times in s are the same as in the file that the exercise provides.
# APART is the maximum time in s between two responses. If a call has to wait for a thread, this time is
# longer.
APART = 0.15
# LATE is the time in s that the fastest call may take in addition to the time of think() and count().
LATE = 0.2
# The check replaces the duration in think() by a random duration, so the handler has to call think().
ORIGINAL = re.compile(r"(void\s+think\(\)\s*\{[^{}]*WallDuration\()0\.4(\)\s*\.sleep\(\)\s*;[^{}]*\})")
# The check repeats six simultaneous calls for up to this time in s, until all calls overlap; on a busy
# machine, a call may start late.
OVERLAPPING = 3.0

START = f"""%%writefile {FILE}
#include <mutex>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int served = 0;

// Takes a long time, and uses no shared data.
void think() {{
  ros::WallDuration({THINKING}).sleep();
}}

// Reads the number, takes a moment, and writes the number.
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
    "ros::spin() executes only one callback at a time. Use an AsyncSpinner or a "
    "MultiThreadedSpinner, because they use several threads."
)
TOO_FEW = (
    "The spinner has too few threads for six calls at the same time. Create the spinner with at "
    "least six threads (the number 0 means one thread for each processor core)."
)
LOCKED_TOO_LONG = (
    "The handler holds the lock during think(), so the other calls have to wait. Hold the lock only "
    "while you read and write `served`."
)
NOT_STARTED = "The AsyncSpinner executes no callbacks, because it was not started. Call its method start()."
NOT_ATOMIC = (
    "Two threads can read the same number before one of them writes the new number, even if the "
    "variable is atomic. Hold a mutex from the read to the write."
)
NO_LOCK = (
    "Two threads read the same number, and both threads add 1 to it. Hold a mutex from the read to "
    "the write: std::lock_guard<std::mutex> lock(mutex);"
)
LET_GO = (
    "The lock is not held between the read and the write, so two threads read the same number. "
    "Before the read, create a lock_guard with a name: a lock_guard without a name releases the lock "
    "immediately."
)
OWN_LOCK = (
    "Each call creates its own mutex, so no call waits for another call. Move the mutex out of the function."
)


@part(
    "13.4",
    points=3,
    goal=("Change number_server.cpp: handle six clients at the same time, and count the clients correctly."),
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
)
def number_server(context: CheckContext) -> None:
    """Make one call, and then six calls at the same time; compare the numbers and the times."""
    code = code_of(context, FILE)
    thinking = context.random.integer(30, 60) / 100
    text, found = ORIGINAL.subn(rf"\g<1>{thinking}\2", context.source(f"file:{FILE}"))
    time = thinking + COUNTING
    _still_thinks(context, code, time, time if found else 0.0)
    folder = compiled(context, FILE, text)
    name = f"/{context.random.word()}"
    with started(context, folder, "number", name) as running:
        serves(context, running, "number", name, code)
        quiet = (
            NOT_STARTED
            if "Spinner" in code
            else "No spinner executes the callbacks. Call ros::spin(), or start an AsyncSpinner."
        )
        number = context.service(name, "std_srvs/Trigger", hints=[(matches("TimesUp"), quiet)], timeout=4.0)
        alone = _number(number().message)
        _still_thinks(context, code, time, number.took)
        context.expect(
            "the first client gets number 1",
            expected=1,
            actual=alone,
            hints=[
                (
                    -1,
                    (
                        "The field `message` has to contain only the number. Return only "
                        "std::to_string(count())."
                    ),
                )
            ],
        )
        _handles_calls_in_parallel(context, number, code, time)


def _still_thinks(context: CheckContext, code: str, time: float, took: float, most: float = inf) -> None:
    """Assert that the handler calls think() and count(), and that their durations are unchanged.

    `time` and `most` are the minimum and the maximum duration of a call in s. A call with the code that the
    exercise provides takes at least the time `time`. `took` is the duration of a call in s, or 0 if the text
    of think() was changed.
    """
    context.require(
        "think() and count() take as long as in the original program",
        holds=len(re.findall(r"\bsleep\(\)", code)) >= 2 and "think()" in code and 0.98 * time < took < most,
        expected=(f"the original think() and count(), which take {time:.2f} s for each client in this check"),
        actual="a server without the pauses of these functions"
        if took == time
        else f"{took:.2f} s for a client",
        hints=(
            "The functions think() and count() simulate long calculations, so do not change the "
            "duration of their sleep. Use several threads, so that the calls run at the same time."
        ),
    )


def _handles_calls_in_parallel(context: CheckContext, number: Service, code: str, time: float) -> None:
    """Assert that six simultaneous calls get six numbers; repeat the calls until all six overlap.

    If a call has to wait for a thread, its response is late by the duration of think().
    """
    numbers_to_come = itertools.count(2)
    took: list[float] = []
    gaps: list[float] = []
    first = [number.took]

    def overlap() -> bool:
        replies = number.at_once([{}] * CALLERS)
        numbers = sorted(_number(reply.response.message) for reply in replies)
        context.expect(
            "clients that call at the same time get different numbers without gaps",
            expected=list(itertools.islice(numbers_to_come, CALLERS)),
            actual=numbers,
            hints=_why_lost(code),
        )
        ends = sorted(reply.took for reply in replies)
        _still_thinks(context, code, time, ends[0])
        first.append(ends[0])
        took.append(ends[-1])
        gaps.append(max(after - before for before, after in itertools.pairwise(ends)))
        return gaps[-1] < APART

    wait_until(overlap, OVERLAPPING)
    _still_thinks(context, code, time, min(first), time + at_this_load(LATE))
    context.require(
        "six clients wait only slightly longer than one client",
        holds=min(gaps) < APART,
        expected=f"six responses after about {time + (CALLERS - 1) * COUNTING:.1f} s",
        actual=f"the last response after {min(took):.1f} s",
        hints=_why_slow(code),
    )


def _number(message: str) -> int:
    """Return the number in a response, or -1 if the message is not a plain number; "01" is also wrong."""
    return int(message) if re.fullmatch(r"0|[1-9]\d*", message) else -1


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
