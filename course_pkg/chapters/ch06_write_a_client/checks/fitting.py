"""06.6: a client program that returns its result as an exit status."""

from __future__ import annotations

import time
from contextlib import ExitStack
from dataclasses import dataclass

from course_pkg.chapters.ch06_write_a_client.checks.boxes import GEOMETRY
from course_pkg.checking import CheckContext, Refuse, part
from course_pkg.checking.assertions import same
from course_pkg.checking.commands.folder import Folder, telling_line
from course_pkg.checking.peers.scripted_server import Script, ScriptedServer
from course_pkg.checking.result import Finished
from course_pkg.checking.shared.script import require_shebang
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import at_this_load, wait_until

FILE = "fits.py"
# All runs start at the same time and may take up to this time in s; a program waits at most 2 s for the
# service.
RUNS = 9.0
# A program may wait up to this time in s for a missing service: 2 s, plus the time that it needs to end.
WAITS = 4.0
# LATE is the time in s between the first snapshot that contains the node and the start of the service.
LATE = 0.5
POLL = 0.2  # The check tests every `POLL` s whether the runs have ended.
# A process that imports the file ends with this exit status, unless the file ends the process earlier.
IMPORTED = 77
IMPORT = f"import sys; sys.argv = ['fits.py']; import fits; sys.exit({IMPORTED})"
USAGE = "usage"
ENDED_WITH_TEXT = (
    "The exit status is 1, because sys.exit with a text always ends the program with exit status 1. "
    "First print the text, and then call sys.exit(3)."
)
START = f"""%%writefile {FILE}
#!/usr/bin/env python3
..."""


@dataclass(frozen=True)
class Case:
    """The inputs and the expected result of one run of the student's program."""

    title: str
    arguments: list[str]
    # `script` returns the service's response to a request; None means that there is no service.
    script: Script | None
    status: int
    prints: str
    calls: int = 1
    hint: str = ""  # The report shows `hint` if the exit status is wrong.
    # If `remapped` is True, getGeometry is remapped to a name in another namespace. Otherwise, the program
    # itself runs in another namespace.
    remapped: bool = False
    late: bool = False  # `late` is True if the service starts after the program.
    # `ends` is a goal, or "". The student has reached this goal if this run and all earlier runs are right.
    ends: str = ""


COMPARED = "Call getGeometry, and print whether the volume is at most LIMIT."
USED = "If the arguments are wrong, print a usage line, and end with exit status 2."


@part(
    "06.6",
    points=3,
    goal=(
        "Write fits.py, a program that calls getGeometry and prints whether the volume is at "
        "most LIMIT. The program ends with the exit status 0, 1, 2 or 3."
    ),
    needs=[f"file:{FILE}"],
    deadline=30.0,
    start=START,
    goals={
        COMPARED: 2,
        USED: 1,
        "Wait for a service that starts late. If the call fails, end with exit status 3.": 1,
    },
)
def does_it_fit(context: CheckContext) -> None:
    """Run the program for all cases at the same time; each run has its own namespace."""
    require_shebang(
        context,
        FILE,
        missing=(
            "The shebang is missing: the first line has to name the program that runs the file. Begin "
            "line 1 with #!/usr/bin/env python3."
        ),
    )
    folder = context.folder(files=[FILE])
    word = context.random.word()
    absolute = context.serve("/getGeometry", GEOMETRY, lambda _: {"volume": 1.0})
    with ExitStack() as runs:
        imported = runs.enter_context(folder.start("python", "-c", IMPORT, worded="import fits"))
        started = [
            Started(context, folder, case, f"/{word}/n{number}")
            for number, case in enumerate(_cases(context))
        ]
        for each in started:
            runs.enter_context(each.run)

        running = [imported, *(each.run for each in started)]

        def ended() -> bool:
            # The last run has a service that must start in time, so watch this run first.
            for each in reversed(started):
                each.watch()
            return all(run.status is not None for run in running)

        wait_until(ended, at_this_load(RUNS), POLL)
        finished = [run.stop() for run in running]
    imported.show()
    _can_be_imported(context, finished[0])
    for each, done in zip(started, finished[1:], strict=True):
        each.run.show()
        _examine(context, each.case, each.server, done, elsewhere=bool(absolute.requests))
        if each.waited > WAITS:  # The run may be slow because the machine is busy, so repeat it alone.
            again = Started(context, folder, each.case, f"/{word}/again")
            with again.run:
                wait_until(again.watch, RUNS, POLL)
            if again.waited > WAITS:
                context.fail(
                    f"{each.case.title}: the exit status is {each.case.status}",
                    expected="the program ends after about 2 s",
                    actual=f"the program ends after more than {again.waited:.1f} s",
                    hint="The program waits too long for a missing service. Wait at most 2 s.",
                )
        if each.case.ends:
            context.fulfilled(each.case.ends)


def _cases(context: CheckContext) -> list[Case]:
    sides = [str(side) for side in context.random.numbers(3, 0.5, 9.0)]
    volume = context.random.integer(100, 900) + 0.375
    # The whole parts of the three limits are equal, so that a rounded volume gives a wrong result.
    limits = (str(volume + 0.25), str(volume), str(volume - 0.25))
    fits, equal, smaller = ([*sides, limit] for limit in limits)

    def answer(_: object) -> dict[str, float]:
        return {"area": volume * 3, "volume": volume}

    done = 'The volume in the response is at most LIMIT. Print "fits", and end with exit status 0.'
    usage = "The arguments are not four numbers. Print a usage line, and end with exit status 2."
    return [
        Case("a volume below LIMIT", fits, answer, 0, "fits", hint=done),
        Case(
            "a volume equal to LIMIT",
            equal,
            answer,
            0,
            "fits",
            hint=(
                'The volume is equal to LIMIT, and "at most LIMIT" includes LIMIT itself. '
                "Compare with <=, and do not round the volume before the comparison."
            ),
            remapped=True,
        ),
        Case(
            "a volume above LIMIT",
            smaller,
            answer,
            1,
            "too large",
            hint=(
                'The volume in the response is larger than LIMIT. Print "too large", and end '
                "with exit status 1."
            ),
            ends=COMPARED,
        ),
        Case("only three arguments", sides, answer, 2, USAGE, calls=0, hint=usage),
        Case(
            "five arguments",
            [*fits, str(context.random.integer(1, 9))],
            answer,
            2,
            USAGE,
            calls=0,
            hint=usage,
        ),
        Case(
            "a word in place of a number",
            [sides[0], "wide", *fits[2:]],
            answer,
            2,
            USAGE,
            calls=0,
            hint=(
                "float() raises ValueError for a word. Catch this exception, print the usage line, "
                "and end with exit status 2."
            ),
        ),
        Case(
            "a word in place of a number", [*sides, "ten"], answer, 2, USAGE, calls=0, hint=usage, ends=USED
        ),
        Case(
            "a refused call",
            fits,
            lambda _: Refuse("no such box"),
            3,
            "no such box",
            hint=(
                "A failed call raises rospy.ServiceException. Print the message of the exception, "
                "and end with exit status 3."
            ),
        ),
        Case(
            "no service",
            fits,
            None,
            3,
            "",
            calls=0,
            hint=(
                "wait_for_service raises rospy.ROSException after 2 s. Print the message of this "
                "exception, and end with exit status 3."
            ),
        ),
        Case("a volume below LIMIT", fits, answer, 0, "fits", hint=done, late=True),
    ]


class Started:
    """One run of the student's program, which must call getGeometry in the namespace `namespace`."""

    def __init__(self, context: CheckContext, folder: Folder, case: Case, namespace: str) -> None:
        self.case = case
        self._context = context
        self._service = f"{namespace}/getGeometry"
        self._node = f"{namespace}/{namespace.replace('/', '')}"
        # For a late or a missing service, this is the time when the program's node was first on the graph.
        self._seen: float | None = None
        self.waited = 0.0  # The program has waited for a missing service for at least this time in s.
        self.server = self._serve() if case.script and not case.late else None
        named = f"getGeometry:={self._service}" if case.remapped else f"__ns:={namespace}"
        argv = (FILE, *case.arguments, named, f"__name:={namespace.replace('/', '')}")
        self.run = folder.start("python", *argv, worded=" ".join(["python3", *argv]))

    def watch(self) -> bool:
        """If the program's node has been on the graph for `LATE` s, serve the late service.

        If there is no service, store how long the program waits, and return whether the program has ended.
        """
        if self.server or (self.case.script and not self.case.late):
            return False
        if self._seen is None and any(node.name == self._node for node in self._context.look().nodes):
            self._seen = time.monotonic()
        waited = time.monotonic() - self._seen if self._seen else 0.0
        if self.case.late:
            self.server = self._serve() if waited > LATE else None
        elif self.run.status is None:
            self.waited = waited
            return False
        return True

    def _serve(self) -> ScriptedServer:
        assert self.case.script  # This method is called only for cases with a service.
        return self._context.serve(self._service, GEOMETRY, self.case.script)


def _can_be_imported(context: CheckContext, done: Finished) -> None:
    context.require(
        "an import of the file does not run the program",
        holds=done.status == IMPORTED and not done.out.strip(),
        expected="no output",
        actual=telling_line(done.out),
        hints=(
            "Python cannot import the file without an error. Correct the mistake, or move the "
            "lines that start the program below the line with `__name__`."
        ),
    )


def _examine(
    context: CheckContext, case: Case, server: ScriptedServer | None, done: Finished, *, elsewhere: bool
) -> None:
    """Assert that the calls, the exit status and the output of one run are right."""
    calls = len(server.requests) if server else 0
    outcome = f"{telling_line(done.out)}, and {_ending(done)}"
    context.require(
        f"{case.title}: {'the program sends one request' if case.calls else 'the program sends no request'}",
        holds=calls == case.calls,
        expected=f"{case.calls} request(s) to the service in the command line",
        actual=f"{calls} request(s); {outcome}",
        hints=_about_calls(calls, case, done, elsewhere),
    )
    sides: list[Json] = [float(text) for text in case.arguments[:3]] if calls else []
    if server and calls and not same(sides, [*server.requests[0].values()], near=1e-4):
        context.fail(
            f"{case.title}: the program sends one request",
            expected=f"a request with the sides {sides}",
            actual=f"a request with {server.requests[0]}",
            hint=(
                "The request does not contain the sides from the command line. Send LENGTH, WIDTH and "
                "HEIGHT as length, width and height."
            ),
        )
    context.require(
        f"{case.title}: the exit status is {case.status}",
        holds=done.status == case.status and "Traceback" not in done.out,
        expected=f"exit status {case.status}, and no traceback",
        actual=outcome,
        hints=(
            "The program does not end. Call wait_for_service with a timeout of 2 s, and do not "
            "call rospy.spin()."
        )
        if done.status is None
        else ENDED_WITH_TEXT
        if case.status == 3 and done.status == 1 and "Traceback" not in done.out
        else case.hint,
    )
    context.require(
        f"{case.title}: the program prints {case.prints or 'the error message'}",
        holds=_prints(case, done.out),
        expected="a line that begins with usage:"
        if case.prints == USAGE
        else case.prints or "the error message",
        actual=telling_line(done.out),
        hints=(
            "The exit status is right, but the output is wrong. Print exactly the text in the "
            "table, on a separate line."
        ),
    )


def _prints(case: Case, out: str) -> bool:
    """Return whether the output has a line with the expected text, and no line with another case's text."""
    lines = [line.strip() for line in out.splitlines()]
    usage = any(line.startswith("usage:") for line in lines)
    if usage != (case.prints == USAGE) or {"fits", "too large"}.intersection(lines) - {case.prints}:
        return False
    if case.prints == USAGE:
        return True
    if case.status in (0, 1):
        return case.prints in lines
    return case.prints in out and any(lines)


def _about_calls(calls: int, case: Case, done: Finished, elsewhere: bool) -> str:
    if calls > case.calls > 0:
        return "The program called the service more than once. Call the service once, and store the response."
    if calls and len(case.arguments) > 4:
        return (
            "The program ignored the fifth argument and sent a request. Test whether there are exactly four "
            "arguments before the call."
        )
    if calls:
        return (
            "The arguments were wrong, but the program sent a request. Check the arguments before the call."
        )
    if case.late and done.status == 3:
        return (
            "The service started while the program ran, but the program did not call the "
            "service. Before the call, wait up to 2 s for the service."
        )
    if elsewhere and case.remapped:
        return (
            "The program ignored the remapping of getGeometry. Call rospy.init_node before the program "
            "uses the name of the service."
        )
    if elsewhere:
        return (
            "The program called /getGeometry, although the program ran in a namespace. Remove "
            "the slash from the name of the service."
        )
    if done.status == 2:
        return "ROS uses the arguments that contain :=. Remove these arguments with rospy.myargv(sys.argv)."
    return (
        "The program ended before the call. Run the program in a terminal, and read the last line "
        "of the output."
    )


def _ending(done: Finished) -> str:
    return "still running" if done.status is None else f"exit status {done.status}"
