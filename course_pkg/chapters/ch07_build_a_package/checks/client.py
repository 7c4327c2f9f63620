"""07.5: the geometry client as a program: arguments, a usage message, and an exit status."""

from __future__ import annotations

import re

from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY, geometry_class
from course_pkg.chapters.ch07_build_a_package.checks.program import (
    Program,
    can_be_imported,
    is_a_script,
    is_executable,
)
from course_pkg.checking import CheckContext, Refuse, part
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.catkin_package import BuiltPackage, built
from course_pkg.checking.shared.script import own_line
from course_pkg.workspace import explain

CLIENT = Program("scripts/client.py")
FILE = MY_GEOMETRY.path(CLIENT.file)
SERVICE = "/getGeometry"
USAGE = re.compile("^usage:", re.MULTILINE)
# The pattern matches rospy's error messages for a missing service.
WAITED = re.compile("waiting for service|unavailable")
# A run of the client may take up to this time in s: rospy needs 0.5 s to start (5 s on a busy machine), and
# the client waits up to 5 s.
WITHIN = 16.0
# Without a server, the client has to end within `WAITING` s plus `SLOWER` times the duration of its fastest
# run with wrong arguments. This duration shows how long a start takes on this machine now.
WAITING, SLOWER = 7.0, 1.5

START = f"""%%writefile {FILE}
..."""
PRINTED = "Call the service once, and print the area and the volume."
EXPLAINED = "If the arguments are wrong, end with exit status 2."


@part(
    "07.5",
    points=3,
    goal=(
        "Write client.py, which takes three numbers and prints the area and the volume. The exit status "
        "is 0 after a response, 1 if there is no response, and 2 if the arguments are wrong."
    ),
    needs=[f"file:{FILE}"],
    deadline=120.0,
    start=START,
    goals=[PRINTED, EXPLAINED, "If there is no response, end with exit status 1."],
)
def the_client(context: CheckContext) -> None:
    """Run the client with a server that responds or refuses, with wrong arguments, and without a server."""
    is_a_script(context, FILE)
    is_executable(context, FILE)
    package = built(context, MY_GEOMETRY, examined=CLIENT.file)
    can_be_imported(context, package, CLIENT)
    _prints_the_answer(context, package)
    context.fulfilled(PRINTED)
    start = _explains_its_usage(context, package)
    context.fulfilled(EXPLAINED)
    _ends_with_one_after_a_refusal(context, package)
    _gives_up_without_a_server(context, package, start)


def _prints_the_answer(context: CheckContext, package: BuiltPackage) -> None:
    sides = context.random.numbers(3, 0.5, 9.0, digits=1)
    # The area has only one decimal place, so print(round(area, 2)) does not print two decimal places.
    area, volume = context.random.number(100.0, 900.0, digits=1), context.random.number(100.0, 900.0)
    server = context.serve(SERVICE, geometry_class(), lambda _: {"area": area, "volume": volume})
    name, topic = context.random.word(), context.random.word()
    for_ros = context.random.shuffled([f"__name:={name}", f"_{name}:=3", f"{topic}:=/{topic}_2"])
    done = _run(package, [*map(str, sides), *for_ros])
    server.leave()
    sent = [round(float(str(value)), 2) for value in server.requests[0].values()] if server.requests else []
    context.require(
        "the client sends length, width and height",
        holds=sent == sides,
        expected=", ".join(map(str, sides)),
        actual=", ".join(map(str, sent)) or _outcome(done),
        hints=_why_not_sent(sent, sides, done),
    )
    context.require(
        "the client sends length, width and height",
        holds=len(server.requests) == 1,
        expected="one request",
        actual=f"{len(server.requests)} requests",
        hints="The client called the service more than once. Store the response in a variable.",
    )
    for name, value in (("area", area), ("volume", volume)):
        shown = _printed(done, name)
        context.require(
            f"the client prints a line with the {name} in the response",
            holds=shown is not None and abs(shown - value) < 0.006,
            expected=f"{name}: {value:.2f}",
            actual=_outcome(done),
            hints=(
                f"Print one line with the text {name}: and the value of response.{name}, with two "
                "decimal places."
            )
            if shown is None
            else (
                f"The client prints a number that is not the {name} in the response. Do not "
                f"compute the {name} in the client."
            ),
        )
    context.require(
        "after a response, the exit status of the client is 0",
        holds=done.status == 0,
        expected="exit status 0",
        actual=_outcome(done),
        hints=(
            "The exit status has to be 0 after a successful call. Remove the sys.exit that "
            "sets a different status."
        )
        if done.status is not None
        else "The client does not end. Remove rospy.spin(): the client has to end after the call.",
    )


def _why_not_sent(sent: list[float], sides: list[float], done: Finished) -> str:
    if sent and sorted(sent) == sorted(sides):
        return (
            "The request contains the numbers in the wrong order. The order of the arguments is "
            "LENGTH WIDTH HEIGHT."
        )
    if sent:
        return (
            "The request contains the wrong numbers. Convert the three arguments to float, and "
            "send these numbers unchanged."
        )
    if done.status is None:
        return f"The client waits, but it sends no request. Wait for {SERVICE}, and call this service once."
    if done.status == 2:
        return "ROS uses the arguments that contain :=. Remove these arguments with rospy.myargv(sys.argv)."
    return _about_error(done)


def _explains_its_usage(context: CheckContext, package: BuiltPackage) -> float:
    """Run the client with wrong arguments; return how long the fastest run took, in s."""
    server = context.serve(SERVICE, geometry_class(), lambda _: {"area": 1.0, "volume": 1.0})
    lists = (["1.2", "5.2"], ["1.2", "5.2", "8.9", "4"])
    took = [_prints_usage(context, package, arguments) for arguments in lists]
    context.require(
        "if the arguments are wrong, the client sends no request",
        holds=not server.requests,
        expected="no request",
        actual=f"{len(server.requests)} requests",
        hints=(
            "The client sent a request, although the arguments were wrong. Check the arguments "
            "before the call."
        ),
    )
    server.leave()
    context.absent(SERVICE)
    return min(*took, _prints_usage(context, package, ["1.2", "wide", "8.9"]))


def _prints_usage(context: CheckContext, package: BuiltPackage, arguments: list[str]) -> float:
    done = _run(package, arguments)
    printed = done.out + done.err
    context.require(
        "if the arguments are wrong, the client prints a usage message and ends with exit status 2",
        holds=done.status == 2 and bool(USAGE.search(printed)),
        expected="usage: …, and exit status 2",
        actual=_outcome(done),
        hints=_why_no_usage(printed, arguments),
    )
    return done.took


def _why_no_usage(printed: str, arguments: list[str]) -> str:
    if USAGE.search(printed):
        return (
            "The exit status has to be 2 if the arguments are wrong. Call sys.exit(2) after the "
            "usage message."
        )
    if WAITED.search(printed):
        return (
            "The client waited for the service before it checked the arguments. First check the "
            "arguments, and then wait for the service."
        )
    if "wide" in arguments and len(arguments) == 3:
        return "float() raises ValueError for a text that is not a number. Catch this exception."
    if len(arguments) > 3:
        return "The client accepted four arguments. Test whether there are exactly three arguments."
    return 'The usage line is missing. Print a line that begins with "usage:" and shows the three arguments.'


def _ends_with_one_after_a_refusal(context: CheckContext, package: BuiltPackage) -> None:
    server = context.serve(SERVICE, geometry_class(), lambda _: Refuse("no box"))
    done = _run(package, ["-1.2", "52e-1", "9"])
    server.leave()
    context.require(
        "if an argument is a negative number, or has no point, the client sends a request",
        holds=bool(server.requests),
        expected="one request",
        actual=_outcome(done),
        hints=(
            "The arguments -1.2, 52e-1 and 9 are numbers, but the client sent no request. Do not test the "
            "characters of an argument: use float(), which raises ValueError for a text that is not a number."
        ),
    )
    context.require(
        "if the server refuses the call, the client prints the error message and ends with exit status 1",
        holds=done.status == 1 and "no box" in done.out + done.err and "Traceback" not in done.err,
        expected="the error message, and exit status 1",
        actual=_outcome(done),
        hints="The client printed a traceback. Catch rospy.ServiceException, and print only its message."
        if "Traceback" in done.err
        else "Print the message of the exception. Then call sys.exit(1).",
    )


def _gives_up_without_a_server(context: CheckContext, package: BuiltPackage, start: float) -> None:
    context.absent(SERVICE)
    for _ in range(3):  # The machine can be busy for a moment, so the best of three runs counts.
        done = _run(package, ["1.2", "5.2", "8.9"])
        if done.status != 1 or done.took <= WAITING + SLOWER * start:
            break
    context.require(
        "if there is no server, the client ends with exit status 1 after at most 5 s",
        holds=done.status == 1 and "Traceback" not in done.err,
        expected="an error message, and exit status 1",
        actual=_outcome(done),
        hints="The client waits for the service without a time limit. Call wait_for_service with a timeout."
        if done.status is None
        else (
            "wait_for_service raises rospy.ROSException when the timeout is over. Catch this exception, too."
        )
        if "Traceback" in done.err
        else "The exit status has to be 1 if there is no response. Call sys.exit(1) in this case.",
    )
    context.require(
        "if there is no server, the client ends with exit status 1 after at most 5 s",
        holds=done.took <= WAITING + SLOWER * start,
        expected="the client ends after 5 s",
        actual=f"the client ended after {done.took:.1f} s",
        hints="The client waits longer than 5 s for the service. Set the timeout of wait_for_service to 5 s.",
    )
    context.require(
        "if there is no server, the client ends with exit status 1 after at most 5 s",
        holds="unavailable" not in done.out + done.err,
        expected="the client ends after 5 s",
        actual=_outcome(done),
        hints=(
            "The client did not wait, but the service can start later than the client. Wait up "
            "to 5 s for the service."
        ),
    )


def _run(package: BuiltPackage, arguments: list[str]) -> Finished:
    return package.run(f"rosrun my_geometry {CLIENT.name} {' '.join(arguments)}", within=WITHIN)


def _printed(done: Finished, name: str) -> float | None:
    """Return the number in an output line such as "area: 6.24", or None without this line.

    `name` is the first word of the line.
    """
    found = re.search(rf"(?m)^\s*{name}:\s*(-?\d+\.\d\d)\s*$", done.out)
    return float(found[1]) if found else None


def _outcome(done: Finished) -> str:
    lines = (done.out + done.err).strip().splitlines()
    ending = "still running" if done.status is None else f"exit status {done.status}"
    return f"{' / '.join(lines[-2:])}, and {ending}" if lines else f"no output, and {ending}"


def _about_error(done: Finished) -> str:
    printed = done.out + done.err
    if "Traceback" not in printed:
        return f"The client ended, but it sent no request. Call {SERVICE} with the three numbers."
    fault = explain(printed)
    return f"{fault.problem} {fault.remedy}" if fault else own_line(CLIENT.name, printed)
