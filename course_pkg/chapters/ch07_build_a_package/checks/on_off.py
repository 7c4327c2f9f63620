"""07.9 and 07.10: the server and the client of the second package, service_example."""

from __future__ import annotations

import re

from course_pkg.chapters.ch07_build_a_package.checks.packages import (
    SERVICE_EXAMPLE_PACKAGE,
    service_example_class,
)
from course_pkg.chapters.ch07_build_a_package.checks.program import (
    Program,
    can_be_imported,
    is_a_script,
    is_executable,
    serves,
)
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.common_hints import REFUSED_BY_HANDLER
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.catkin_package import built
from course_pkg.checking.shared.script import own_line
from course_pkg.checking.shared.served_by import require_still_served
from course_pkg.workspace import explain

SERVER = Program("scripts/on_off_server.py", "ON_OFF_SERVER", "/onOff")
CLIENT = Program("scripts/on_off_client.py")
SERVER_FILE = SERVICE_EXAMPLE_PACKAGE.path(SERVER.file)
CLIENT_FILE = SERVICE_EXAMPLE_PACKAGE.path(CLIENT.file)
WITHIN = 12.0  # A run of the client may take up to this time in s.
# The client makes at least this many calls. With fewer calls, even a right client could by chance repeat a
# pattern.
CALLS = 24
PATTERN = 5  # The random numbers must not repeat a pattern of up to this many numbers.

SERVER_START = f"""%%writefile {SERVER_FILE}
..."""
CLIENT_START = f"""%%writefile {CLIENT_FILE}
..."""
ANSWERED = "Return the state OFF for 0 and ON for 1."
CALLED = "Call /onOff COUNT times, each time with a random number, 0 or 1."


@part(
    "07.9",
    points=3,
    goal=(
        "Write on_off_server.py: the node ON_OFF_SERVER serves /onOff. The state is OFF for 0 "
        "and ON for 1, and the server refuses all other numbers."
    ),
    needs=[f"file:{SERVER_FILE}"],
    deadline=120.0,
    start=SERVER_START,
    goals={ANSWERED: 2, "Refuse all other numbers.": 1},
)
def the_on_off_server(context: CheckContext) -> None:
    """Start the server in a separate namespace; call it with 0, 1 and other numbers."""
    is_a_script(context, SERVER_FILE)
    is_executable(context, SERVER_FILE)
    package = built(context, SERVICE_EXAMPLE_PACKAGE, examined=SERVER.file)
    can_be_imported(context, package, SERVER)
    space = f"/{context.random.word()}"
    name = f"{space}{SERVER.service}"
    line = f"rosrun service_example {SERVER.name} __ns:={space} {SERVER.service}:={name}"
    with package.start(line, worded=f"rosrun service_example {SERVER.name}") as running:
        serves(context, running, package, SERVER, name, f"{space}/{SERVER.node}")
        refused = (
            REFUSED_BY_HANDLER,
            "The server refused 0 or 1, but these numbers are valid. Refuse only other numbers.",
        )
        service = context.service(name, service_example_class(), timeout=5.0, hints=[refused])
        for number, state in context.random.shuffled([(0, "OFF"), (1, "ON"), (0, "OFF")]):
            context.expect(
                "state is OFF for 0 and ON for 1",
                expected=state,
                actual=service(number=number).state,
                hints=[
                    (
                        "",
                        "The state is an empty string, because the server did not set it. Set "
                        "the state to ON or OFF.",
                    ),
                    (
                        state.lower(),
                        "The state contains small letters. Write ON and OFF in capital letters.",
                    ),
                    (
                        lambda text: text in ("ON", "OFF"),
                        "The two states are exchanged. Return OFF for 0, and ON for 1.",
                    ),
                    (ANYTHING, "This state is neither ON nor OFF. Return only ON or OFF."),
                ],
            )
        context.fulfilled(ANSWERED)
        require_still_served(context, name)
        # The lowest bits of the last number are those of 0 or 1.
        other = context.random.integer(3, 2_000_000_000)
        long = context.random.integer(1, 30_000) * 2**16 + context.random.integer(0, 1)
        for number in (2, -1, other, long):
            service.refused(
                "any other number is refused, and the error message contains the number",
                saying=(f"cannot process request: .*(?<!\\d){number}", f"contains {number}"),
                number=number,
                hints=[
                    (
                        matches("returned (None|invalid)"),
                        "The handler returned no response. Raise rospy.ServiceException for an "
                        "invalid number.",
                    ),
                    (
                        REFUSED_BY_HANDLER,
                        "The message of the exception does not contain the number. Write the "
                        "number in the message.",
                    ),
                    (
                        matches("error processing"),
                        "The exception has the wrong type, so the error message is the "
                        "same as for a bug in the server. Raise rospy.ServiceException.",
                    ),
                    (
                        ANYTHING,
                        "The server accepted a number that is neither 0 nor 1. Raise an "
                        "exception for this number.",
                    ),
                ],
            )


@part(
    "07.10",
    points=2,
    goal=(
        "Write on_off_client.py, which calls /onOff COUNT times with a random number, 0 or 1. "
        "For each call, the client prints a line `NUMBER: STATE`."
    ),
    needs=[f"file:{CLIENT_FILE}"],
    deadline=120.0,
    start=CLIENT_START,
    goals=[CALLED, "Print one line for each call."],
)
def the_on_off_client(context: CheckContext) -> None:
    """Run the client with a server that returns random words as states."""
    is_a_script(context, CLIENT_FILE)
    is_executable(context, CLIENT_FILE)
    package = built(context, SERVICE_EXAMPLE_PACKAGE, examined=CLIENT.file)
    states, calls = [context.random.word(), context.random.word()], context.random.integer(CALLS, CALLS + 8)

    server = context.serve(
        "/onOff", service_example_class(), lambda request: {"state": states[request.number % 2]}
    )
    done = package.run(f"rosrun service_example {CLIENT.name} {calls}", within=WITHIN)
    sent = [int(str(value)) for request in server.requests for value in request.values()]
    server.leave()
    context.require(
        "the client calls /onOff COUNT times",
        holds=len(sent) == calls,
        expected=f"{calls} calls",
        actual=f"{len(sent)} calls, and {_ending(done)}",
        hints=_why_not_sent(len(sent), calls, done),
    )
    context.require(
        "each number is a random number, 0 or 1",
        holds=set(sent) == {0, 1} and all(sent[size:] != sent[:-size] for size in range(1, PATTERN + 1)),
        expected="both numbers, in a random order",
        actual=" ".join(map(str, sent)),
        hints=("The numbers are not random. Call random.randint(0, 1) again for each call of the service."),
    )
    context.fulfilled(CALLED)
    wanted = [f"{number}: {states[number % 2]}" for number in sent]
    printed = [line.strip() for line in done.out.splitlines() if re.match(r"\s*\d+\s*:", line)]
    context.require(
        "the client prints NUMBER: STATE for each call",
        holds=printed == wanted,
        expected=f"one line for each call; the first line is {wanted[0]}",
        actual=" / ".join(done.out.splitlines()[:3]) or "no output",
        hints=_why_not_printed(sent, printed, wanted),
    )
    context.require(
        "the client ends with exit status 0",
        holds=done.status == 0,
        expected="exit status 0",
        actual=_ending(done),
        hints="The exit status is not 0. After the last call, do not call sys.exit.",
    )


def _why_not_printed(sent: list[int], printed: list[str], wanted: list[str]) -> str:
    """Return the hint for the lines `printed`, which differ from the lines `wanted`."""
    if printed == [f"{number}: {'ON' if number else 'OFF'}" for number in sent]:
        return (
            "The client prints ON and OFF, but the check's server returned other states. Print the state in "
            "the response."
        )
    if [re.sub(r"\s+:", ":", line) for line in printed] == wanted:
        return (
            "The client prints a space before the colon. Use an f-string, because print() writes a space "
            "between two arguments."
        )
    return (
        "The output is wrong. For each call, print the number that you sent, a colon, a space, and the state "
        "in the response."
    )


def _why_not_sent(count: int, wanted: int, done: Finished) -> str:
    printed = done.out + done.err
    if "Traceback" in printed:
        fault = explain(printed)
        return f"{fault.problem} {fault.remedy}" if fault else own_line(CLIENT.name, printed)
    if done.status is None:
        return (
            "The client does not end. Check the name of the service in wait_for_service, and check that "
            "the loop ends."
        )
    if count == 0:
        return "The client ended, but it did not call /onOff. Call this service COUNT times."
    if count == 1:
        return (
            "The client called the service only once. Read the number of calls from the first "
            "argument: int(sys.argv[1])."
        )
    if abs(count - wanted) == 1:
        return (
            "The client made one call too few or one call too many. Count how often the loop runs if the "
            "first argument is 1."
        )
    return (
        "The number of calls is wrong. Make as many calls as the first argument says, even if the client "
        "has sent the same number before."
    )


def _ending(done: Finished) -> str:
    return "the client is still running" if done.status is None else f"exit status {done.status}"
