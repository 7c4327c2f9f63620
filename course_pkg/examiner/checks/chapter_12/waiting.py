"""12.3: waiting for somebody, and not for ever."""

from __future__ import annotations

from typing import Any

from course_pkg.examiner import Exam, Its, part, says

SLACK = 2.0  # s: a busy machine is no mistake
LATER = 0.4  # s until somebody comes
LONG = 4.0  # s of patience that must not run out
LOOKS = 2000  # more than one who pauses for a millisecond takes; without a pause it is many times that

# An eye that sees what the check's script says, with twenty good frames a second as long as it sees at all.
AN_EYE = """
import threading
import time


class Scripted:
    def __init__(self, script):
        self.changed = threading.Condition()
        self.looks = 0
        self.over = threading.Event()
        self._script = [(time.monotonic() + after, state) for after, state in script]
        self._state = None
        self._pulse = threading.Thread(target=self._stream, daemon=True)
        self._pulse.start()

    def look(self):
        self.looks += 1
        return self._state

    def _stream(self):
        while not self.over.wait(0.05):
            with self.changed:
                while self._script and self._script[0][0] <= time.monotonic():
                    self._state = self._script.pop(0)[1]
                if self._state is not None:
                    self.changed.notify_all()


def trial(wait, script, patience, callers):
    eye = Scripted(script)
    with eye.changed:
        eye._state = script[0][1]
    answers = [None] * callers

    def ask(number):
        started = time.monotonic()
        try:
            answer = {"value": wait(eye, patience), "error": ""}
        except Exception as error:
            answer = {"value": None, "error": f"{type(error).__name__}: {error}"}
        answers[number] = {**answer, "took": time.monotonic() - started}

    threads = [threading.Thread(target=ask, args=(number,), daemon=True) for number in range(callers)]
    for thread in threads:
        thread.start()
    end = time.monotonic() + patience + SLACK
    for thread in threads:
        thread.join(max(end - time.monotonic(), 0.01))
    looks = eye.looks
    eye.over.set()
    with eye.changed:
        eye._state = True
        eye.changed.notify_all()
    return {"answers": list(answers), "looks": looks}
"""
AT_ONCE = (
    "Somebody was there before the question. Look first, and wait only if nobody is: wait_for does both."
)
BUSY = (
    "A loop without a pause looks thousands of times a second. Let eye.changed.wait_for(...) wait: it sleeps "
    "until there is something to look at."
)
FOREVER = "It waits, and never gives up. Hand the patience on: wait_for(eye.look, timeout=patience)."
ANEW = (
    "Its time begins anew with each frame, and frames come all the time. Reckon with one end: "
    "time.monotonic() + patience; or let wait_for do it."
)
EARLY = (
    "The answer was no before the time was over. Each frame wakes up who waits: look again, and wait on; "
    "wait_for does that."
)
HELD = (
    "Somebody came, and could not be seen: it holds `changed` while it sleeps, and no frame gets in. "
    "changed.wait_for(...) lets go of it while it waits."
)
SILENT = (
    "look() was None, so nobody can tell, and False says that nobody is there. Raise CameraSilent when the "
    "time is over and look() is None."
)
UNHELD = "A condition is held while one waits at it: with eye.changed: ..."
STUMBLED = "That is an error, and neither an answer nor CameraSilent: run it yourself with an Eye."
CAME_BACK = (
    "The camera was silent for a while, and saw that nobody was there when the time was over. That look "
    "counts, and no earlier one."
)
CERTAIN = "look() was False: the camera saw that nobody is there, and that is the answer."
WRONG_ERROR = "Whoever asks catches CameraSilent, and no error of another type: raise CameraSilent(words)."
MAY_RETURN = "The camera came back in time, and somebody was there. Wait on while look() is None."


@part(
    "12.3",
    points=3,
    goal="Wait for a customer, and not longer than asked to, whatever the camera does.",
    needs=["await_customer"],
    deadline=45.0,
)
def a_bounded_wait(exam: Exam) -> None:
    """Have somebody, nobody, somebody who comes; a camera that dies or comes back; several at once."""
    exam.prepare(AN_EYE.replace("SLACK", str(SLACK)))
    _somebody(exam)
    _a_camera_that_dies(exam)
    _nobody(exam)
    _several(exam)


def _somebody(exam: Exam) -> None:
    answer = _ask(exam, [(0.0, True)], LONG)
    _found(exam, "one who is there is found at once", answer, 0.0, AT_ONCE)
    answer = _ask(exam, [(0.0, True)], 0.0)
    looked = "With no patience at all there is still time for a look."
    _found(exam, "one who is there is found by a look, too", answer, 0.0, looked)
    answer = _ask(exam, [(0.0, False), (LATER, True)], LONG)
    _found(
        exam, "one who comes is told of at once", answer, LATER, HELD if answer["took"] > LONG / 2 else EARLY
    )


def _nobody(exam: Exam) -> None:
    patience = exam.draw.number(0.5, 0.8)
    answer = _ask(exam, [(0.0, False)], patience)
    _in_time(exam, answer, patience, ANEW)
    exam.expect(
        "no customer, no detection",
        expected=False,
        seen=answer["error"] or answer["value"],
        hints=[
            (None, "It came to its end without a return: False, when nobody came."),
            (says("^CameraSilent"), CERTAIN),
            (says("Error"), STUMBLED),
        ],
    )
    exam.hold(
        "it waited as long as it was asked to",
        answer["took"] > patience - 0.1,
        expected=f"an answer after {patience:g} s",
        seen=f"an answer after {answer['took']:.1f} s",
        hints=EARLY,
    )
    exam.hold(
        "who waits leaves the processor alone",
        answer["looks"] < LOOKS,
        expected="a look for each frame",
        seen="thousands of looks",
        hints=BUSY,
    )
    answer = _ask(exam, [(0.0, None), (0.2, False)], 0.8)
    exam.expect(
        "no customer, no detection", expected=False, seen=answer["error"] or answer["value"], hints=CAME_BACK
    )


def _a_camera_that_dies(exam: Exam) -> None:
    answer = _ask(exam, [(0.0, False), (0.2, None)], 0.6)
    _in_time(exam, answer, 0.6, FOREVER)
    exam.hold(
        "a camera that dies meanwhile is no answer of no",
        answer["error"].startswith("CameraSilent"),
        expected="CameraSilent",
        seen=answer["error"] or answer["value"],
        hints=WRONG_ERROR if answer["error"] else SILENT,
    )
    answer = _ask(exam, [(0.0, None), (LATER, True)], LONG)
    _found(exam, "a camera that comes back in time is waited for", answer, LATER, MAY_RETURN)


def _several(exam: Exam) -> None:
    answers = _trial(exam, [(0.0, False), (LATER, True)], LONG, 4)["answers"]
    for answer in answers:
        hint = (
            "Four asked at the same time, and one customer came for all of them. Keep nothing between calls."
        )
        _found(exam, "several can wait side by side", answer or _UNANSWERED, LATER, hint)


_UNANSWERED = {"value": None, "error": "no answer", "took": 99.0}


def _ask(exam: Exam, script: list[tuple[float, bool | None]], patience: float) -> dict[str, Any]:
    found = _trial(exam, script, patience, 1)
    return {**(found["answers"][0] or _UNANSWERED), "looks": found["looks"]}


def _trial(
    exam: Exam, script: list[tuple[float, bool | None]], patience: float, callers: int
) -> dict[str, Any]:
    words = "await_customer(eye, patience)"  # the same whatever was drawn
    within = patience + 2 * SLACK + 2.0
    trial: dict[str, Any] = exam.run(
        "trial", Its("await_customer"), script, patience, callers, worded=words, within=within
    ).value
    return trial


def _in_time(exam: Exam, answer: dict[str, Any], patience: float, hint: str) -> None:
    exam.hold(
        "the answer comes when the patience is over",
        answer["error"] != "no answer",
        expected=f"an answer after {patience:g} s",
        seen=f"none {SLACK:g} s later",
        hints=hint,
    )


def _found(exam: Exam, rule: str, answer: dict[str, Any], after: float, hint: str) -> None:
    late = answer["took"] > after + SLACK
    exam.hold(
        rule,
        answer["value"] is True and not late,
        expected="True" + (f" {after:g} s after the question" if after else " at once"),
        seen=answer["error"] or f"{answer['value']} after {answer['took']:.1f} s",
        hints=[
            (says("un-acquired lock"), UNHELD),
            (says("^(?!CameraSilent)\\w+(Error|Exception):"), STUMBLED),
            (says(""), hint),
        ],
    )
