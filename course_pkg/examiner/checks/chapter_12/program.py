"""12.10: a program that asks once, in whatever order things were started, and always ends."""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import Any

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.folder import Folder, Running
from course_pkg.examiner.scripted import Act, Refuse
from course_pkg.examiner.waiting import until
from course_pkg.graph.master import master_uri
from course_pkg.graph.rpc import MasterClient

FILE = "ask_customer.py"
AWAIT = "course_pkg/AwaitCustomer"
LIMIT = 3.0  # s that the program waits for the detector
MORE = 2.0  # s for a poll of rospy's, and for the program to end
AFTERWARDS = 1.0  # s after the program is on the graph, until the detector comes
STARTING = 15.0  # s for Python and rospy on a busy machine
ENDING = 8.0  # s for a program that has all it needs, or whose time is over
REFUSED = 55.0  # s of patience that are refused

LOGGED = says(r"^(\x1b\[[\d;]*m)*\[|warn")  # lines of rospy's log, and warnings of Python's

START = f"""%%writefile {FILE}
..."""
REASON = "the camera has said nothing for 1 s"
LATE = (
    "The detector came a moment after the program, which had ended by then. Programs are started in any "
    "order: rospy.wait_for_service(name, timeout=3) waits for it."
)
SHORT = "It waited for less than 3 s, or for another name than /detect_customer."
STATUS = "The exit status that says that it did not work is 1 here: sys.exit(words) makes it so."
FIXED = 'The wait is a parameter of the node, and private: rospy.get_param("~wait", 2.0).'


@part(
    "12.10",
    points=3,
    goal="Write ask_customer.py: it waits for the detector, but not for ever, asks once, and ends.",
    needs=[f"file:{FILE}"],
    deadline=60.0,
    start=START,
)
def a_program(exam: Exam) -> None:
    """Start it before its detector, with one that is there and finds nobody or refuses, and with none."""
    folder = exam.folder(files=[FILE])
    with ExitStack() as ending:
        runs = _Runs(exam, folder, ending)
        alone = runs.begin(f"/{exam.draw.word()}")
        detector = _Detector(f"/{exam.draw.word()}", exam.draw.number(3.0, 30.0, digits=1))
        early = runs.begin(detector.name, detector.wait)
        runs.await_node(alone)
        given_up = time.monotonic() + LIMIT + MORE
        runs.await_node(early)
        until(early.ended, AFTERWARDS)
        _waits(exam, early)
        exam.serve(detector.name, AWAIT, detector.answer)
        _asks(exam, early.end(), detector)
        later, refused = runs.begin(detector.name), runs.begin(detector.name, REFUSED)
        _finds_nobody(exam, later.end(), detector)
        _is_refused(exam, refused.end())
        if not until(alone.ended, given_up - time.monotonic()):  # perhaps the machine was busy: once more
            alone = runs.begin(f"/{exam.draw.word()}")
            runs.await_node(alone)
            until(alone.ended, LIMIT + MORE)
        _gives_up(exam, alone.end(0.0))


class _Detector:
    """Finds somebody for a patience of `wait`, nobody for any other, and refuses one of them."""

    def __init__(self, name: str, wait: float) -> None:
        self.name, self.wait = name, wait
        self.asked: list[float] = []

    def answer(self, request: Any) -> Act:  # noqa: ANN401 -- a class that catkin generates
        patience = round(request.patience, 3)
        self.asked.append(patience)
        return Refuse(REASON) if patience == REFUSED else {"found": patience == self.wait}


class _Run:
    """The program, started once."""

    def __init__(self, node: str, running: Running) -> None:
        self.node = node
        self.status: int | None = None
        self.out = ""
        self._running = running

    def ended(self) -> bool:
        """Whether it has ended by itself."""
        return self._running.status is not None

    def end(self, within: float = ENDING) -> _Run:
        """Wait for its end, and then end it; its status is None where it went on."""
        until(self.ended, within)
        finished = self._running.stop()
        self.status, self.out = finished.status, finished.out
        return self

    @property
    def last(self) -> str:
        """What it printed last, and how it ended."""
        lines = [line.strip() for line in self.out.splitlines() if line.strip()]
        ended = "still runs" if self.status is None else f"exit status {self.status}"
        return f"{lines[-1] if lines else 'not a word'} ({ended})"


class _Runs:
    """Starts the program, each time under a name of its own."""

    def __init__(self, exam: Exam, folder: Folder, ending: ExitStack) -> None:
        self._exam, self._folder, self._ending = exam, folder, ending

    def begin(self, service: str, wait: float | None = None) -> _Run:
        """Start it with `service` for /detect_customer, and with `_wait:=` where there is a wait."""
        node = self._exam.draw.word()
        given = [] if wait is None else [f"_wait:={wait}"]
        words = f"python3 {FILE} {' '.join(given)}".strip()
        line = ["python", FILE, f"/detect_customer:={service}", f"__name:={node}", *given]
        if given:
            self._ending.callback(_forget, f"/{node}/wait")
        running = self._ending.enter_context(self._folder.start(*line, worded=words))
        return _Run(f"/{node}", running)

    def await_node(self, run: _Run) -> None:
        """Wait until it is a node, or has ended."""
        until(lambda: run.ended() or any(node.name == run.node for node in self._exam.look().nodes), STARTING)


def _waits(exam: Exam, run: _Run) -> None:
    if not run.ended():
        exam.hold("started before its detector, it waits", holds=True)
        return
    run.end()
    exam.fail(
        "started before its detector, it waits",
        expected="a program that is still there",
        seen=run.last,
        hint=_why_ended(run.out),
    )


def _why_ended(printed: str) -> str:
    for pattern, hint in (
        ("KeyError|is not set", FIXED),
        (
            "SyntaxError|NameError|ImportError|ModuleNotFound|AttributeError|TypeError",
            f"It stumbled: run it yourself, and read the last line first: !python3 {FILE}",
        ),
        ("timeout exceeded", SHORT),
    ):
        if says(pattern).search(printed):
            return hint
    return LATE


def _asks(exam: Exam, run: _Run, detector: _Detector) -> None:
    exam.hold(
        "when the detector comes, it asks once and ends",
        run.status is not None and len(detector.asked) == 1,
        expected="one question, and the end",
        seen=f"{len(detector.asked)} questions; {run.last}",
        hints=[
            ((lambda _: not detector.asked and "unavailable" in run.out), LATE),
            ((lambda _: not detector.asked and f"service {detector.name}" in run.out), SHORT),
            (
                (lambda _: not detector.asked),
                "It never asked. Is the name /detect_customer, and was "
                "rospy.init_node called before everything else?",
            ),
            ((lambda _: len(detector.asked) > 1), "It asked more than once. This program asks once."),
            (says(""), "It asked, and went on: nothing is left to do, so no rospy.spin() at the end."),
        ],
    )
    exam.expect(
        "its patience is the parameter: _wait:=…",
        expected=detector.wait,
        seen=detector.asked[0],
        near=1e-3,
        hints=FIXED,
    )
    _printed(exam, run, "customer")


def _finds_nobody(exam: Exam, run: _Run, detector: _Detector) -> None:
    others = [patience for patience in detector.asked[1:] if patience != REFUSED]
    exam.hold(
        "without the parameter its patience is 2 s",
        others == [2.0],
        expected="a question with a patience of 2 s",
        seen=_told(others) or run.last,
        hints={
            says(r"\d questions"): "It asked more than once. This program asks once, whatever the answer is.",
            says("a patience"): 'Where nobody sets it, it is 2 s: rospy.get_param("~wait", 2.0).',
            says(
                "KeyError"
            ): "Nobody had set the parameter, and it has no default: rospy.get_param(name, default).",
            says(""): FIXED,
        },
    )
    _printed(exam, run, "nobody")


def _told(patiences: list[float]) -> str:
    """Word the questions that came."""
    if len(patiences) > 1:
        return f"{len(patiences)} questions"
    return f"a patience of {patiences[0]:g} s" if patiences else ""


def _printed(exam: Exam, run: _Run, word: str) -> None:
    lines = [line.strip() for line in run.out.splitlines() if line.strip()]
    words = set(lines) & {"customer", "nobody"}
    others = [line for line in lines if line not in words and not LOGGED.search(line)]
    exam.hold(
        "it prints what it was told: customer, or nobody",
        words == {word},
        expected=word,
        seen=run.last,
        hints={
            (lambda _: not run.out.strip()): f"It printed nothing. The line is {word}: print(…).",
            (
                lambda _: word == "nobody" and "customer" in words
            ): "Nobody was found, and it prints customer. A "
            "response counts as true whatever is in it: look at its found.",
            says(""): f"The line has nothing but the word {word} in it: print(…).",
        },
    )
    if others and run.status == 0:
        exam.fail(
            "it prints one line, and nothing else",
            expected=word,
            seen=" / ".join(lines[:3]),
            hint="Whoever reads the output of this program expects one line. Take the other print(…) out.",
        )
    exam.expect(
        "an answer is a success: exit status 0",
        expected=0,
        seen=run.status,
        hints="Nobody is an answer, too. Another status than 0 says that it did not work.",
    )


def _is_refused(exam: Exam, run: _Run) -> None:
    exam.hold(
        "a refusal is told in its own words, with exit status 1",
        run.status == 1 and REASON in run.out and "Traceback" not in run.out,
        expected=f"{REASON} (exit status 1)",
        seen=run.last,
        hints=[
            (
                (lambda _: "Traceback" in run.out),
                "Whoever runs it reads a traceback, as of a slip in your "
                "program. Catch rospy.ServiceException, and print its words: sys.exit(str(error)).",
            ),
            ((lambda _: REASON not in run.out), "Nobody reads why: print the words of the ServiceException."),
            ((lambda _: run.status), STATUS),
            (
                says(""),
                "Whoever started it looks at the exit status, and 0 says that all is well: sys.exit(…).",
            ),
        ],
    )


def _gives_up(exam: Exam, run: _Run) -> None:
    exam.hold(
        "without a detector it gives up after 3 s, in words and with exit status 1",
        run.status == 1 and bool(run.out.strip()) and "Traceback" not in run.out,
        expected="a line that says so (exit status 1)",
        seen=run.last,
        hints=[
            (
                (lambda _: run.status is None),
                "It still waited for a detector that never comes. Give the wait "
                "its limit: rospy.wait_for_service(name, timeout=3).",
            ),
            (
                (lambda _: "Traceback" in run.out),
                "The wait ended in a traceback: it raises a ROSException, which "
                "is no ServiceException. Catch that one, too.",
            ),
            (
                (lambda _: not run.out.strip()),
                "Nobody reads why it ended: print a line that says so. sys.exit(words) does both.",
            ),
            ((lambda _: run.status), STATUS),
            (
                says(""),
                "Nobody was there, and the exit status says that all is well: sys.exit(words) makes it 1.",
            ),
        ],
    )


def _forget(parameter: str) -> None:
    """Take the parameter of a program that has ended from the master, which would keep it."""
    MasterClient(master_uri()).delete_param(parameter)
