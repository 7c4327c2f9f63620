"""02.1: a function that publishes numbers at a fixed rate; each number must arrive."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise

from course_pkg.checking import CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.subscription import Arrival, Subscription, rate
from course_pkg.waiting import at_this_load, wait_until

WAITS_FOR_EVER = (
    "Wait at most 2 s for a subscriber. Then publish the numbers, even if the topic has no subscriber."
)
# In the second run, the check subscribes `LATER` s after the publisher exists. Then the first number has to
# arrive within `SOON_AFTER` s, and within `NOT_AFTER` s on a busy machine.
LATER, SOON_AFTER, NOT_AFTER = 0.8, 0.6, 0.9
# At a rate below `SLOW` Hz, at least a quarter of the pauses must be shorter than `PACE` times the period.
SLOW, PACE = 20, 1.15
# The check calls the student's function without a subscriber. The function waits 2 s for a subscriber, and
# then publishes numbers for about 1.1 s. When the publisher exists, the check waits `COMES` s, and then
# subscribes.
COMES, EARLIEST = 2.3, 2.7
NO_WAIT = 0.7  # A function that waits less than this time in s does not wait for a subscriber.
NO_NUMBERS = "If there is no subscriber, wait 2 s, and then publish all numbers at the given rate."
SOON = 4.0  # SOON is the maximum time in s until the publisher exists on a busy machine.
# In addition to the time for publishing the numbers, the student's function may take up to this time in s. A
# function that always sleeps for 2 s takes longer.
TOO_LONG = 1.9
TOO_SOON = "The wait for a subscriber is too short. If there is no subscriber, wait for the full 2 s."
TOO_EARLY = (
    "The first number was published before a subscriber was connected. Create the publisher, "
    "and then wait for a connection."
)
COUNTS = "Begin when a subscriber is connected, and publish all numbers at the given rate."


@part(
    "02.1",
    points=2,
    goal=(
        "Publish 0, 1, 2 and so on at a given rate. Begin when a subscriber is connected. If no "
        "subscriber connects, begin after 2 s."
    ),
    needs=["count_aloud"],
    deadline=40.0,
    goals={COUNTS: 3, "If no subscriber connects within 2 s, publish without a subscriber.": 1},
)
def count_aloud(context: CheckContext) -> None:
    """Run the student's function at two different rates, and then on a topic without a subscriber."""
    for hertz, count, later in (
        (context.random.integer(11, 15), context.random.integer(16, 18), 0.0),
        (context.random.integer(40, 60), 30, LATER),
    ):
        topic = f"/{context.random.word()}"
        with _subscriber(context, topic, later) as subscribed:
            counted = context.run("count_aloud", topic, hertz, count, within=6.0, hints=_slow(hertz))
        counted.returned()
        connected, subscription = subscribed[0]
        arrivals = subscription.wait(count + 1, within=0.5)
        subscription.published(
            hints=[(matches("no publisher"), "Create a rospy.Publisher for the given topic.")],
            within=0.5,
        )
        _counts(context, arrivals, count, TOO_SOON if later else TOO_EARLY)
        _keeps_time(context, arrivals, hertz)
        waited = counted.took - later
        delay = arrivals[0].at - connected
        context.require(
            "the function begins to publish as soon as a subscriber is connected",
            holds=waited < min(at_this_load(count / hertz + 1.2), count / hertz + TOO_LONG)
            and (not later or delay < min(at_this_load(SOON_AFTER), NOT_AFTER)),
            expected="the first number immediately after a subscriber is connected",
            actual=f"the first number after {delay:.1f} s"
            if later
            else f"the last number after {waited:.1f} s",
            hints=(
                "Check every few milliseconds whether a subscriber is connected. Begin to publish "
                "when the first subscriber is connected."
            ),
        )
    context.fulfilled(COUNTS)
    _counts_alone(context, f"/{context.random.word()}")


@contextmanager
def _subscriber(
    context: CheckContext, topic: str, later: float
) -> Iterator[list[tuple[float, Subscription]]]:
    """Subscribe to the topic immediately, or `later` s after its publisher exists if `later` is not 0.

    After the `with` block, the list contains the subscription and the time in s at which it began.
    """
    subscribed: list[tuple[float, Subscription]] = []

    def come() -> None:
        if later and wait_until(lambda: any(seen.name == topic for seen in context.look().topics), SOON):
            time.sleep(later)
        subscribed.append((time.monotonic(), context.subscribe(topic, "std_msgs/UInt32")))

    comes = threading.Thread(target=come)
    comes.start()
    if not later:
        comes.join()
    yield subscribed
    comes.join()
    if not subscribed:  # The master did not respond in time.
        subscribed.append((time.monotonic(), context.subscribe(topic, "std_msgs/UInt32")))


def _counts_alone(context: CheckContext, topic: str) -> None:
    """Start the student's function without a subscriber; subscribe after its wait of 2 s is over."""
    hertz = context.random.integer(15, 25)
    count = round(hertz * context.random.number(1.05, 1.15))
    with _subscriber(context, topic, COMES) as subscribed:
        alone = context.run(
            "count_aloud",
            topic,
            hertz,
            count,
            within=8.0,
            hints=[
                (matches("TimesUp"), WAITS_FOR_EVER),
                (
                    matches("^(?!TimesUp)"),
                    (
                        "The function raised an exception when the topic had no subscriber. Publish all "
                        "numbers in this case, too."
                    ),
                ),
            ],
        )
    alone.returned()
    context.require(
        "without a subscriber, the function begins to publish after 2 s",
        holds=EARLIEST < alone.took < 5.5,
        expected=f"a pause of 2 s, and then {count} numbers at {hertz} per second (about 3 s in total)",
        actual=f"the last number after {alone.took:.1f} s",
        hints=TOO_SOON
        if alone.took < count / hertz + NO_WAIT
        else NO_NUMBERS
        if alone.took < EARLIEST
        else WAITS_FOR_EVER,
    )
    numbers = _numbers_until(subscribed[0][1], count - 1)
    if not numbers or numbers != list(range(numbers[0], count)) or numbers[0] == 0:
        context.fail(
            "without a subscriber, the function begins to publish after 2 s",
            expected=(
                f"a subscriber that connects after {COMES} s receives the last numbers, up to {count - 1}"
            ),
            actual=str(numbers),
            hint=WAITS_FOR_EVER if numbers[:1] == [0] else NO_NUMBERS,
        )


def _numbers_until(subscription: Subscription, number: int) -> list[int]:
    """Return the received numbers; wait at most 0.5 s for the last number, which is `number`."""
    last = {"data": number}
    subscription.until(lambda arrivals: bool(arrivals) and arrivals[-1].fields == last, 0.5)
    return [arrival.fields["data"] for arrival in subscription.arrivals]


def _slow(hertz: int) -> Hints:
    return [
        (
            matches("TimesUp"),
            "The function takes too long. Wait only until a subscriber is connected, and then "
            f"publish {hertz} numbers per second with rospy.Rate.",
        ),
        (
            matches("must be unsigned integer"),
            "Publish each number as an int, not as a string or a float.",
        ),
    ]


def _counts(context: CheckContext, arrivals: list[Arrival], count: int, early: str) -> None:
    """Assert that the numbers from 0 to `count` - 1 arrived.

    `early` is the hint for a function that begins before a subscriber is connected.
    """
    numbers = [arrival.fields["data"] for arrival in arrivals]
    context.expect(
        "every number arrives once, in ascending order, beginning with 0",
        expected=list(range(count)),
        actual=numbers,
        hints=[
            (list(range(1, count)), early),
            (
                list(range(count - 1)),
                "The last number, `count - 1`, is missing. Publish this number, and wait a "
                "moment before the function returns.",
            ),
            (
                list(range(count + 1)),
                "The function published one additional number. The last number has to be `count - 1`.",
            ),
            (list(range(1, count + 1)), "The first number is 1. Begin the count with 0."),
            (
                lambda actual: actual and actual == list(range(len(actual))),
                "The last numbers are missing. Publish `count` numbers, and return after the last one.",
            ),
            ([], "No number arrived. Wait until a subscriber is connected, and then publish each number."),
            (lambda actual: actual == list(range(actual[0], count)), early),
            (
                lambda actual: len(set(actual)) < len(actual),
                "One number was published twice. Publish each number only once.",
            ),
            (
                lambda actual: actual == sorted(actual),
                (
                    "Some numbers in the middle are missing, because the queue of the publisher "
                    "was full. Pause after each number."
                ),
            ),
        ],
    )


def _keeps_time(context: CheckContext, arrivals: list[Arrival], hertz: int) -> None:
    """Assert that the average rate is right, and that the messages arrive at equal intervals."""
    seen = rate(arrivals)
    gaps = sorted(later.at - one.at for one, later in pairwise(arrivals))
    # A busy machine delays some numbers, but not all numbers. At a high rate, the delays may be too large for
    # this comparison.
    late = hertz < SLOW and gaps[len(gaps) // 4] > PACE / hertz
    # On a busy machine, each pause takes longer, so the rate may be lower. The limit is above half of the
    # required rate, because a wrong program with two pauses for each number publishes at half of this rate.
    lowest = max(0.75 / at_this_load(1.0), 0.55)
    context.require(
        "the average rate is the given rate",
        holds=lowest * hertz < seen < 1.25 * hertz and not late,
        expected=f"about {hertz} per second",
        actual=f"{seen:.3g} per second",
        hints="The rate is too high. Pause after each number."
        if seen > hertz
        else "The rate is too low. Use rospy.Rate(rate), and call sleep() only once for each number.",
    )
    context.require(
        "the numbers are evenly spaced",
        holds=gaps[len(gaps) // 2] > 0.88 / hertz,
        expected=f"about {1000 / hertz:.0f} ms between two numbers",
        actual=f"less than {1000 * gaps[len(gaps) // 2]:.0f} ms between most numbers",
        hints="The numbers arrive in groups. Pause after each number, not after several numbers."
        if gaps[len(gaps) // 2] < 0.5 / hertz
        else "The pauses between the numbers are too short. Use rospy.Rate(rate).",
    )
