"""15.4: a program that waits for the detector for a limited time, calls it once, and ends."""

from __future__ import annotations

from contextlib import ExitStack

from course_pkg.chapters.ch15_robot_cashier.checks.packages import file_of, program, start_of
from course_pkg.chapters.ch15_robot_cashier.checks.student_node import examined, started, why_ended
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.commands.folder import Running
from course_pkg.checking.peers.scripted_server import Act, HangUp, Refuse
from course_pkg.checking.shared.catkin_package import BuiltPackage
from course_pkg.srv import AwaitCustomerRequest
from course_pkg.waiting import wait_until

NAME = "ask_customer"
DETECT = "detect_customer"
AWAIT = "course_pkg/AwaitCustomer"
STARTING = 20.0  # STARTING is the time limit in s for the start of Python and rospy on a busy machine.
ENDING = 6.0  # A program must end within this time in s after the response.
LIMIT = 3.0  # LIMIT is the time in s for which the program waits for the service.
# In the shortest of its runs without a service, the program may wait for this additional time in s. If the
# first of these runs takes too long, the check makes up to `ATTEMPTS` runs more.
EXTRA, ATTEMPTS = 0.5, 3
SOON = 1.0  # SOON is the time in s between the start of the node and the start of the service.
REASON = "no message from the camera"
REFUSED = 55.0  # The service refuses a call with this value of `patience` (s).
# The pattern matches lines of rospy's log, and Python's warnings.
LOGGED = matches(r"^(\x1b\[[\d;]*m)*\[|warn")

LATE = (
    "The service started 1 s after the program, but the program had already ended. Wait for the "
    "service with rospy.wait_for_service(name, timeout=3)."
)
PARAMETER = (
    'The field `patience` has a wrong value. Read the private parameter "~wait" of the node: '
    'rospy.get_param("~wait", 2.0).'
)
DEFAULT = (
    "If the parameter ~wait is not set, the field `patience` has to be 2 s. The second argument of "
    "rospy.get_param is this default value."
)
ONCE = "The program called the service more than once. Make only one call, and print its result."
ONCE_REFUSED = (
    "The service refused the call, and the program called the service again. Make only one call, and "
    "end the program if the service refuses this call."
)
NEVER = (
    "The program did not call the service. After rospy.init_node, call detect_customer; write no "
    "slash at the beginning of this name."
)
NO_END = (
    "The program called the service, but the program did not end. Remove rospy.spin(), because the "
    "program has nothing else to do."
)
SILENT = 'The program printed nothing. Print one line: "customer" or "nobody".'
FIELD = (
    '`found` was False, but the program printed "customer". Test the field `found`: in an if '
    "statement, a response object always counts as true."
)
OTHER_LINE = 'The program printed a wrong line. Print only the word "customer" or only the word "nobody".'
MORE_LINES = (
    "The program printed more than one line. Print only one line, because another program may read the "
    "output."
)
STATUS_0 = '"nobody" is a valid result, so the exit status has to be 0. In this case, do not call sys.exit.'
CATCH_REFUSAL = (
    "A refused call raises rospy.ServiceException. Catch this error, and end the program with "
    "sys.exit(str(error))."
)
NO_REASON = (
    "The output does not contain the reason for the failure. Print the text of the rospy.ServiceException."
)
STATUS_1 = (
    "The call failed, so the exit status has to be 1. Call sys.exit(TEXT), which prints the text "
    "and sets this exit status."
)
ENDED = (
    "The service ended during the call. The text of this rospy.ServiceException differs from the text of a "
    "refusal, so print the whole text without a traceback, and end with exit status 1."
)
FOREVER = (
    "The service does not exist, and the program waited for more than 3 s. Call "
    "rospy.wait_for_service with timeout=3."
)
CATCH_TIMEOUT = (
    "After its timeout, rospy.wait_for_service raises rospy.ROSException. Catch this error and print a "
    "message."
)
NO_WORD = (
    "The service does not exist, and the program ended without a message. Print the reason before the "
    "program ends."
)
ASKED = 'Wait for detect_customer, call it once, and print "customer" or "nobody".'


@part(
    "15.4",
    points=2,
    goal=(
        "Write ask_customer.py: wait up to 3 s for detect_customer, call it once, and print "
        '"customer" or "nobody".'
    ),
    needs=[f"file:{file_of(NAME)}"],
    deadline=60.0,
    start=start_of(NAME),
    goals={
        ASKED: 3,
        "End with exit status 1 if the service refuses the call, or if the service does not exist.": 1,
    },
)
def the_client(context: CheckContext) -> None:
    """Run the program: the service starts late, responds, refuses, ends during a call, or does not exist."""
    package = examined(context, NAME)
    with ExitStack() as ending:
        detector = _Detector(round(context.random.integer(3, 30) + context.random.number(0.2, 0.8), 1))
        usual = _Detector(detector.wait)
        early, default, refused, broken, alone = (
            Run(context, package, ending, given)
            for given in ({"wait": detector.wait}, {}, {"wait": REFUSED}, {"wait": 1.0}, {"wait": 1.0})
        )
        for run in (default, refused):
            context.serve(f"{run.space}/{DETECT}", AWAIT, usual.answer)
        context.serve(f"{broken.space}/{DETECT}", AWAIT, lambda _: HangUp())
        early.is_on_the_graph()
        wait_until(early.has_ended, SOON)
        _waits(context, early)
        context.serve(f"{early.space}/{DETECT}", AWAIT, detector.answer)
        _calls(context, early.end(), detector)
        _finds_nobody(context, default.end(), usual)
        context.fulfilled(ASKED)
        _is_refused(context, refused.end(), usual)
        _notices_the_end(context, broken.end())
        waited = alone.end(LIMIT + 2.0).took - min(run.took for run in (default, refused, broken))
        for _ in range(ATTEMPTS):
            if alone.status is None or waited < LIMIT + EXTRA:
                break
            alone, waited = _without_service(context, package, ending)
        _gives_up(context, alone, waited)


class Run:
    """One run of the program in a separate namespace."""

    def __init__(
        self, context: CheckContext, package: BuiltPackage, ending: ExitStack, given: dict[str, float]
    ) -> None:
        self.space = f"/{context.random.word()}"
        self.status: int | None = None
        self.out = ""
        self.took = 0.0  # `took` is the time in s for which the program ran.
        self._context = context
        self._running: Running = ending.enter_context(started(package, NAME, self.space, [DETECT], given))

    def has_ended(self) -> bool:
        """Return whether the program has ended by itself."""
        return self._running.status is not None

    def is_on_the_graph(self) -> None:
        """Wait until the node is on the graph, or until the program has ended."""
        wait_until(
            lambda: (
                self.has_ended()
                or any(node.name.startswith(f"{self.space}/") for node in self._context.look().nodes)
            ),
            STARTING,
            0.1,
        )

    def end(self, within: float = ENDING) -> Run:
        """Wait until the program ends.

        `within` is the time limit in s, from the time when the node was on the graph. If the program still
        runs after this time, it is stopped, and `status` is None.
        """
        self.is_on_the_graph()
        wait_until(self.has_ended, within, 0.05)
        finished = self._running.stop()
        self.status, self.out, self.took = finished.status, finished.out, finished.took
        return self

    @property
    def lines(self) -> list[str]:
        """The lines that the program printed."""
        return [line.strip() for line in self.out.splitlines() if line.strip()]

    @property
    def found_no_service(self) -> bool:
        """Whether the program's output says that the service does not exist."""
        return "timeout exceeded" in self.out or "unavailable" in self.out

    @property
    def last(self) -> str:
        """The last line of the program's output, and how the program ended."""
        ended = "still running" if self.status is None else f"exit status {self.status}"
        return f"{self.lines[-1] if self.lines else 'no output'} ({ended})"


def _without_service(context: CheckContext, package: BuiltPackage, ending: ExitStack) -> tuple[Run, float]:
    """Run the program without a service; return this run, and the time in s for which the program waited.

    On a busy machine, the start and the end of a program take long. So the check also runs the program with a
    service, and subtracts the time of this second run.
    """
    alone, served = (Run(context, package, ending, {"wait": 1.0}) for _ in range(2))
    context.serve(f"{served.space}/{DETECT}", AWAIT, lambda _: {"found": True})
    took = served.end().took
    return alone.end(LIMIT + 2.0), alone.took - took


class _Detector:
    """A detector that finds a customer only if the request's `patience` is equal to the attribute `wait`.

    The detector refuses a call if `patience` is REFUSED.
    """

    def __init__(self, wait: float) -> None:
        self.wait = wait
        self.patiences: list[float] = []
        self.refused = 0

    def answer(self, request: AwaitCustomerRequest) -> Act:
        patience = round(request.patience, 3)
        if patience == REFUSED:
            self.refused += 1
            return Refuse(REASON)
        self.patiences.append(patience)
        return {"found": patience == self.wait}


def _waits(context: CheckContext, run: Run) -> None:
    if run.has_ended():
        run.end()
        unexplained = run.found_no_service or not run.out.strip()
        context.fail(
            "the program waits for a service that does not exist yet",
            expected="a program that is still running",
            actual=run.last,
            hint=LATE if unexplained else why_ended(program(NAME), run.out),
        )
    context.require("the program waits for a service that does not exist yet", holds=True)


def _calls(context: CheckContext, run: Run, detector: _Detector) -> None:
    calls = detector.patiences
    context.require(
        "the program calls the service once and ends",
        holds=run.status is not None and len(calls) == 1,
        expected="one call and an exit status",
        actual=f"{len(calls)} calls; {run.last}",
        hints=[
            (lambda _: not calls and run.found_no_service, LATE),
            (lambda _: not calls, NEVER),
            (lambda _: len(calls) > 1, ONCE),
            (ANYTHING, NO_END),
        ],
    )
    context.expect(
        "the field `patience` is the value of the parameter ~wait",
        expected=detector.wait,
        actual=calls[0],
        near=1e-3,
        hints=[
            (
                float(int(detector.wait)),
                "The value of ~wait was a fraction, but `patience` was a whole number. Send the "
                "value of the parameter without any change.",
            ),
            (ANYTHING, PARAMETER),
        ],
    )
    _prints(context, run, "customer")


def _finds_nobody(context: CheckContext, run: Run, detector: _Detector) -> None:
    context.expect(
        "without the parameter, the field `patience` is 2 s",
        expected=[2.0],
        actual=detector.patiences,
        near=1e-6,
        hints=DEFAULT,
    )
    _prints(context, run, "nobody")


def _prints(context: CheckContext, run: Run, word: str) -> None:
    words = [line for line in run.lines if line in ("customer", "nobody")]
    others = [line for line in run.lines if line not in words and not LOGGED.search(line)]
    wrong: Hints = [
        (lambda _: not run.lines, SILENT),
        (lambda _: word == "nobody" and words == ["customer"], FIELD),
        (lambda _: bool(words), MORE_LINES),
        (ANYTHING, OTHER_LINE),
    ]
    context.require(
        'the program prints only "customer" or "nobody"',
        holds=words == [word] and not others,
        expected=word,
        actual=" / ".join(run.lines[:3]) or "no output",
        hints=wrong,
    )
    context.expect("after a response, the exit status is 0", expected=0, actual=run.status, hints=STATUS_0)


def _is_refused(context: CheckContext, run: Run, detector: _Detector) -> None:
    context.require(
        "the program calls the service once and ends",
        holds=detector.refused <= 1,
        expected="one call, even if the service refuses it",
        actual=f"{detector.refused} calls; {run.last}",
        hints=ONCE_REFUSED,
    )
    context.require(
        "after a refused call, the program prints the reason, and its exit status is 1",
        holds=run.status == 1 and REASON in run.out and "Traceback" not in run.out,
        expected=f"{REASON} (exit status 1)",
        actual=run.last,
        hints=[
            (lambda _: "Traceback" in run.out, CATCH_REFUSAL),
            (lambda _: REASON not in run.out, NO_REASON),
            (ANYTHING, STATUS_1),
        ],
    )


def _notices_the_end(context: CheckContext, run: Run) -> None:
    context.require(
        "if the service ends during the call, the program prints a message, and its exit status is 1",
        holds=run.status == 1 and bool(run.lines) and "Traceback" not in run.out,
        expected="a message and exit status 1",
        actual=run.last,
        hints=ENDED,
    )


def _gives_up(context: CheckContext, run: Run, waited: float) -> None:
    context.require(
        "without a service, the program ends after 3 s with a message, and its exit status is 1",
        holds=run.status == 1 and bool(run.lines) and "Traceback" not in run.out and waited < LIMIT + EXTRA,
        expected="a message and exit status 1",
        actual=run.last,
        hints=[
            (lambda _: run.status is None or waited >= LIMIT + EXTRA, FOREVER),
            (lambda _: "Traceback" in run.out, CATCH_TIMEOUT),
            (lambda _: not run.lines, NO_WORD),
            (ANYTHING, STATUS_1),
        ],
    )
