"""Checks of the student's class Watch, which finds out whether a stream is running or has ended."""

import time

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.result import Result
from course_pkg.waiting import at_this_load, wait_until

KEEPER = """
watches = {}


def begin(kind, topic):
    watches[topic] = kind(topic)


def state(topic):
    return watches[topic].state()


def end():
    for watch in watches.values():
        for value in vars(watch).values():
            if hasattr(value, "unregister"):
                value.unregister()
    watches.clear()
"""
WORDS = ("waiting", "running", "ended")
LIMIT = 1.0  # After this time in s without a message, a stream counts as ended.
AT_ONCE = 0.25  # The fastest of several calls may take at most this time in s.
TOO_EARLY = (
    'Less than a second has passed since the last message. Return "ended" only after a second without a '
    "message."
)
RUNS = 'Return "waiting" before the first message, and "running" while messages arrive.'


@part(
    "02.5",
    points=2,
    goal='Return immediately whether a stream is "waiting", "running" or "ended".',
    needs=["Watch"],
    deadline=40.0,
    goals=[RUNS, 'Return "ended" when no message has arrived for more than 1 s.'],
)
def watch_a_stream(context: CheckContext) -> None:
    """Call state() of one Watch object before, during and after a stream of messages.

    Call state() of another Watch object only during a stream.
    """
    topic, unasked = (f"/{context.random.word()}" for _ in range(2))
    context.prepare(KEEPER)
    try:
        for name in (topic, unasked):
            context.run("begin", Its("Watch"), name, worded="Watch(topic)", hints=_RETURNS).returned()
        times = context.random.integer(3, 6)
        _says(
            context,
            topic,
            'before the first message, the state is "waiting"',
            "waiting",
            _BEFORE,
            times=times,
        )
        time.sleep(1.3)
        _says(context, topic, 'before the first message, the state is "waiting"', "waiting", _BEFORE)
        publisher = _speaks(context, unasked)
        # After six published messages, the student's Watch object has received some messages.
        wait_until(lambda: len(publisher.sent) > 5, 5.0)
        _says(
            context,
            unasked,
            "the Watch object receives messages before the first call of state()",
            "running",
            _UNASKED,
        )
        _says(context, topic, "two Watch objects are independent of each other", "waiting", _APART)
        _runs(context, topic)
        again = _speaks(context, topic)
        time.sleep(0.5)
        _says(context, topic, 'when messages arrive again, the state is "running" again', "running", _WHILE)
        again.stop()
        _ends(context, topic, again, _SECOND_END)
    finally:
        context.run("end")


def _speaks(context: CheckContext, topic: str, number: int = 7) -> Publisher:
    """Publish ten messages per second on the topic that the student's Watch object observes."""
    publisher = context.publish(topic, "std_msgs/UInt32", [{"data": number}], every=0.1)
    publisher.listened(hints="In `__init__`, create a rospy.Subscriber of type UInt32 for the topic.")
    return publisher


def _runs(context: CheckContext, topic: str) -> None:
    """Publish messages for some time, and then publish nothing; the publisher stays registered."""
    publisher = _speaks(context, topic, number=0)
    time.sleep(0.5)
    assertion = 'while messages arrive, the state is "running"'
    _says(context, topic, assertion, "running", _WHILE, times=context.random.integer(5, 9), pause=0.06)
    time.sleep(1.0)
    _says(context, topic, assertion, "running", _WHILE)
    context.fulfilled(RUNS)
    publisher.stop()
    end = publisher.sent[-1] + LIMIT
    time.sleep(0.5)
    _says(
        context,
        topic,
        '0.5 s after the last message, the state is "running"',
        "running",
        _PAUSE,
        times=2,
        before=end,
    )
    time.sleep(max(end - 0.1 - time.monotonic(), 0.0))
    answer = _asked(context, topic).returned()
    if answer == "ended" and time.monotonic() < end:
        context.fail(
            'less than 1 s after the last message, the state is "running"',
            expected="running",
            actual="ended",
            hint=TOO_EARLY,
        )
    _ends(context, topic, publisher, _END)


def _ends(context: CheckContext, topic: str, publisher: Publisher, hints: Hints) -> None:
    """Assert that the state is "ended" after the publisher has published nothing for more than 1 s."""
    end = publisher.sent[-1] + LIMIT
    time.sleep(max(end + 0.1 - time.monotonic(), 0.0))
    # On a busy machine, the student's Watch object may receive the last message late, so the check waits
    # until the state changes.
    wait_until(lambda: _asked(context, topic).returned() != "running", at_this_load(0.1))
    ended = 'more than 1 s after the last message, the state is "ended"'
    _says(context, topic, ended, "ended", hints, times=context.random.integer(3, 6))


def _asked(context: CheckContext, topic: str) -> Result:
    return context.run("state", topic, worded="Watch(topic).state()", hints=_RETURNS)


def _says(
    context: CheckContext,
    topic: str,
    assertion: str,
    word: str,
    hints: Hints,
    *,
    times: int = 1,
    pause: float = 0.0,
    before: float = float("inf"),
) -> None:
    """Call state(), once or several times (`times`), and assert that each call returns `word`.

    After each call, the check waits `pause` s. `before` is a deadline (s, time.monotonic()). If a call ends
    after this deadline, the check accepts any of the three states. If there are several calls, at least one
    must be fast; the other calls may be slow, because the machine may be busy.
    """
    took = []
    for _ in range(times):
        asked = _asked(context, topic)
        in_time = time.monotonic() < before
        answer = asked.returned()
        context.require(
            "state() returns one of the three strings",
            holds=answer in WORDS,
            expected="waiting, running or ended",
            actual=answer,
            hints=_NO_WORD,
        )
        context.expect(assertion, expected=word if in_time else answer, actual=answer, hints=hints)
        took.append(asked.took)
        time.sleep(pause)
    context.require(
        "state() returns immediately",
        holds=times == 1 or min(took) < AT_ONCE,
        expected="an immediate result",
        actual=f"a result after {min(took):.1f} s",
        hints=(
            "Do not wait for a message in state(). In the callback, store the time at which "
            "each message arrives."
        ),
    )


_NO_WORD: Hints = [
    (None, NO_RETURN),
    (
        matches("waiting|running|ended"),
        "The spelling of the string is wrong. Write the string in small letters, exactly as in the exercise.",
    ),
    (
        ANYTHING,
        'state() did not return one of the three strings in the exercise. Return "waiting", '
        '"running" or "ended".',
    ),
]
_RETURNS = [
    (
        matches("TimesUp"),
        "state() waits for a message. Use a subscriber with a callback that stores the time at "
        "which a message arrives.",
    ),
    (
        matches("TypeError.*NoneType"),
        (
            "Before the first message, no time is stored, so your comparison raises an exception. "
            "Test for this case first."
        ),
    ),
]
_BEFORE: Hints = [
    ("running", 'No message has arrived yet. Return "waiting", not "running".'),
    ("ended", 'No message has arrived yet, so the stream cannot have ended. Return "waiting".'),
]
_UNASKED: Hints = [
    (
        ANYTHING,
        "Messages arrived before the first call of state(). Subscribe in `__init__`, and store "
        "in `self` that a message has arrived.",
    ),
]
_APART: Hints = [
    (
        ANYTHING,
        "Another Watch object received messages, but this Watch object received no message. Store the "
        "data of each Watch object in `self`, not in a global variable.",
    ),
]
_WHILE: Hints = [
    (
        "waiting",
        "Messages with the number 0 have arrived. Store the time at which a message arrives, not the "
        "number in the message.",
    ),
    (
        "ended",
        (
            "The last message arrived less than 1 s ago, so the stream has not ended. In each call of "
            "state(), use only the time of the newest message."
        ),
    ),
]
_PAUSE: Hints = [
    (
        "ended",
        TOO_EARLY,
    ),
]
_END: Hints = [
    (
        "running",
        "No message has arrived for more than 1 s. Compare the time since the last message with 1 s: "
        "do not round this time, and do not test whether a publisher is registered.",
    ),
    (
        "waiting",
        'Some messages have arrived, but no message arrives any more. Return "ended", not "waiting".',
    ),
]
_SECOND_END: Hints = [
    (
        ANYTHING,
        "The state was correct at the end of the first stream, but it is wrong at the end of the second "
        "stream. Find the end of every stream.",
    ),
]
