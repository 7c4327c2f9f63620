"""03.2: a function that greets each customer on a topic once, in the right order."""

from __future__ import annotations

import threading
import time

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.peers.subscription import Subscription
from course_pkg.checking.placed import remote
from course_pkg.checking.plain_values import Value

NUMBER = "std_msgs/UInt32"
GREETING = 0.2  # GREETING is the duration of say_good_day() in s.
REPEATS = 3  # During one greeting, the check publishes the numbers of earlier customers this many times.
EAR = """
class Ear:
    def __init__(self):
        self.names, self.say = {}, None

    def __call__(self, number):
        checked_greetings.begin(number if isinstance(number, int) else type(number).__name__)
        try:
            return self.say(number)
        finally:
            checked_greetings.end()


ear = Ear()


def begin(start, *topics):
    names = getattr(start, "__globals__", {})
    if names.get("say_good_day") not in (None, ear):
        ear.say = names["say_good_day"]
        ear.names = {name: names for name, value in names.items() if value is ear.say}
        names.update(dict.fromkeys(ear.names, ear))
    return start(*topics)


def end():
    for name, names in ear.names.items():
        names[name] = ear.say
"""  # This code records each call of say_good_day(); the topic does not show whether two calls overlap.
MIXED_UP = (
    "Your function publishes on `customers`, which is the wrong topic. Subscribe to `customers`, "
    "and publish on `greetings`."
)
TOO_LATE = (
    "The first greeting is lost, because no publisher exists before the first customer comes. "
    "Create the publisher in start_greeting(), not in the callback."
)
LOST = (
    "Some messages arrived during a greeting and were lost. Create the subscriber without "
    "queue_size: a small queue_size drops messages."
)


class Greetings:
    """Records the calls of say_good_day(), and the maximum number of simultaneous calls."""

    def __init__(self) -> None:
        # `said` contains the argument of each call of say_good_day(), or the argument's type if it is not a
        # number.
        self.said: list[Value] = []
        self.at_once = 0
        self.shortest = float("inf")  # This is the duration of the shortest call in s.
        self._busy = 0
        self._began = 0.0
        self._lock = threading.Lock()

    @remote
    def begin(self, number: Value) -> None:
        """Record the beginning of a greeting."""
        with self._lock:
            self.said.append(number)
            self._busy += 1
            self._began = time.monotonic()
            self.at_once = max(self.at_once, self._busy)

    @remote
    def end(self) -> None:
        """Record the end of a greeting."""
        with self._lock:
            self._busy -= 1
            self.shortest = min(self.shortest, time.monotonic() - self._began)


GREETED = (
    "Greet each of five customers once, in the order of the messages. After each greeting, publish "
    "the customer's number."
)


@part(
    "03.2",
    points=2,
    goal=(
        "Receive the numbers of customers from a topic. Greet each customer once, in the order of the "
        "messages."
    ),
    needs=["start_greeting"],
    deadline=30.0,
    goals={
        GREETED: 3,
        (
            "Also greet customers who come after a pause, and customers who come after a second call of "
            "start_greeting()."
        ): 1,
    },
)
def greet_everyone(context: CheckContext) -> None:
    """Publish the numbers of five customers quickly; publish two of these numbers twice.

    Later, publish the number of a new customer, repeat the numbers of earlier customers during this greeting,
    and publish the number of another new customer before most of these repetitions.
    """
    customers, greetings = (f"/{context.random.word()}" for _ in range(2))
    numbers = context.random.integers(7, 10, 9000)
    subscription = context.subscribe(greetings, NUMBER)
    said = Greetings()
    context.place("checked_greetings", said)
    context.prepare(EAR)
    try:
        _greets(context, said, subscription, customers, greetings, numbers)
    finally:
        context.run("end", worded="start_greeting()")


def _greets(
    context: CheckContext,
    said: Greetings,
    subscription: Subscription,
    customers: str,
    greetings: str,
    numbers: list[int],
) -> None:
    if numbers[2] > max(numbers[:2]):
        # The check publishes numbers[2] last, so a subscriber with queue_size=1 receives this number. An
        # earlier number must be larger, so that a node that stores only the largest number ignores
        # numbers[2]. The check can then distinguish these two mistakes.
        numbers[0], numbers[2] = numbers[2], numbers[0]
    first, later = numbers[:5], numbers[5:]
    start, call = Its("start_greeting"), "start_greeting()"
    context.run("begin", start, customers, greetings, hints=_NO_RETURN, worded=call).returned()
    mixed_up = any(topic.name == customers and topic.publishers for topic in context.look().topics)
    subscription.published(hints=[(matches("no publisher"), MIXED_UP if mixed_up else TOO_LATE)])
    sent = _told(context, customers, [*first[:2], first[0], *first[2:], first[2]])
    _greeted(context, said, subscription, first)
    context.require(
        "the number is published after the greeting",
        holds=subscription.arrivals[0].at - sent > 0.75 * GREETING,
        expected=(
            f"a message about {GREETING:g} s after the customer's message, because say_good_day() "
            "takes that time"
        ),
        actual="a message before that time",
        hints=(
            "Your cell replaces say_good_day() by another function, so the customer was not greeted. Delete "
            "your own definition of this function."
        )
        if said.shortest < 0.5 * GREETING
        else (
            "The number was published before the greeting had ended. First call "
            "say_good_day(number), and then publish the number."
        ),
    )
    context.fulfilled(GREETED)
    # A subscriber that stores only ten messages during a greeting loses the number later[1].
    _told(context, customers, [later[0], later[1], *first * REPEATS], every=0.002)
    _greeted(context, said, subscription, numbers)
    context.require(
        "no customer is lost",
        holds=set(map(str, numbers)) <= set(map(str, said.said)),
        expected=f"a call of say_good_day() for each of {numbers}",
        actual=f"calls for {said.said}",
        hints=(
            "The number was published, but the customer was not greeted. Call say_good_day(number) "
            "for every customer."
        ),
    )
    _starts_again(context, first[0])


def _starts_again(context: CheckContext, number: int) -> None:
    """Call start_greeting() again with other topics.

    The second call must also greet a customer whom the first call has already greeted.
    """
    customers, greetings = (f"/{context.random.word()}" for _ in range(2))
    subscription = context.subscribe(greetings, NUMBER)
    context.run(
        "begin", Its("start_greeting"), customers, greetings, worded="start_greeting()", hints=_NO_RETURN
    ).returned()
    subscription.published(hints=[(matches("no publisher"), TOO_LATE)])
    _told(context, customers, [number])
    subscription.wait(1, within=8.0)
    context.require(
        "no customer is lost",
        holds=subscription.count > 0,
        expected=f"a greeting for {number} after a second call of start_greeting()",
        actual="none",
        hints=(
            "After a second call of start_greeting(), a customer was not greeted. Create the "
            "set of greeted numbers in start_greeting(), so that each call has a new set."
        ),
    )


def _told(context: CheckContext, topic: str, numbers: list[int], every: float = 0.02) -> float:
    """Publish the numbers in `numbers`; the time between two messages is `every` s.

    Return the time of the first message (s, time.monotonic()).
    """
    publisher = context.publish(
        topic, NUMBER, [{"data": number} for number in numbers], every=every, once=True
    )
    context.require(
        "the topic in `customers` has a subscriber",
        holds=publisher.has_subscriber(3.0),
        expected=f"a subscriber of {topic}",
        actual="no subscriber",
        hints="No node subscribes to the topic whose name is in `customers`. Create the subscriber, and do "
        "not unregister the subscriber.",
    )
    publisher.finish(5.0)
    publisher.stop()
    return publisher.sent[0]


def _greeted(
    context: CheckContext, greetings: Greetings, subscription: Subscription, numbers: list[int]
) -> None:
    """Assert that each customer in `numbers` was greeted once, in the right order."""
    subscription.until(lambda arrivals: set(numbers) <= {each.fields["data"] for each in arrivals}, 8.0)
    # A wrong second greeting of a customer would arrive within this time in s.
    subscription.during(2 * GREETING + 0.2)
    seen = [each.fields["data"] for each in subscription.arrivals]
    said = [*greetings.said]
    context.require(
        "only customers are greeted",
        holds=set(seen) <= set(numbers),
        expected=f"numbers such as {numbers[:3]}",
        actual=seen,
        hints=(
            "Your function published a number that is not the number of a customer. Publish "
            "the field `data` of the message without any change."
        ),
    )
    context.require(
        "no customer is lost",
        holds=set(seen) == set(numbers),
        expected=f"greetings for {numbers}",
        actual=seen,
        hints=[
            (
                [],
                "No greeting was published. Look below the cell for an error message of the callback.",
            ),
            (
                [number for place, number in enumerate(numbers) if number == max(numbers[: place + 1])],
                "A customer was not greeted, because an earlier customer had a larger number. "
                "Store all greeted numbers, not only the largest number.",
            ),
            (ANYTHING, LOST),
        ],
    )
    context.require(
        "only customers are greeted",
        holds=set(map(str, said)) <= set(map(str, numbers)),
        expected=f"calls such as say_good_day({numbers[0]})",
        actual=f"say_good_day({said[0] if said else ''})",
        hints="say_good_day() needs the number, not the message. Pass the field `data` of the message.",
    )
    context.require(
        "no customer is greeted twice",
        holds=len(seen) == len(set(seen)) and len(said) == len(set(map(str, said))),
        expected=f"one greeting for each of {numbers}",
        actual=seen if len(seen) > len(set(seen)) else f"greetings for {', '.join(map(str, said))}",
        hints=(
            "A customer was greeted twice, because the number arrived a second time. Store the "
            "greeted numbers in a set."
        ),
    )
    assertion = "customers are greeted in the order of the messages"
    if greetings.at_once > 1:
        context.fail(
            assertion,
            expected="one greeting after the other",
            actual="two greetings at the same time",
            hint="Two greetings ran at the same time. Do not start a thread for each customer: "
            "greet the customer in the callback.",
        )
    context.expect(
        assertion,
        expected=numbers,
        actual=seen,
        hints=(
            "The order of the greetings is wrong. Greet one customer after the other, in the order "
            "of the messages."
        ),
    )


_NO_RETURN = [
    (
        matches("^(TimesUp|NothingHeard)"),
        "start_greeting() does not return. Create a subscriber with a callback, and return immediately: "
        "rospy calls the callback in another thread.",
    )
]
