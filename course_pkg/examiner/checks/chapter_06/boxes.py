"""What the checks of several clients share."""

from course_pkg.examiner import Exam, Its
from course_pkg.examiner.plain import Plain

GEOMETRY = "course_pkg/geometry"
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."

STOP_BUTTON = """
import signal
import threading


def interrupted(function, *args):
    over, main = threading.Event(), threading.get_ident()

    def stop(*_):
        if not over.is_set():
            raise KeyboardInterrupt

    def press():
        while not over.wait(0.3):  # again, too: one that comes inside of a destructor gets lost
            signal.pthread_kill(main, signal.SIGUSR1)

    before = signal.signal(signal.SIGUSR1, stop)
    threading.Thread(target=press, daemon=True).start()
    try:
        return [function(*args)]
    except KeyboardInterrupt:
        return "interrupted"
    finally:
        over.set()
        signal.signal(signal.SIGUSR1, before)
"""  # what a student presses while a cell waits


def stops(exam: Exam, function: str, *args: Plain, catch: str) -> None:
    """Hold that an interrupt ends the student's function while it waits; `catch` is what it should catch.

    It is a rule only where it does not hold.
    """
    exam.prepare(STOP_BUTTON)
    outcome = exam.run("interrupted", Its(function), *args, worded=f"{function}()")
    if outcome.value != "interrupted":
        exam.fail(
            f"an interrupt ends {function}()",
            expected="its end, as by the Stop button",
            seen="it caught the KeyboardInterrupt, and went on",
            hint=f"A bare except: catches the Stop button, too. Name what can happen: except {catch}.",
        )


def volumes(exam: Exam, count: int) -> list[float]:
    """Return volumes that a float32 holds exactly, with a fraction, so that rounding shows."""
    return [whole + 0.375 for whole in exam.draw.integers(count, 1000, 9000)]
