"""Functions that several checks of chapter 06 use."""

from course_pkg.checking import CheckContext, Its
from course_pkg.checking.plain_values import Value

GEOMETRY = "course_pkg/geometry"

STOP_BUTTON = """
import signal
import threading


def interrupted(function, *args):
    over, main = threading.Event(), threading.get_ident()

    def stop(*_):
        if not over.is_set():
            raise KeyboardInterrupt

    def press():
        while not over.wait(0.3):  # repeatedly: an interrupt inside a destructor is lost
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
"""  # The kernel code interrupts the function in the same way as the Stop button.


def stops(context: CheckContext, function: str, *args: Value, catch: str) -> None:
    """Assert that an interrupt ends the student's function while the function waits.

    The student's function should catch only the error `catch`.

    If the student's function ends correctly, the report does not contain this assertion.
    """
    context.prepare(STOP_BUTTON)
    result = context.run("interrupted", Its(function), *args, worded=f"{function}()")
    if result.returned() != "interrupted":
        context.fail(
            f"the Stop button ends {function}()",
            expected="the function ends when you press the Stop button",
            actual="the function caught the KeyboardInterrupt",
            hint=(
                "The function catches the KeyboardInterrupt that the Stop button causes. Catch only "
                f"the exceptions that you expect: {catch}."
            ),
        )


def volumes(context: CheckContext, count: int) -> list[float]:
    """Return volumes that a float32 stores exactly.

    The volumes have many digits after the point, so that a result rounded to three decimals is wrong.
    """
    return [whole + 683 / 2**16 for whole in context.random.integers(count, 10, 200)]
