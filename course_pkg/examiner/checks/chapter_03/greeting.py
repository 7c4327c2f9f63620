"""03.2: everybody who is told of on a topic is greeted, once and in order."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.hearing import Hearing
from course_pkg.examiner.plain import Plain

NUMBER = "std_msgs/UInt32"
GREETING = 0.2  # s that say_good_day() takes
EAR = """
import threading


class Ear:
    def __init__(self):
        self.names, self.say, self.said, self.busy, self.at_once = {}, None, [], 0, 0
        self.lock = threading.Lock()

    def __call__(self, number):
        with self.lock:
            self.said.append(number)
            self.busy += 1
            self.at_once = max(self.at_once, self.busy)
        try:
            return self.say(number)
        finally:
            with self.lock:
                self.busy -= 1


ear = Ear()


def begin(start, *topics):
    ear.names = getattr(start, "__globals__", {})
    ear.say = ear.names.get("say_good_day")
    if ear.say:
        ear.names["say_good_day"] = ear
    return start(*topics)


def end():
    if ear.say:
        ear.names["say_good_day"] = ear.say
"""  # listens in on what is said: a second greeting, and two at once, need not show on the topic
MIXED_UP = "It publishes on `customers`. Listen to `customers`, and publish on `greetings`."
TOO_LATE = (
    "Make the publisher in start_greeting(), before anybody comes: one that is made for the first greeting "
    "is not connected yet, and the greeting is lost."
)
LOST = (
    "They came while another one was being greeted, and were dropped. A subscriber's queue_size says how "
    "many may wait in line; leave it out, and all of them may."
)


@part(
    "03.2",
    points=2,
    goal="Greet every customer of whom a topic tells, once, in the order in which they come.",
    needs=["start_greeting"],
    deadline=30.0,
)
def greet_everyone(exam: Exam) -> None:
    """Tell of five nearly at once, two of them twice; then, after a pause, of two more and an old one."""
    customers, greetings = (f"/{exam.draw.word()}" for _ in range(2))
    numbers = sorted(exam.draw.integers(7, 10, 9000))
    hearing = exam.hear(greetings, NUMBER)
    exam.prepare(EAR)
    try:
        _greets(exam, hearing, customers, greetings, numbers)
    finally:
        exam.run("end", worded="start_greeting()")


def _greets(exam: Exam, hearing: Hearing, customers: str, greetings: str, numbers: list[int]) -> None:
    first, later = numbers[:5], numbers[5:]
    start, words = Its("start_greeting"), "start_greeting()"
    exam.run("begin", start, customers, greetings, hints=_NO_RETURN, worded=words).value  # noqa: B018
    mixed_up = any(topic.name == customers and topic.publishers for topic in exam.look().topics)
    hearing.published(hints={says("nobody"): MIXED_UP if mixed_up else TOO_LATE})
    sent = _told(exam, customers, [*first[:2], first[0], *first[2:], first[2]])
    _greeted(exam, hearing, first)
    exam.hold(
        "a greeting is told of when it has been said",
        hearing.arrivals[0].at - sent > 0.75 * GREETING,
        expected=f"a message about {GREETING:g} s after the customer, as long as say_good_day() takes",
        seen="a message at once",
        hints="Call say_good_day(number) first, and publish the number after it.",
    )
    _told(exam, customers, [later[0], first[3], later[1]])
    _greeted(exam, hearing, numbers)


def _told(exam: Exam, topic: str, numbers: list[int]) -> float:
    """Tell of customers on the topic, 50 a second; return when the first was told (s, time.monotonic())."""
    speaking = exam.publish(topic, NUMBER, [{"data": number} for number in numbers], every=0.02, once=True)
    exam.hold(
        "somebody listens to the topic that was named",
        speaking.heard(3.0),
        expected=f"a subscriber of {topic}",
        seen="nobody who listens",
        hints="Subscribe to the name in `customers`, and leave the subscription open at the end.",
    )
    speaking.finish(5.0)
    speaking.stop()
    return speaking.sent[0]


def _greeted(exam: Exam, hearing: Hearing, numbers: list[int]) -> None:
    """Hold that all these have been greeted by now, once and in order."""
    hearing.until(lambda arrivals: set(numbers) <= {each.fields["data"] for each in arrivals}, 8.0)
    hearing.during(2 * GREETING + 0.2)  # a second greeting of somebody would come about now
    seen: list[Plain] = [each.fields["data"] for each in hearing.arrivals]
    said: list[Plain] = exam.read("ear.said")
    exam.hold(
        "only customers are greeted",
        set(seen) <= set(numbers),
        expected=f"numbers such as {numbers[:3]}",
        seen=seen,
        hints="Publish the number that the message brought, its field data, as it came.",
    )
    exam.hold(
        "nobody is left out",
        set(seen) == set(numbers),
        expected=f"greetings for {numbers}",
        seen=seen,
        hints=[
            ([], "No greeting came at all. Does the callback run to its end? An error in it stays with it."),
            (lambda found: len(found) == 1, f"One greeting came, and then no more. {LOST}"),
            (lambda found: numbers[0] not in found, "The first was lost. " + LOST),
            (says(""), LOST),
        ],
    )
    exam.hold(
        "nobody is greeted twice",
        len(seen) == len(set(seen)) and len(said) == len(set(said)),
        expected=f"each of {numbers} once",
        seen=seen if len(seen) > len(set(seen)) else f"say_good_day() for {', '.join(map(str, said))}",
        hints="The detector may tell of a customer again. Remember who has been greeted, in a set.",
    )
    rule = "they are greeted in the order in which they come"
    if exam.read("ear.at_once") > 1:
        exam.fail(
            rule,
            expected="one greeting after the other",
            seen="two at the same time",
            hint="A thread for each greets them all at once. Begin with the next one when the last is done.",
        )
    exam.expect(
        rule,
        expected=numbers,
        seen=seen,
        hints="Greet them one after the other, as they are told of, the first one first.",
    )


_NO_RETURN = {
    says(
        "^(TimesUp|NothingHeard)"
    ): "start_greeting() has to return, so that the cell goes on: subscribe with a callback, which "
    "rospy calls on a thread of its own for each message.",
}
