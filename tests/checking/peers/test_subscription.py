"""A check's subscription returns messages with their times, publishers and types."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.checking.peers.subscription import Arrival, rate
from course_pkg.ros import MasterClient, PrivateMaster
from tests.kernel import Kernel
from tests.support import eventually

CHECK_RUNNER = """
from contextlib import ExitStack
from course_pkg.checking.peers.subscription import Subscription, rate
from course_pkg.checking.assertions import Results, AssertionFailed
from course_pkg.checking.peers.node import on_the_graph
from course_pkg.checking.peers.publisher import Publisher
from std_msgs.msg import Float64, UInt32

opened = ExitStack()
node = opened.enter_context(on_the_graph())
results = Results()

def subscribe(topic, kind=UInt32):
    return opened.enter_context(Subscription(results, node, topic, kind, topic))

def publish(topic, kind, messages):
    publisher = Publisher(results, topic, kind, messages, every=0.01, once=True, label=topic)
    return opened.enter_context(publisher)

def broken(one, **how):
    results.__init__()  # otherwise, the first failure of an assertion with this title is kept
    try:
        one.published(**how) if isinstance(one, Subscription) else one.listened(**how)
    except AssertionFailed:
        assertion = results.assertions[-1]
        return [assertion.text, assertion.actual, assertion.hint]
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
    """Return a kernel that runs a node."""
    with Kernel() as kernel:
        kernel.run(STUDENT)
        yield kernel


@pytest.fixture
def check(master: PrivateMaster) -> Iterator[Kernel]:
    """Return a process that defines the functions `subscribe`, `publish` and `broken`."""
    with Kernel() as kernel:
        kernel.run(CHECK_RUNNER)
        yield kernel
        kernel.run("opened.close()")
    eventually(lambda: not MasterClient(master.uri).system_state().subscribers)


def test_messages_come_with_their_time_and_their_publisher(check: Kernel, student: Kernel) -> None:
    """All messages arrive in the order of publication, with their time and their publisher."""
    check.run("subscription = subscribe('/count')")
    student.run("p = rospy.Publisher('/count', UInt32, queue_size=100); connected(p)")
    student.run("for number in range(50): p.publish(number)")
    arrivals = check.run("result = [[a.fields, a.by, a.latched] for a in subscription.wait(50)]")
    assert arrivals == [[{"data": number}, "/student", False] for number in range(50)]
    assert check.run("subscription.published(); result = [a.at for a in subscription.arrivals]") == sorted(
        check.run("result = [a.at for a in subscription.arrivals]")
    )
    checked = "result = [subscription.count, [each.holds for each in results.assertions]]"
    assert check.run(checked) == [50, [True]]


def test_a_wait_ends_when_its_time_is_over(check: Kernel) -> None:
    """A wait for a message that is never published ends at its time limit."""
    reply = check.ask(
        "subscription = subscribe('/nothing'); result = [subscription.wait(1, 0.3), subscription.during(0.2)]"
    )
    assert reply.value == [[], []]
    assert check.run("result = subscription.until(lambda arrivals: len(arrivals) > 3, 0.1)") is False


def test_topic_without_a_publisher(check: Kernel, student: Kernel) -> None:
    """If a topic has no publisher, the report says so and contains a similar topic name."""
    assert check.run("result = broken(subscribe('/joint_states'), within=0.1)") == [
        "/joint_states is published with the type std_msgs/UInt32",
        "no publisher",
        "No node publishes this topic. Run the cell that publishes this topic, and run it again after each "
        "restart of the kernel.",
    ]
    student.run("p = rospy.Publisher('/joint_state', UInt32, queue_size=1)")
    report = check.run("result = broken(subscribe('/joint_states'), within=0.1)")
    assert report[2] == (
        "The graph contains a topic with a similar name, /joint_state. Compare this name letter by letter "
        "with the name in the exercise."
    )


@pytest.mark.parametrize("publish", ["", "p.publish(1.5)"])
def test_wrong_type_is_reported(check: Kernel, student: Kernel, publish: str) -> None:
    """The report contains a publisher's wrong message type, even if no message was published."""
    student.run(f"p = rospy.Publisher('/level', Float64, queue_size=10, latch=True); {publish}")
    _, seen, hint = check.run("result = broken(subscribe('/level'))")
    assert seen == "std_msgs/Float64"
    assert (
        hint
        == "The topic has the wrong type. Publish the topic with the type in the exercise: std_msgs/UInt32."
    )
    report = check.run("result = broken(subscribe('/level'), hints=[('std_msgs/Float64', 'Whole numbers.')])")
    assert report[2] == "Whole numbers."


def test_wrong_definition_is_reported(check: Kernel, student: Kernel) -> None:
    """If the message definitions differ, the report contains the type and "with another definition"."""
    student.run(
        "from course_pkg.types import message_type\n"
        "class Other(Float64): _type, _md5sum = 'std_msgs/UInt32', '0' * 32\n"
        "p = rospy.Publisher('/other', Other, queue_size=10)"
    )
    assert check.run("result = broken(subscribe('/other'))")[1] == "std_msgs/UInt32 with another definition"


def test_published_waits_for_the_connection(check: Kernel, student: Kernel) -> None:
    """The method published() waits until the publisher is connected."""
    student.run("p = rospy.Publisher('/late', UInt32, queue_size=10)")
    check.run("subscription = subscribe('/late'); subscription.published()")
    student.run("connected(p); p.publish(7)")
    assert check.run("result = [a.fields['data'] for a in subscription.wait(1)]") == [7]


def test_late_subscription_gets_only_the_latched_message(check: Kernel, student: Kernel) -> None:
    """A subscription that starts after the messages receives only the latched message."""
    student.run(
        "p = rospy.Publisher('/kept', UInt32, queue_size=10, latch=True); p.publish(1); p.publish(2)\n"
        "q = rospy.Publisher('/lost', UInt32, queue_size=10); q.publish(1)"
    )
    for _ in range(2):
        check.run("kept, lost = subscribe('/kept'), subscribe('/lost'); kept.published(); lost.published()")
        arrivals = check.run("result = [[a.fields['data'], a.latched] for a in kept.wait(1)]")
        assert arrivals == [[2, True]]
        assert check.run("kept.leave(); lost.leave(); result = lost.arrivals") == []


def test_number_of_stored_messages_is_limited(check: Kernel, student: Kernel) -> None:
    """A subscription stores only the first `KEPT` messages, but counts all messages."""
    check.run("import course_pkg.checking.peers.subscription as module; module.KEPT = 5")
    check.run("subscription = subscribe('/flood')")
    student.run("p = rospy.Publisher('/flood', UInt32, queue_size=0); connected(p)")
    student.run("for number in range(30): p.publish(number)")
    check.run("subscription.until(lambda _: subscription.count == 30)")
    assert check.run("result = [subscription.count, [a.fields['data'] for a in subscription.arrivals]]") == [
        30,
        [0, 1, 2, 3, 4],
    ]


def test_messages_published_once_wait_for_a_subscriber(check: Kernel, student: Kernel) -> None:
    """The messages wait until a subscriber connects; afterwards, `sent` contains the time of each message."""
    check.run("p = publish('/few', UInt32, [{'data': n} for n in (3, 1, 2)])")
    assert check.run("result = [p.has_subscriber(0.1), p.finish(0.1), p.sent]") == [False, False, []]
    student.run("subscription = node.subscribe('/few', UInt32)")
    assert check.run("result = [p.has_subscriber(5), p.finish(5), len(p.sent)]") == [True, True, 3]
    assert student.run("result = [message.data for message in subscription.wait(3)]") == [3, 1, 2]


def test_topic_without_a_subscriber(check: Kernel, student: Kernel) -> None:
    """If the only subscriber has a wrong message type, the hint contains the expected type."""
    student.run("subscription = node.subscribe('/few', Float64)")
    assert check.run("p = publish('/few', UInt32, [{'data': 1}]); result = broken(p, within=0.5)") == [
        "/few has a subscriber",
        "no subscriber",
        "No node is subscribed to this topic. Create a rospy.Subscriber of type "
        "std_msgs/UInt32 for this topic.",
    ]
    student.run("subscription = node.subscribe('/few', UInt32)")
    check.run("p.listened()")
    assert student.run("result = subscription.wait(1)[0].data") == 1


def test_a_message_in_a_message_is_a_dict(check: Kernel) -> None:
    """A check receives nested messages as dicts."""
    check.run("from sensor_msgs.msg import JointState; subscription = subscribe('/joints', JointState)")
    check.run(
        "said = {'header': {'stamp': {'secs': 5, 'nsecs': 6}}, 'name': ['a'], 'position': [0.5]}\n"
        "publish('/joints', JointState, [said])"
    )
    arrivals = check.run("result = [arrival.fields for arrival in subscription.wait(1)]")[0]
    assert (arrivals["header"]["stamp"], arrivals["name"]) == ({"secs": 5, "nsecs": 6}, ["a"])
    assert (arrivals["position"], arrivals["velocity"]) == ([0.5], [])


def test_the_rate_of_arrivals() -> None:
    """The rate is the number of intervals per second. For fewer than two messages, the rate is 0."""

    def at(*times: float) -> list[Arrival]:
        return [Arrival({}, time, "/student", latched=False) for time in times]

    assert rate(at(1.0, 1.1, 1.2, 1.5)) == pytest.approx(6.0)
    assert [rate(at()), rate(at(1.0)), rate(at(1.0, 1.0))] == [0.0, 0.0, 0.0]
