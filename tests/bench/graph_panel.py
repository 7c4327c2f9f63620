"""What the graph panel costs: an update with 20 nodes and 40 topics, and a graph that does not change.

Such a graph is tried twice: with nodes that do nothing, and with 40 topics that carry messages all the time.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable

from course_pkg.graph import NodeSeen, PrivateMaster, ServiceSeen, Snapshot, TopicSeen
from course_pkg.panels import GraphPanel
from course_pkg.panels.graph.model import GraphModel

UPDATE_BAR = 150.0  # ms
IDLE_BAR = 2.0  # % of a core
NODES, TOPICS = 20, 40
WATCH, SETTLE = 10.0, 10.0  # s
RATE = 5  # Hz, of each topic

# A node that publishes on topics and listens to others, each by name, as many as there are.
SPEAKER = """
import sys
import rospy
from std_msgs.msg import String
rospy.init_node(sys.argv[1])
spoken, heard = (names.split(",") for names in sys.argv[2:4])
speakers = [rospy.Publisher(name, String, queue_size=1) for name in spoken]
listeners = [rospy.Subscriber(name, String) for name in heard]
rate = rospy.Rate(float(sys.argv[4]))
while not rospy.is_shutdown():
    for speaker in speakers:
        speaker.publish("x")
    try:
        rate.sleep()
    except rospy.ROSInterruptException:
        break
"""


def graph(turn: int) -> Snapshot:
    """Make a graph of which one topic's name differs from turn to turn."""
    names = [f"/robot_{number}" for number in range(NODES)]
    topics = [
        TopicSeen(f"/topic_{number}_{turn if not number else 0}", "std_msgs/String", (names[number % NODES],),
                  (names[(3 * number + 1) % NODES], names[(7 * number + 2) % NODES]))
        for number in range(TOPICS)
    ]  # fmt: skip
    services = [
        ServiceSeen(f"{name}/start", "std_srvs/Trigger", name, "rosrpc://localhost:1", "answered")
        for name in names
    ]
    nodes = tuple(NodeSeen(name, "http://localhost:1/", "answered") for name in names)
    return Snapshot("http://localhost:11311", nodes, tuple(topics), tuple(services))


def update() -> float:
    """Return the median time (ms) from a new snapshot to a new drawing."""
    model = GraphModel(lambda **_: None)
    times = []
    for turn in range(15):
        snapshot = graph(turn)
        began = time.perf_counter()
        model.see(snapshot)
        times.append(1000 * (time.perf_counter() - began))
    return statistics.median(times)


def share(
    nodes: list[subprocess.Popen[bytes]], ready: Callable[[GraphPanel], bool]
) -> tuple[float, Counter[str]]:
    """Return the share of a core (%) that a shown panel takes, and how often it told the page of what."""
    told: Counter[str] = Counter()
    try:
        panel = GraphPanel()
        while not ready(panel):
            panel._follower.once()
            panel._listener.once()
            time.sleep(0.5)
        panel.observe(lambda change: told.update([change["name"]]))
        panel.shown()
        time.sleep(SETTLE)
        told.clear()
        began, spent = time.monotonic(), time.process_time()
        time.sleep(WATCH)
        used = 100 * (time.process_time() - spent) / (time.monotonic() - began)
        counts = Counter(told)
        panel.hidden()
        return used, counts
    finally:
        for node in nodes:
            node.terminate()
        for node in nodes:
            node.wait()


def idle() -> float:
    """Return the share of a core (%) while ten nodes do nothing."""
    nodes = [
        subprocess.Popen(["rosrun", "course_pkg", "server", f"__name:=n{number}"]) for number in range(10)
    ]
    return share(nodes, lambda panel: sum(each["kind"] == "node" for each in panel.facts) == len(nodes))[0]


def busy() -> tuple[float, Counter[str]]:
    """Return the share of a core (%) while 20 nodes talk on 40 topics, and what the page was told."""
    topics = [f"/topic_{number}" for number in range(TOPICS)]
    commands = [
        [f"robot_{number}", ",".join(topics[number::NODES]), ",".join(topics[(number + 7) % NODES :: NODES])]
        for number in range(NODES)
    ]
    nodes = [
        subprocess.Popen([sys.executable, "-c", SPEAKER, *command, str(RATE)], stderr=subprocess.DEVNULL)
        for command in commands
    ]
    return share(nodes, lambda panel: _heard(panel) == TOPICS)


def _heard(panel: GraphPanel) -> int:
    return sum(note.endswith("Hz") for note in panel.activity["notes"].values())


def main() -> int:
    """Print the figures; fail when one misses its bar, or when numbers drew the picture anew."""
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        os.environ["ROS_HOSTNAME"] = "localhost"
        updated, resting, (talking, told) = update(), idle(), busy()
    print(f"update with {NODES} nodes, {TOPICS} topics: {updated:.0f} ms, bar {UPDATE_BAR:.0f} ms")
    print(f"idle: {resting:.2f} % of a core, bar {IDLE_BAR:.0f} %")
    print(f"{TOPICS} topics of {RATE} Hz: {talking:.2f} % of a core, bar {IDLE_BAR:.0f} %")
    print(f"  told to the page in {WATCH:.0f} s: {dict(told) or 'nothing'}; a drawing would be one too many")
    return int(updated > UPDATE_BAR or max(resting, talking) > IDLE_BAR or told["drawing"] > 0)


if __name__ == "__main__":
    sys.exit(main())
