"""Publishers: at a rate with nothing lost, and a notice for those who come later."""

from itertools import pairwise

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.hearing import Arrival, Hearing, rate

WAITS_FOR_EVER = "Nobody has to listen. Give the wait for a listener its limit, and speak all the same."
EARLIEST = 1.7  # s with nobody listening; the numbers themselves take 0.1
TOO_SOON = (
    "Somebody may come within 2 s, and would miss the 0. Look for a listener for so long, and speak then."
)
TOO_EARLY = (
    "The first was said before anybody was connected. Make the publisher, wait for a listener, then speak."
)


@part(
    "02.1",
    points=2,
    goal="Publish 0, 1, 2 and so on at a rate, and begin when somebody listens, or after 2 s.",
    needs=["count_aloud"],
    deadline=40.0,
)
def count_aloud(exam: Exam) -> None:
    """Listen to two counts of different rates, then have one made to which nobody listens."""
    for hertz, count in ((exam.draw.integer(15, 25), 30), (exam.draw.integer(40, 60), 45)):
        topic = f"/{exam.draw.word()}"
        hearing = exam.hear(topic, "std_msgs/UInt32")
        counted = exam.run("count_aloud", topic, hertz, count, within=10.0, hints=_slow(hertz))
        counted.value  # noqa: B018 -- that it returns is a rule
        heard = hearing.wait(count + 1, within=0.5)
        hearing.published(
            hints={says("nobody"): "Make a rospy.Publisher for the topic that is given."}, within=0.5
        )
        _counts(exam, heard, count)
        _keeps_time(exam, heard, hertz)
        exam.hold(
            "it begins as soon as somebody listens",
            counted.took < count / hertz + 1.2,
            expected="no pause before the first number, since somebody was listening",
            seen=f"the end after {counted.took:.1f} s",
            hints="Look every few milliseconds whether somebody listens, and begin then.",
        )
    alone = exam.run(
        "count_aloud",
        f"/{exam.draw.word()}",
        50,
        5,
        within=7.0,
        hints={
            says("TimesUp"): WAITS_FOR_EVER,
            says("^(?!TimesUp)"): "With nobody listening it still has to speak.",
        },
    )
    alone.value  # noqa: B018 -- that it returns is a rule
    exam.hold(
        "with nobody listening it goes on after 2 s",
        EARLIEST < alone.took < 4.0,
        expected="the last number after a good 2 s",
        seen=f"the end after {alone.took:.1f} s",
        hints=WAITS_FOR_EVER if alone.took > EARLIEST else TOO_SOON,
    )


def _slow(hertz: int) -> dict[object, str]:
    return {
        says(
            "TimesUp"
        ): f"It is not done in time. {hertz} a second is a pause of 1/{hertz} s each: rospy.Rate does "
        "that. And a wait for a listener has to see one that is there.",
        says(
            "must be unsigned integer"
        ): "The message is a number, as range() gives it: no text and no float.",
    }


def _counts(exam: Exam, heard: list[Arrival], count: int) -> None:
    numbers = [arrival.fields["data"] for arrival in heard]
    exam.expect(
        "every number is heard once, in order, from 0",
        expected=list(range(count)),
        seen=numbers,
        hints=[
            (list(range(1, count)), TOO_EARLY),
            (
                list(range(count - 1)),
                "The last one is missing. The count ends with count - 1, and needs its time.",
            ),
            (list(range(count + 1)), "That is one too many. range(count) ends with count - 1."),
            (list(range(1, count + 1)), "It starts with 1. The first number is 0."),
            (
                lambda seen: seen and seen == list(range(len(seen))),
                "The end is missing. Publish `count` numbers, and return when the last one is out.",
            ),
            ([], "Nothing was heard. Publish each number, when somebody listens."),
            (lambda seen: seen == list(range(seen[0], count)), TOO_EARLY),
            (lambda seen: len(set(seen)) < len(seen), "A number was said twice."),
            (
                lambda seen: seen == sorted(seen),
                "Some are missing between others: the queue was full. Pause after each, and give it room.",
            ),
        ],
    )


def _keeps_time(exam: Exam, heard: list[Arrival], hertz: int) -> None:
    """Hold the average to the rate, and the gaps to be gaps: no burst and a long pause."""
    seen = rate(heard)
    exam.hold(
        "as many a second as was asked for",
        0.75 * hertz < seen < 1.25 * hertz,
        expected=f"about {hertz} a second",
        seen=f"{seen:.3g} a second",
        hints="Too fast: pause after each number."
        if seen > hertz
        else "Too slow: rospy.Rate(rate) keeps the pace.",
    )
    gaps = sorted(later.at - one.at for one, later in pairwise(heard))
    exam.hold(
        "evenly, one after the other",
        gaps[len(gaps) // 2] > 0.5 / hertz,
        expected=f"gaps of about {1000 / hertz:.0f} ms",
        seen=f"half of the gaps below {1000 * gaps[len(gaps) // 2]:.0f} ms",
        hints="They come in bursts. Pause after each number.",
    )


@part(
    "02.3",
    points=2,
    goal="Announce a value on a topic, once, for those who listen now and those who come later.",
    needs=["announce"],
    deadline=30.0,
)
def a_notice(exam: Exam) -> None:
    """Listen before and after a first value; then have a second announced while somebody listens."""
    topic = f"/{exam.draw.word()}"
    first, second = exam.draw.numbers(2, 1.0, 90.0)
    early = exam.hear(topic, "std_msgs/Float64")
    _announce(exam, topic, first)
    early.published(
        hints={
            says("nobody"): "Make a rospy.Publisher for the topic that is given, and keep it: one that is "
            "unregistered takes its notice along."
        }
    )
    _hears(exam, early, [first], "who listens already hears the value once")
    late = _again(exam, early, topic)
    _hears(exam, late, [first], "who comes later hears the value once")
    _announce(exam, topic, second)
    _hears(exam, late, [first, second], "who listens hears the next value")
    last = _again(exam, late, topic)
    _hears(exam, last, [second], "who comes then hears the last value alone")


def _announce(exam: Exam, topic: str, value: float) -> None:
    done = exam.run(
        "announce",
        topic,
        value,
        hints={
            says(
                "TimesUp"
            ): "It does not return. A latched message needs no loop, and no wait for a listener."
        },
    )
    done.value  # noqa: B018 -- that it returns is a rule
    exam.hold(
        "announce() returns at once",
        done.took < 1.0,
        expected="its end within a second",
        seen=f"its end after {done.took:.1f} s",
        hints="A latched message needs no pause and no wait: it is handed to whoever connects.",
    )


def _again(exam: Exam, before: Hearing, topic: str) -> Hearing:
    """Go away and come back: rospy hands a latched message to each new connection."""
    before.leave()
    hearing = exam.hear(topic, "std_msgs/Float64")
    hearing.published()
    return hearing


def _hears(exam: Exam, hearing: Hearing, values: list[float], rule: str) -> None:
    """Wait for the values, and half a second more, in which nothing may come."""
    hearing.wait(len(values), within=2.0)
    hearing.during(0.5)
    heard = [arrival.fields["data"] for arrival in hearing.arrivals]
    exam.expect(
        rule,
        expected=values,
        seen=heard,
        near=1e-9,
        hints=[
            (
                [],
                "Nothing was heard. A publisher with latch=True hands its last message to all who connect.",
            ),
            (lambda seen: len(seen) < len(values), "One of the values was not heard."),
            (
                lambda seen: len(seen) > 4,
                "It is said again and again. Say it once: with latch=True it is kept.",
            ),
            (lambda seen: len(seen) > len(values) and set(seen) == set(values), "It was said twice."),
            (
                lambda seen: seen[-1:] == values and len(seen) > 1,
                "An older value was said again. Who comes later hears the last one, and no other.",
            ),
            (
                lambda seen: seen[-1] != values[-1],
                "That is not the value that was announced. Publish it as it is given.",
            ),
        ],
    )
