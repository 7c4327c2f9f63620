"""What the graph panel costs: an update with 20 nodes and 40 topics, and a graph that does not change."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time

from course_pkg.graph import NodeSeen, PrivateMaster, ServiceSeen, Snapshot, TopicSeen
from course_pkg.panels import GraphPanel
from course_pkg.panels.graph.model import GraphModel

UPDATE_BAR = 150.0  # ms
IDLE_BAR = 2.0  # % of a core
NODES, TOPICS = 20, 40
WATCH = 10.0  # s


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


def idle() -> float:
    """Return the share of a core (%) that a shown panel takes while ten nodes do nothing."""
    nodes = [
        subprocess.Popen(["rosrun", "course_pkg", "server", f"__name:=n{number}"]) for number in range(10)
    ]
    try:
        panel = GraphPanel()
        while len([each for each in panel.facts if each["kind"] == "node"]) < len(nodes):
            panel._follower.once()
        panel.shown()
        began, spent = time.monotonic(), time.process_time()
        time.sleep(WATCH)
        share = 100 * (time.process_time() - spent) / (time.monotonic() - began)
        panel.close()
        return share
    finally:
        for node in nodes:
            node.terminate()
        for node in nodes:
            node.wait()


def main() -> int:
    """Print both figures; fail when one misses its bar."""
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        updated, share = update(), idle()
    sys.stdout.write(
        f"update with {NODES} nodes, {TOPICS} topics: {updated:.0f} ms, bar {UPDATE_BAR:.0f} ms\n"
    )
    sys.stdout.write(f"idle: {share:.2f} % of a core, bar {IDLE_BAR:.0f} %\n")
    return int(updated > UPDATE_BAR or share > IDLE_BAR)


if __name__ == "__main__":
    sys.exit(main())
