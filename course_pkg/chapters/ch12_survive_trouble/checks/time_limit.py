"""12.1: a function that calls a service with a time limit."""

from __future__ import annotations

import threading

from course_pkg.checking import ANYTHING, CheckContext, HangUp, Its, Late, Refuse, Silence, matches, part
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.kernel.unchanged_clock import UNCHANGED_CLOCK
from course_pkg.checking.peers.scripted_server import Act
from course_pkg.checking.plain_values import Message
from course_pkg.checking.result import Result

ADD = "course_pkg/AddTwoInts"
LIMIT = 0.8  # LIMIT is the time in s for which the student's function may wait.
LONG = 4.0  # This time limit in s is longer than the duration of every call.
# With this time limit in s, a function that polls only ten times during a call returns the response too late.
VERY_LONG = 25.0
HELD = 10.0  # The server delays a response by at most this time in s.
WORK = 0.3  # WORK is the duration of a slow handler in s.
# The fastest of several calls must return within this time in s after the response.
PROMPT = 0.35
MEASURED = 5  # The check measures the time after a response in at most this many calls.
SLACK = 1.2  # SLACK is the additional time in s that a call may take on a busy machine.
KERNEL_CODE = (
    UNCHANGED_CLOCK
    + """
import threading

import rospy
from course_pkg.srv import AddTwoInts


def waits_for():
    # At the end of a program, Python 3.11 waits for the threads whose locks are in _shutdown_locks.
    return {*getattr(threading, "_shutdown_locks", ())}


class CheckedCall:
    def call(self, function, name, seconds, a, b):
        waits, began = waits_for(), clock.process_time()
        threads = [*threading._active.values()]  # A student can replace the function enumerate().
        try:
            response = function(seconds, rospy.ServiceProxy(name, AddTwoInts), a, b)
        finally:
            self.busy = clock.process_time() - began  # s of processor time
            new = [thread for thread in threading._active.copy().values() if thread not in threads]
            self.daemon = all(thread.daemon for thread in new) and waits_for() <= waits
        return None if response is None else [response.sum]


checked_call = CheckedCall()
"""
)
ABANDONED = (1, 2)  # These numbers are in the requests of the calls that end with TimeoutError.
AGENT = 0.1  # In addition to the student's code, the kernel needs at most this CPU time (s) for a call.
BUSY = 0.2  # A loop without a sleep uses more than this CPU time (s) within LONG s.
ERRORS = [
    (
        matches("TimesUp"),
        (
            "The function did not return in time, because it still waits for the thread. Pass a timeout "
            "to join(), and do not use a thread pool in a `with` block."
        ),
    ),
    (
        matches("^TimeoutError"),
        (
            "The response came in time, but the function raised TimeoutError. Wait until the thread ends "
            "or the time limit is reached."
        ),
    ),
    (
        matches("no attribute 'sum'"),
        "The function did not return the response. Return the object that the proxy returned.",
    ),
]


class Held:
    """A response that the server sends only after release() was called."""

    def __init__(self) -> None:
        self._released = threading.Event()

    def release(self) -> None:
        """Allow the server to send the response."""
        self._released.set()

    def wait(self) -> None:
        """Wait until release() is called, but for at most `HELD` s."""
        self._released.wait(HELD)


class Adder:
    """Returns the sum of two numbers; if `act` is not None, the server executes `act` instead."""

    def __init__(self) -> None:
        self.act: Act | Held | None = None
        self.requests = 0

    def __call__(self, request: Message) -> Act:
        """Handle a request to the server."""
        self.requests += 1
        total = {"sum": request.a + request.b}
        if isinstance(self.act, Late):
            return Late(self.act.delay, total)
        if isinstance(self.act, Held):
            self.act.wait()
            return total
        return total if self.act is None else self.act


@part(
    "12.1",
    points=2,
    goal=(
        "Call a service with a time limit: return the response, raise the error of the "
        "call, or raise TimeoutError."
    ),
    needs=["call_within"],
    deadline=30.0,
)
def a_call_with_a_limit(context: CheckContext) -> None:
    """Call a server that responds, is slow, refuses, closes the connection, or does not respond."""
    name, adder = f"/{context.random.word()}", Adder()
    context.prepare(KERNEL_CODE)
    context.serve(name, ADD, adder)
    _responds(context, name, adder)
    _returns_immediately(context, name, adder)
    failures: list[Refuse | HangUp] = [Refuse(f"no {context.random.integer(100, 999)}"), HangUp()]
    for failure in context.random.shuffled(failures):
        adder.act = failure
        _passes_on(context, name, failure)
    _returns_no_late_response(context, name, adder)
    _in_a_random_order(context, name, adder)


def _returns_no_late_response(context: CheckContext, name: str, adder: Adder) -> None:
    """Let one call reach its time limit, send its late response, and make the next call.

    The next call must not return the late response.
    """
    adder.act = held = Held()
    _gives_up(context, name, LIMIT)
    held.release()
    adder.act = Late(WORK, {})
    _responds(context, name, adder)


def _in_a_random_order(context: CheckContext, name: str, adder: Adder) -> None:
    """Call a server that responds, refuses or does not respond, in a random order.

    The time limit is always the same, so the check detects a function that computes its result
    from the time limit.
    """
    responses, failures = context.random.integer(1, 3), context.random.integer(1, 2)
    acts: list[Act | None] = [None] * responses
    acts += [Refuse(f"no {context.random.integer(100, 999)}") for _ in range(failures)]
    for act in context.random.shuffled([*acts, Silence()]):
        adder.act = act
        if act is None:
            _responds(context, name, adder)
        elif isinstance(act, Refuse):
            _passes_on(context, name, act)
        else:
            _gives_up(context, name, LONG)


def _call(context: CheckContext, name: str, seconds: float, a: int, b: int) -> Result:
    function, worded = Its("call_within"), f"call_within({seconds:g}, proxy, a, b)"
    arguments = (function, name, seconds, a, b)
    return context.run(
        "checked_call.call", *arguments, within=seconds + 2 * SLACK, hints=ERRORS, worded=worded
    )


def _returns_immediately(context: CheckContext, name: str, adder: Adder) -> None:
    """Make a slow call several times, because the machine may be busy, and use the fastest call."""
    adder.act = Late(WORK, {})
    times = []
    for _ in range(MEASURED):
        times.append(_responds(context, name, adder, VERY_LONG))
        if times[-1] < WORK + PROMPT:
            break
    _is_prompt(context, min(times), WORK + PROMPT)


def _is_prompt(context: CheckContext, took: float, limit: float) -> None:
    context.require(
        "the function returns the response as soon as it arrives",
        holds=took < limit,
        expected="the function returns immediately",
        actual=f"the function returned after {took:.1f} s",
        hints=(
            "The function still waited after the response had arrived. Replace the sleep with "
            "join(seconds), which returns as soon as the thread has ended."
        ),
    )


def _responds(context: CheckContext, name: str, adder: Adder, limit: float = LONG) -> float:
    """Assert that the function returns the response; return its duration in s."""
    a, b = context.random.integers(2, 3, 1000)
    before = adder.requests
    result = _call(context, name, limit, a, b)
    label = "if a response comes in time, the function returns it"
    context.require(label, holds=not result.error, actual=result.error, hints=ERRORS)
    context.require(
        label,
        holds=result.returned() == [a + b],
        expected=f"a response with the sum {a + b}",
        actual=result.returned(),
        hints=[
            (None, NO_RETURN),
            (
                [sum(ABANDONED)],
                (
                    "The function returned the late response of an earlier call, which had ended with "
                    "TimeoutError. In each call of the function, create a new list or queue for the result."
                ),
            ),
            (ANYTHING, "The response belongs to a different request. Pass *values to the proxy."),
        ],
    )
    context.expect(
        "the service is called once",
        expected=1,
        actual=adder.requests - before,
        hints=(
            "The function called the service more than once. Make only one call, and make it in the thread."
        ),
    )
    _is_prompt(context, result.took, WORK + SLACK + 0.5)
    return result.took


def _passes_on(context: CheckContext, name: str, act: Act) -> None:
    result = _call(context, name, LONG, 1, 2)
    result.raised(
        "if the call raises an error, the function raises the same error",
        "ServiceException",
        saying=act.reason if isinstance(act, Refuse) else "",
        hints=[
            (
                matches("^TimeoutError"),
                (
                    "The call raised rospy.ServiceException, but the function raised TimeoutError. "
                    "Catch the error in the thread, store it, and raise it after join()."
                ),
            ),
            (
                matches("^(IndexError|UnboundLocalError|NameError|AttributeError|KeyError)"),
                (
                    "The call failed, so there is no response. Catch the error in the thread, store it, "
                    "and raise it after join()."
                ),
            ),
            (
                None,
                (
                    "The call raised rospy.ServiceException, but the function returned None. Raise the "
                    "same error in the function."
                ),
            ),
            (
                ANYTHING,
                "The function raised a different error. Raise the ServiceException of the call "
                "again, with the same text.",
            ),
        ],
    )


def _gives_up(context: CheckContext, name: str, limit: float) -> None:
    before = context.processor_time()
    result = _call(context, name, limit, *ABANDONED)
    used = context.processor_time() - before
    result.raised(
        "the function raises TimeoutError when the time is over",
        "TimeoutError",
        hints=[
            (None, "The time was over, but the function returned None. Raise TimeoutError."),
            (matches("^TimesUp"), ERRORS[0][1]),
            (
                matches("transport error"),
                (
                    "When the time was over, the function interrupted the call. Do not interrupt the call: "
                    "make it in a daemon thread, and wait for this thread with join(seconds)."
                ),
            ),
            (
                ANYTHING,
                (
                    "The function did not raise TimeoutError. Raise this error if the thread is still alive "
                    "when the time is over."
                ),
            ),
        ],
    )
    context.require(
        "the function waits until the time limit is reached",
        holds=limit - 0.1 < result.took < limit + SLACK,
        expected=f"TimeoutError after {limit:g} s",
        actual=f"the function ended after {result.took:.1f} s",
        hints="The function did not wait for the given time. Pass `seconds` to join().",
    )
    context.require(
        "the thread is a daemon thread",
        holds=context.read("checked_call.daemon", bool),
        expected="a daemon thread",
        actual="a thread that is not a daemon thread",
        hints=(
            "At the end of a program, Python waits for each thread that is not a daemon thread. Create the "
            "thread with daemon=True."
        ),
    )
    busy = max(context.read("checked_call.busy", float), used - AGENT)
    context.require(
        "the function needs almost no processor time while it waits",
        holds=busy < BUSY,
        expected="almost no processor time",
        actual=f"{busy:.1f} s of processor time in {limit:g} s",
        hints=(
            "The function uses the processor while it waits. Use join(seconds), which uses no processor "
            "time while it waits."
        ),
    )
