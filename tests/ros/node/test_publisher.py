"""Tests of the publisher that counts its messages."""

from __future__ import annotations

import pytest

from course_pkg.ros import PrivateMaster, look
from tests.kernel import Kernel
from tests.support import eventually, stopped

START = """
import rospy
from std_msgs.msg import String, UInt32
from course_pkg.ros import Publisher, join
from course_pkg.waiting import wait_until
node = join("speaker")
def connected(publisher):
    assert wait_until(lambda: publisher.deliveries, 10)
"""
LISTEN = """
from std_msgs.msg import String, UInt32
from course_pkg.ros import join
node = join("listener")
heard = node.subscribe("/numbers", UInt32)
"""


@pytest.fixture
def joined(kernel: Kernel) -> Kernel:
    """Return a kernel that runs a node and has imported some types."""
    kernel.run(START)
    return kernel


def test_a_message_reaches_a_connected_subscriber(joined: Kernel) -> None:
    """Two messages reach the connected subscriber, and the counts `unheard` and `dropped` are 0."""
    assert joined.run("""
        heard = node.subscribe("/numbers", UInt32)
        spoken = Publisher("/numbers", UInt32)
        connected(spoken)
        spoken.publish(7)
        spoken.publish(data=8)
        heard.wait(2)
        counts = spoken.published, spoken.unheard, spoken.dropped
        result = [message.data for message in heard.messages], counts, spoken.deliveries[0].peer, repr(spoken)
    """) == [[7, 8], [2, 0, 0], "/speaker", "</numbers of type std_msgs/UInt32, published>"]


def test_the_first_message_is_counted_as_unheard(joined: Kernel) -> None:
    """`unheard` counts a message that is published while no subscriber is connected."""
    assert joined.run("""
        heard = node.subscribe("/numbers", UInt32)
        spoken = Publisher("/numbers", UInt32)
        spoken.publish(1)
        connected(spoken)
        spoken.publish(2)
        heard.wait(1)
        result = [m.data for m in heard.messages], spoken.published, spoken.unheard
    """) == [[2], 2, 1]
    eventually(lambda: joined.run("result = spoken.sent") == 1)  # The first message was not sent.


def test_a_latched_message_waits_for_its_subscriber(joined: Kernel) -> None:
    """A latched message is sent to a later subscriber, and is then counted as sent."""
    assert joined.run("""
        spoken = Publisher("/numbers", UInt32, latch=True)
        spoken.publish(1)
        spoken.publish(2)
        heard = node.subscribe("/numbers", UInt32)
        heard.wait(1)
        wait_until(lambda: spoken.sent, 5)  # a message may arrive before it is counted
        result = [m.data for m in heard.messages], spoken.unheard, spoken.sent
    """) == [[2], 2, 1]


def test_dropped_messages_are_counted_one_by_one(kernel: Kernel, master: PrivateMaster) -> None:
    """If the queue is full, the numbers of sent, waiting and dropped messages add up to all messages."""
    with Kernel() as other:
        other.run(LISTEN + 'heard = node.subscribe("/long", String)')
        kernel.run(START + 'spoken = Publisher("/long", String, queue_size=2); connected(spoken)')
        counts = "[(each.sent, each.waiting, each.dropped) for each in spoken.deliveries][0]"
        with stopped(other.pid):
            sent, waiting, dropped = kernel.run(f"""
                for number in range(30):
                    spoken.publish(f"{{number:03d}}" + "x" * 1_000_000)
                result = {counts}
            """)
            assert sent + waiting + dropped == 30
            assert dropped >= 10
        eventually(lambda: kernel.run(f"result = {counts}")[1] == 0, timeout=30)
        sent, _, now = kernel.run(f"result = {counts}")
        assert (sent, now) == (30 - dropped, dropped)
        eventually(lambda: other.run("result = heard.count") == sent, timeout=30)
        assert other.run("result = heard.messages[-1].data[:3]") == "029"
        assert kernel.run("result = spoken.dropped, spoken.sent") == [dropped, sent]


def test_counts_are_kept_after_the_subscriber_has_ended(joined: Kernel) -> None:
    """The counts include the messages to a subscriber that has ended."""
    assert joined.run("""
        from tests.support import eventually
        spoken = Publisher("/numbers", UInt32)
        for number in range(3):
            heard = node.subscribe("/numbers", UInt32)
            connected(spoken)
            spoken.publish(number)
            heard.wait(1)
            heard.stop()
            eventually(lambda: not spoken.deliveries)
        result = spoken.published, spoken.sent, spoken.dropped
    """) == [3, 3, 0]


def test_a_stopped_publisher_publishes_nothing(joined: Kernel, master: PrivateMaster) -> None:
    """stop() unregisters the topic, and publish() then raises an error."""
    joined.run("""
        spoken = Publisher("/numbers", UInt32)
        spoken.stop()
    """)
    assert "/numbers" not in {topic.name for topic in look(master.uri).topics}
    assert joined.ask("spoken.publish(1)").error == "PublisherStopped"
