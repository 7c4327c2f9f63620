"""14.7 and 14.8: a handler that calls a service of its own node, and two ways to prevent a deadlock."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from queue import Queue
from threading import Thread

import rospy

from course_pkg.chapters.ch09_drive_turtles.checks.turtle_program import TurtleProgram
from course_pkg.chapters.ch09_drive_turtles.checks.turtle_world import REACHED_ITS_END, World
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.battery_relay import BatteryGate, BatteryRelay
from course_pkg.chapters.ch14_drive_turtles_in_cpp.checks.cpp_program import cpp
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.peers.scripted_server import Refuse
from course_pkg.checking.peers.service_calls import Reply, Service, response_of
from course_pkg.checking.plain_values import Value
from course_pkg.waiting import at_this_load, wait_until

THREADS = cpp("report_threads")
QUEUE = cpp("report_queue")
TRIGGER = "std_srvs/Trigger"
SERVICES = ("battery", "report")
GROUPS = 30  # The check makes this number of groups of simultaneous calls.
CROWD = 24  # This number of clients calls /report while the check holds the calls of /battery.
QUIET = 0.2  # If no further call of /battery arrives within this time in s, all threads are in use.
SOON = 1.0  # A service with its own queue responds within this time in s.
FAILED = 2  # The check accepts failed calls in at most this number of groups.
FEW, MANY = 3, 8  # FEW and MANY are the numbers of simultaneous clients in the two checks.
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
HANGS = "The handler of /report waits for /battery, but no other thread executed the handler of /battery. "
TOO_FEW = (
    "One call works, but three calls at the same time do not end. Each call of /report uses one thread "
    f"until the call ends, and /battery needs one more. Use at least {FEW + 1} threads."
)
FEW_THREADS = f"{HANGS}Use a spinner with at least {FEW + 1} threads."
ONE_THREAD = (
    f"{HANGS}Handle the second queue in a separate thread, such as ros::AsyncSpinner spinner(1, &queue)."
)
QUEUE_TOO_LATE = (
    "The service /battery still uses the global queue, because its NodeHandle got the second queue after it "
    "had created the service. Call setCallbackQueue before advertiseService."
)
SHARED_QUEUE = (
    "While all calls of /report wait, no thread executes the handler of /battery, so /battery is in the "
    "global queue. Create this service with a NodeHandle that has the second queue."
)
NOT_USED = (
    "The program creates a spinner, but main() does not use it: ros::spin() without an argument handles all "
    "calls in one thread. Call spin() of the MultiThreadedSpinner, or start() of the AsyncSpinner."
)
NOT_SPUN = (
    "No thread executes the handler of /battery. Start a spinner for the queue that contains the calls of "
    "/battery."
)

START = """%%writefile {path}
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

int level = 80;
ros::ServiceClient battery;

bool handleBattery(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {{
  response.success = true;
  response.message = std::to_string(level);
  return true;
}}

bool handleReport(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {{
  std_srvs::Trigger inner;
  if (!battery.call(inner)) {{
    return false;
  }}
  response.success = true;
  response.message = "battery: " + inner.response.message;
  return true;
}}

int main(int argc, char** argv) {{
  ros::init(argc, argv, "report");
  ros::NodeHandle node;
  ros::param::param("~level", level, 80);
  battery = node.serviceClient<std_srvs::Trigger>("battery");
  ros::ServiceServer first = node.advertiseService("battery", handleBattery);
  ros::ServiceServer second = node.advertiseService("report", handleReport);
  ros::spin();
}}
"""


@part(
    "14.7",
    points=2,
    goal=(
        "Change main of report_threads.cpp: use a spinner with enough threads for 3 clients that "
        "call /report at the same time."
    ),
    needs=[f"file:{THREADS.path}"],
    deadline=150.0,
    start=START.format(path=THREADS.path),
)
def more_threads(context: CheckContext) -> None:
    """Call /report once, and then three times at the same time."""
    _uses(
        context,
        THREADS,
        r"(MultiThreaded|Async)Spinner\b(?!\s+\w+\s*[({]\s*1\s*,)",
        "the program has a spinner with several threads",
        (
            "The program uses a spinner with only one thread. Use a MultiThreadedSpinner or an "
            "AsyncSpinner instead of ros::spin()."
        ),
    )
    code = _code(context, THREADS)
    # A program can still exist for some time after the end of main, but then no thread handles its calls.
    ends = not re.search(r"waitForShutdown|\bspin\s*\(|\b(while|for)\b", code.partition("int main")[2])
    _reports(
        context,
        THREADS,
        FEW,
        REACHED_ITS_END if ends else TOO_FEW,
        held=True,
        hangs=REACHED_ITS_END if ends else FEW_THREADS if _uses_its_spinner(code) else NOT_USED,
    )


@part(
    "14.8",
    points=3,
    goal=(
        "Change main of report_queue.cpp: give /battery its own callback queue, so that 8 clients "
        "can call /report at the same time."
    ),
    needs=[f"file:{QUEUE.path}"],
    deadline=150.0,
    start=START.format(path=QUEUE.path),
)
def own_queue(context: CheckContext) -> None:
    """Call /report once, and then eight times at the same time."""
    _uses(
        context,
        QUEUE,
        r"CallbackQueue\s+\w+",
        "the program creates a second callback queue",
        (
            "The program uses only one callback queue. Create a ros::CallbackQueue, and pass it to "
            "setCallbackQueue of a second NodeHandle."
        ),
    )
    context.require(
        "the program creates a second callback queue",
        holds=not _leaves_battery_in_the_global_queue(_code(context, QUEUE)),
        expected="the service /battery uses the second queue",
        actual="the service /battery uses the global queue",
        hints=(
            "The program creates a second callback queue, but /battery does not use it. Create the service "
            "/battery with the NodeHandle that has the second queue."
        ),
    )
    _reports(
        context,
        QUEUE,
        MANY,
        (
            "One call works, but eight calls at the same time do not end. Put only /battery into the "
            "new queue, and handle this queue in a separate thread."
        ),
        hangs=QUEUE_TOO_LATE if _sets_the_queue_too_late(_code(context, QUEUE)) else ONE_THREAD,
        separate=True,
    )


def _code(context: CheckContext, program: TurtleProgram) -> str:
    return COMMENT.sub("", context.source(f"file:{program.path}"))


def _uses_its_spinner(code: str) -> bool:
    """Return whether `code` starts one of its spinners, or passes a spinner to a function."""
    names = re.findall(r"\b(?:MultiThreaded|Async)Spinner\s+(\w+)", code)
    return not names or any(
        re.search(rf"\b{name}\s*\.\s*(spin|start)\b|[(,&]\s*{name}\s*[,)]", code) for name in names
    )


def _leaves_battery_in_the_global_queue(code: str) -> bool:
    """Return True only if the service /battery certainly uses the global callback queue.

    For the result True, three conditions must hold for the NodeHandle that creates /battery: it is declared
    without arguments, it never gets another queue, and it is never copied or passed to a function.
    """
    created = re.search(r'(\w+)\s*\.\s*advertiseService\s*\(\s*"/?battery"', code)
    if created is None or not re.search(rf"NodeHandle\s+{created[1]}\s*;", code):
        return False
    return not re.search(rf"\b{created[1]}\s*\.\s*setCallbackQueue|[(,=&]\s*{created[1]}\s*[,);]|\[&\]", code)


def _sets_the_queue_too_late(code: str) -> bool:
    """Return whether the NodeHandle that creates /battery gets its queue after this service was created."""
    created = re.search(r'(\w+)\s*\.\s*advertiseService\s*\(\s*"/?battery"', code)
    given = re.search(rf"\b{created[1]}\s*\.\s*setCallbackQueue", code) if created else None
    return bool(created and given and given.start() > created.start())


def _uses(context: CheckContext, program: TurtleProgram, pattern: str, assertion: str, hint: str) -> None:
    code = _code(context, program)
    context.require(
        assertion,
        holds=bool(re.search(pattern, code)),
        expected="in main",
        actual="none",
        hints=hint,
    )
    _calls_battery(context, holds=bool(re.search(r"\bcall\s*\(\s*\w", code)) and "handleReport" in code)


def _calls_battery(context: CheckContext, *, holds: bool) -> None:
    context.require(
        "the handler of /report still calls /battery",
        holds=holds,
        expected="a call of the service",
        actual="none",
        hints=(
            "A handler is different from the original handler. Use the two original handlers, and change "
            "only main."
        ),
    )


def _reports(
    context: CheckContext,
    program: TurtleProgram,
    clients: int,
    too_few: str,
    *,
    hangs: str,
    held: bool = False,
    separate: bool = False,
) -> None:
    """Call /report once, and then many times by `clients` clients at the same time.

    If `separate` is true, /battery must respond while the handlers of all calls of /report wait.
    If `held` is true, the last calls of the clients continue only when all of them have reached /battery.
    """
    level = context.random.integer(3, 79)
    world = World(context, program.prepare(context, program), program, services=SERVICES)
    with world.run(f"_level:={level}") as running:
        world.serves(running, *SERVICES)
        world.service("battery", TRIGGER, [(matches("TimesUp"), NOT_SPUN)])()
        _answers(context, world.service("report", TRIGGER, _why(hangs)), level)
        report = world.service("report", TRIGGER, _why(too_few))
        for reply in _groups(report, clients):
            _has_the_level(context, reply, clients, level)
        given = COMMENT.sub("", START.format(path="")).partition("bool ")[2].partition("int main")[0]
        code = "".join(_code(context, program).split())
        _calls_battery(context, holds="".join(given.split()) in code)
        if held:
            relay = BatteryRelay(world.name("battery"), clients)
            server = context.serve(world.name("battery"), TRIGGER, relay.answer)
            for reply in report.at_once([{}] * clients):
                _has_the_level(context, reply, clients, level)
            server.leave()
        if separate:
            _battery_has_its_own_queue(context, world, report)
        # After this line, the master returns the address of the check's own server for /battery.
        drawn = context.random.word()
        context.serve(world.name("battery"), TRIGGER, lambda _: {"success": True, "message": drawn})
        _calls_battery(context, holds=report().message == f"battery: {drawn}")
        context.serve(world.name("battery"), TRIGGER, lambda _: Refuse(drawn))
        _calls_battery(context, holds=bool(report.replies([{}])[0].error))


def _battery_has_its_own_queue(context: CheckContext, world: World, report: Service) -> None:
    """Hold the calls of /battery in the handlers of /report, and call the program's own /battery."""
    own = rospy.ServiceProxy(world.name("battery"), report.kind, persistent=True)
    own()  # This connection remains after the check has registered its own server.
    gate = BatteryGate()
    server = context.serve(world.name("battery"), TRIGGER, gate.answer)
    calls = Thread(target=report.replies, args=([{}] * CROWD,), daemon=True)
    calls.start()
    gate.wait_for_the_last(at_this_load(QUIET))
    responses: Queue[str] = Queue()
    Thread(
        target=lambda: responses.put(response_of(own, report.kind._request_class())[1]), daemon=True
    ).start()
    responded = bool(wait_until(lambda: not responses.empty(), at_this_load(SOON)))
    gate.opened.set()
    calls.join()
    server.leave()
    context.require(
        "/battery has its own callback queue",
        holds=responded,
        expected="a response of /battery while calls of /report wait",
        actual=f"no response, while {gate.held} calls of /report wait",
        hints=SHARED_QUEUE,
    )


def _has_the_level(context: CheckContext, reply: Reply, clients: int, level: int) -> None:
    context.require(
        f"{clients} clients that call at the same time get their responses",
        holds=reply.response.message == f"battery: {level}",
        expected=f"battery: {level}",
        actual=reply.response.message,
    )


def _groups(report: Service, clients: int) -> Iterator[Reply]:
    """Make many groups of simultaneous calls, and yield the replies.

    On a busy machine, the calls of one group may arrive one after another, so one group is not enough. If
    threads share a ServiceClient, about one of 5,000 calls fails in roscpp. Therefore, up to
    `FAILED` groups may contain failed calls. After a deadlock, all later calls fail, so a deadlock is still
    found.
    """
    failed = 0
    for _ in range(GROUPS):
        calls: list[Mapping[str, Value]] = [{}] * clients
        replies = report.replies(calls) if failed < FAILED else report.at_once(calls)
        if any(reply.error for reply in replies):
            failed += 1
            report()
        else:
            yield from replies


def _why(hangs: str) -> list[tuple[re.Pattern[str], str]]:
    return [
        (matches("TimesUp"), hangs),
        (
            matches("responded with an error"),
            (
                "The handler of /report returned false, because its call of /battery failed. Check that "
                'the ServiceClient has the service name "battery".'
            ),
        ),
    ]


def _answers(context: CheckContext, report: Service, level: int) -> None:
    context.expect(
        "/report responds with the level of the battery",
        expected=f"battery: {level}",
        actual=report().message,
        hints=[
            (
                "battery: 80",
                (
                    "The level in the message is wrong. Read the level from the parameter ~level, "
                    "and do not change the line with ros::param::param in main."
                ),
            ),
            (ANYTHING, 'The message is wrong. Write the word "battery", a colon, a space and the level.'),
        ],
    )
