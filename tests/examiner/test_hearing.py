"""A check hears a student's topic: what, when, from whom, and in which type, in bounded time."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.examiner.hearing import Arrival, rate
from course_pkg.graph import MasterClient, PrivateMaster
from tests.kernel import Kernel
from tests.support import eventually

JUDGE = """
from contextlib import ExitStack
from course_pkg.examiner.hearing import Hearing, rate
from course_pkg.examiner.ledger import Ledger, RuleBroken
from course_pkg.examiner.node import on_the_graph
from course_pkg.examiner.publishing import Publishing
from std_msgs.msg import Float64, UInt32

opened = ExitStack()
node = opened.enter_context(on_the_graph("02.1"))
ledger = Ledger()

def hear(topic, kind=UInt32):
    return opened.enter_context(Hearing(ledger, node, topic, kind, topic))

def speak(topic, kind, messages):
    saying = Publishing(ledger, topic, kind, messages, every=0.01, once=True, label=topic)
    return opened.enter_context(saying)

def broken(one, **how):
    try:
        one.published(**how) if isinstance(one, Hearing) else one.listened(**how)
    except RuleBroken:
        rule = ledger.rules[-1]
        return [rule.text, rule.seen, rule.hint]
"""
STUDENT = """
import rospy
from course_pkg import join
from std_msgs.msg import Float64, UInt32

node = join("student")

def connected(publisher, count=1):
    while publisher.get_num_connections() < count:
        rospy.sleep(0.01)
"""


@pytest.fixture
def student(master: PrivateMaster) -> Iterator[Kernel]:
    """A kernel that has joined the graph."""
    with Kernel() as kernel:
        kernel.run(STUDENT)
        yield kernel


@pytest.fixture
def judge(master: PrivateMaster) -> Iterator[Kernel]:
    """A process that examines, with `hear` and `broken` at hand."""
    with Kernel() as kernel:
        kernel.run(JUDGE)
        yield kernel
        kernel.run("opened.close()")
    eventually(lambda: not MasterClient(master.uri).system_state().subscribers)


def test_messages_come_with_their_time_and_their_publisher(judge: Kernel, student: Kernel) -> None:
    """In the order in which they were published, as plain data, none left out."""
    judge.run("hearing = hear('/count')")
    student.run("p = rospy.Publisher('/count', UInt32, queue_size=100); connected(p)")
    student.run("for number in range(50): p.publish(number)")
    heard = judge.run("result = [[a.fields, a.by, a.latched] for a in hearing.wait(50)]")
    assert heard == [[{"data": number}, "/student", False] for number in range(50)]
    assert judge.run("hearing.published(); result = [a.at for a in hearing.arrivals]") == sorted(
        judge.run("result = [a.at for a in hearing.arrivals]")
    )
    assert judge.run("result = [hearing.count, len(ledger.rules), ledger.rules[0].holds]") == [50, 1, True]


def test_a_wait_ends_when_its_time_is_over(judge: Kernel) -> None:
    """Nothing that a student does not publish can hold a check up."""
    reply = judge.ask("hearing = hear('/nothing'); result = [hearing.wait(1, 0.3), hearing.during(0.2)]")
    assert reply.value == [[], []]
    assert judge.run("result = hearing.until(lambda heard: len(heard) > 3, 0.1)") is False


def test_nobody_publishes(judge: Kernel, student: Kernel) -> None:
    """The report says so, and names a topic that is nearly the one."""
    assert judge.run("result = broken(hear('/joint_states'), within=0.1)") == [
        "/joint_states is published as std_msgs/UInt32",
        "nobody who publishes it",
        "Run the cell that publishes it, also after each restart of the kernel.",
    ]
    student.run("p = rospy.Publisher('/joint_state', UInt32, queue_size=1)")
    words = judge.run("result = broken(hear('/joint_states'), within=0.1)")
    assert words[2] == "There is /joint_state: compare the names letter by letter."


@pytest.mark.parametrize("says", ["", "p.publish(1.5)"])
def test_a_topic_of_another_type_is_heard_of(judge: Kernel, student: Kernel, says: str) -> None:
    """A subscriber of the right type would never hear of it; whether or not anything is said yet."""
    student.run(f"p = rospy.Publisher('/level', Float64, queue_size=10, latch=True); {says}")
    _, seen, hint = judge.run("result = broken(hear('/level'))")
    assert seen == "std_msgs/Float64"
    assert hint == "Publish it with the type that the exercise names: std_msgs/UInt32."
    words = judge.run("result = broken(hear('/level'), hints={'std_msgs/Float64': 'Whole numbers.'})")
    assert words[2] == "Whole numbers."


def test_a_definition_that_differs_is_told_from_a_type_that_does(judge: Kernel, student: Kernel) -> None:
    """The name is right, and the message could not be read."""
    student.run(
        "from course_pkg.interfaces import message_type\n"
        "class Other(Float64): _type, _md5sum = 'std_msgs/UInt32', '0' * 32\n"
        "p = rospy.Publisher('/other', Other, queue_size=10)"
    )
    assert judge.run("result = broken(hear('/other'))")[1] == "std_msgs/UInt32 of another definition"


def test_a_published_topic_is_heard_from_then_on(judge: Kernel, student: Kernel) -> None:
    """`published` returns when the connection stands: the next message is not lost."""
    student.run("p = rospy.Publisher('/late', UInt32, queue_size=10)")
    judge.run("hearing = hear('/late'); hearing.published()")
    student.run("connected(p); p.publish(7)")
    assert judge.run("result = [a.fields['data'] for a in hearing.wait(1)]") == [7]


def test_who_comes_late_hears_what_is_latched_and_only_that(judge: Kernel, student: Kernel) -> None:
    """Also after listening before: leaving gives the connection up."""
    student.run(
        "p = rospy.Publisher('/kept', UInt32, queue_size=10, latch=True); p.publish(1); p.publish(2)\n"
        "q = rospy.Publisher('/lost', UInt32, queue_size=10); q.publish(1)"
    )
    for _ in range(2):
        judge.run("kept, lost = hear('/kept'), hear('/lost'); kept.published(); lost.published()")
        heard = judge.run("result = [[a.fields['data'], a.latched] for a in kept.wait(1)]")
        assert heard == [[2, True]]
        assert judge.run("kept.leave(); lost.leave(); result = lost.arrivals") == []


def test_a_loop_without_its_sleep_is_heard_in_bounded_memory(judge: Kernel, student: Kernel) -> None:
    """The first KEPT are kept, and all are counted."""
    judge.run("import course_pkg.examiner.hearing as module; module.KEPT = 5; hearing = hear('/flood')")
    student.run("p = rospy.Publisher('/flood', UInt32, queue_size=0); connected(p)")
    student.run("for number in range(30): p.publish(number)")
    judge.run("hearing.until(lambda _: hearing.count == 30)")
    assert judge.run("result = [hearing.count, [a.fields['data'] for a in hearing.arrivals]]") == [
        30,
        [0, 1, 2, 3, 4],
    ]


def test_messages_that_are_published_once_wait_for_a_listener(judge: Kernel, student: Kernel) -> None:
    """So that a student's subscriber gets every one of them; the times are those of the publishing."""
    judge.run("p = speak('/few', UInt32, [{'data': n} for n in (3, 1, 2)])")
    assert judge.run("result = [p.heard(0.1), p.finish(0.1), p.sent]") == [False, False, []]
    student.run("heard = node.subscribe('/few', UInt32)")
    assert judge.run("result = [p.heard(5), p.finish(5), len(p.sent)]") == [True, True, 3]
    assert student.run("result = [message.data for message in heard.wait(3)]") == [3, 1, 2]


def test_that_nobody_listens_is_told(judge: Kernel, student: Kernel) -> None:
    """Who subscribes in another type hears nothing, and counts as nobody; the hint says which type it is."""
    student.run("heard = node.subscribe('/few', Float64)")
    assert judge.run("p = speak('/few', UInt32, [{'data': 1}]); result = broken(p, within=0.5)") == [
        "somebody listens to /few",
        "nobody",
        "Make a rospy.Subscriber for it, of type std_msgs/UInt32.",
    ]
    student.run("heard = node.subscribe('/few', UInt32)")
    judge.run("p.listened()")
    assert student.run("result = heard.wait(1)[0].data") == 1


def test_a_message_in_a_message_is_a_dict(judge: Kernel) -> None:
    """What a check publishes it hears again as it was given, also a header with its time."""
    judge.run("from sensor_msgs.msg import JointState; hearing = hear('/joints', JointState)")
    judge.run(
        "said = {'header': {'stamp': {'secs': 5, 'nsecs': 6}}, 'name': ['a'], 'position': [0.5]}\n"
        "speak('/joints', JointState, [said])"
    )
    heard = judge.run("result = [arrival.fields for arrival in hearing.wait(1)]")[0]
    assert (heard["header"]["stamp"], heard["name"]) == ({"secs": 5, "nsecs": 6}, ["a"])
    assert (heard["position"], heard["velocity"]) == ([0.5], [])


def test_the_rate_of_arrivals() -> None:
    """Intervals by time; what cannot be told is 0."""

    def at(*times: float) -> list[Arrival]:
        return [Arrival({}, time, "/student", latched=False) for time in times]

    assert rate(at(1.0, 1.1, 1.2, 1.5)) == pytest.approx(6.0)
    assert [rate(at()), rate(at(1.0)), rate(at(1.0, 1.0))] == [0.0, 0.0, 0.0]
