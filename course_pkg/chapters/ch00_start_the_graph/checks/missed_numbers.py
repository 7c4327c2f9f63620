"""00.3: a function that receives two numbers from a topic and counts the numbers that it missed."""

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.plain_values import of_kind
from course_pkg.ros.protocol.json_channel import Json
from course_pkg.waiting import at_this_load

NOT_RECEIVED = [
    (
        matches("^ROSException.*timeout|^TimesUp"),
        "No message arrived, although a node publishes more than 20 messages per second on the "
        "topic. Receive messages of the type UInt32 from the topic whose name is in the argument "
        "`topic`.",
    )
]
TOO_LONG = (
    "The pause is too long. Pause for the time in the argument `pause`, and receive only one number "
    "after the pause."
)
# Receiving a number takes much less than `USUAL` s on an idle machine, and less than `LONGEST` s on a busy
# machine.
USUAL, LONGEST = 0.5, 2.0
RECEIVED = "Return two numbers from the topic: one number before the pause, and one number after the pause."
MISSED = "Return how many numbers were published between the two received numbers."


@part(
    "00.3",
    points=2,
    goal=(
        "Return three numbers: a number from the topic, a later number, and how many numbers were "
        "published between these two."
    ),
    needs=["count_missed"],
    deadline=25.0,
    goals=[RECEIVED, MISSED],
    runs=["server"],
)
def count_what_was_missed(context: CheckContext) -> None:
    """Run the student's function twice: first with a short pause, and then with a long pause.

    In each run, the check publishes consecutive numbers on a new topic.
    """
    # The second pause is longer than 2 s: a function that always sleeps for 2 s, as in the chapter, fails.
    extra: list[float] = []  # the time in s between the end of each pause and the second number
    for shortest in (0.25, 2.2):
        topic = f"/{context.random.word()}"
        first = context.random.integer(1000, 9000)
        numbers = [{"data": first + step} for step in range(1000)]
        every = context.random.number(0.02, 0.045, digits=3)
        publisher = context.publish(topic, "std_msgs/UInt32", numbers, every=every)
        pause = context.random.number(shortest, shortest + 0.15)
        done = context.run("count_missed", topic, pause, within=4.0 + pause, hints=_no_numbers(publisher))
        before, after, missed = _three_numbers(context, done.returned())
        sent = publisher.sent
        context.require(
            "the first two numbers were published on the topic",
            holds=all(0 <= number - first < len(sent) for number in (before, after)),
            expected=f"numbers such as {first + 5}",
            actual=[before, after],
            hints=(
                "The numbers that your function returned were not published on the given "
                "topic. Receive messages from the topic whose name is in the argument `topic`."
            )
            if not 0 <= before - first < len(sent)
            else (
                "The second number was not published. Do not calculate this number: receive a message "
                "after the pause, and return the number in this message."
            ),
        )
        between = sent[after - first] - sent[before - first]
        context.require(
            "the second number is received after the pause",
            holds=before < after and between > pause - 0.1,
            expected=f"{pause} s between the two numbers",
            actual=f"{before}, and then {after}" if before > after else f"{between:.2f} s",
            hints=(
                "The order of the two numbers is wrong. The first number has to be the number before "
                "the pause, and the second number has to be the number after the pause."
            )
            if before > after
            else (
                "The time between the two numbers is too short. After you receive the first number, "
                "use `time.sleep` to pause for the time in the argument `pause`."
            ),
        )
        extra.append(between - pause)
        # A busy machine may delay one of the two runs.
        delayed = len(extra) > 1 and min(extra) > at_this_load(USUAL)
        if extra[-1] > LONGEST or delayed:
            context.fail(
                "the second number is received soon after the pause",
                expected=f"about {pause} s between the two numbers",
                actual=f"{between:.2f} s",
                hint=TOO_LONG,
            )
        # A subscriber receives a number only if it is connected to the publisher. The subscriber may connect
        # just after the publisher has counted its subscribers, so accept a number if the publisher counted a
        # subscriber for this number or for the next number.
        subscribers = publisher.subscribers
        for place in (before - first, after - first):
            if not any(subscribers[place : place + 2]):
                context.fail(
                    "the first two numbers were published on the topic",
                    expected="two numbers that your function received from the topic",
                    actual=f"{first + place}, a number that was published while the topic had no subscriber",
                    hint=(
                        "Your function returned a number that it did not receive. Receive one number before "
                        "the pause and one number after the pause, and return these two numbers."
                    ),
                )
        unheard = subscribers[before - first : after - first].count(0)
        # On a busy machine, the publisher may count a subscriber for some time after the subscriber has
        # unsubscribed. At the end of the long pause, this time is over.
        ending = max(place for place, at in enumerate(sent) if at <= sent[before - first] + pause - 0.05)
        listens = unheard < (after - before) / 2 or subscribers[ending] > 0 if shortest > 1 else not unheard
        if listens:
            context.fail(
                "the second number is received after the pause",
                expected="no subscriber during the pause",
                actual="a subscriber that received numbers during the pause",
                hint=(
                    "Your function received numbers during the pause. Use "
                    "rospy.wait_for_message: this function unsubscribes after one message."
                ),
            )
        with context.goal(MISSED):
            context.expect(
                "the third number is the count of missed numbers",
                expected=after - before - 1,
                actual=missed,
                hints=[
                    (
                        after - before,
                        "Your count includes one of the two numbers that you received. For example, "
                        "if you receive 17 and 25, you miss 7 numbers.",
                    ),
                    (
                        after - before + 1,
                        "Your count includes both numbers that you received. For example, if you "
                        "receive 17 and 25, you miss 7 numbers.",
                    ),
                    (
                        before - after + 1,
                        "Your count is negative. Subtract the first number from the second number.",
                    ),
                    (
                        ANYTHING,
                        "Calculate the third number from the first two numbers. For example, if you "
                        "receive 17 and 25, you miss 7 numbers.",
                    ),
                ],
            )
    context.fulfilled(RECEIVED)


def _no_numbers(publisher: Publisher) -> Hints:
    """Return hints for a student's function that takes too long or raises a timeout error."""
    return [
        (lambda actual: "TimesUp" in actual and any(publisher.subscribers), TOO_LONG),
        *NOT_RECEIVED,
    ]


def _three_numbers(context: CheckContext, returned: Json) -> tuple[int, int, int]:
    """Assert that the student's function returned three whole numbers, and return these numbers."""
    context.require(
        "three numbers are returned",
        holds=isinstance(returned, list) and len(returned) == 3,
        expected="three numbers",
        actual=returned,
        hints=[
            (None, NO_RETURN),
            (
                lambda actual: isinstance(actual, int),
                (
                    "Your function returned only one number. Return the three numbers `before`, "
                    "`after` and `missed`."
                ),
            ),
            (ANYTHING, "Return the three numbers in one line: `return before, after, missed`."),
        ],
    )
    before, after, missed = of_kind(list, returned, "the result")
    context.require(
        "the three results are whole numbers",
        holds=all(type(number) is int for number in (before, after, missed)),
        expected="three values of type int",
        actual=returned,
        hints=[
            (
                matches("data"),
                (
                    "Your function returned a whole message. Return only the number in the field "
                    "`data` of the message."
                ),
            ),
            (ANYTHING, "The three results have to be whole numbers. Return values of type int."),
        ],
    )
    return before, after, missed
