"""Measures panels: the cost of each panel for the kernel and for the page.

usage: ./course run python tests/bench/panels.py graph|timeline|turtles [OPTION …]
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from commands import run_command
from playwright.sync_api import Locator, Page, WebSocket, sync_playwright

from course_pkg.panels import GraphPanel
from course_pkg.panels.assets import module, sheet
from course_pkg.panels.graph.model import GraphModel
from course_pkg.panels.timeline.model import state
from course_pkg.ros import NodeSeen, PrivateMaster, ServiceSeen, Snapshot, TopicSeen
from course_pkg.ros.trace.recording import (
    CALLBACK,
    CONNECT,
    HANDLER,
    LOOKUP,
    PUBLISH,
    REQUEST,
    RESPONSE,
    WAIT,
    Event,
    Recording,
)
from tests.browser.chromium import FLAGS
from tests.browser.jupyter import running_lab, running_notebook
from tests.browser.pages import new_page, panel

# graph: measures an update of the graph panel with 20 nodes and 40 topics, and the CPU time for an unchanged
# graph.

UPDATE_BAR = 150.0  # ms
IDLE_BAR = 2.0  # The panel may use at most this percentage of a core.
NODES, TOPICS = 20, 40
GRAPH_WATCH, SETTLE = 10.0, 10.0  # s
RATE = 5  # Each topic has this rate in Hz.

# A node that publishes and subscribes to the topics in its arguments.
SPEAKER = """
import sys
import rospy
from std_msgs.msg import String
rospy.init_node(sys.argv[1])
published, subscribed = (names.split(",") for names in sys.argv[2:4])
speakers = [rospy.Publisher(name, String, queue_size=1) for name in published]
listeners = [rospy.Subscriber(name, String) for name in subscribed]
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
    """Return a graph in which the name of one topic depends on `turn`."""
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
    """Return the median time in ms between a new snapshot and its drawing."""
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
    """Return the percentage of a core that a visible panel uses, and the number of updates of each trait."""
    sent: Counter[str] = Counter()
    try:
        panel = GraphPanel()
        while not ready(panel):
            panel._snapshots.once()
            panel._listener.once()
            time.sleep(0.5)
        panel.observe(lambda change: sent.update([change["name"]]))
        panel.shown()
        time.sleep(SETTLE)
        sent.clear()
        began, spent = time.monotonic(), time.process_time()
        time.sleep(GRAPH_WATCH)
        used = 100 * (time.process_time() - spent) / (time.monotonic() - began)
        counts = Counter(sent)
        panel.hidden()
        return used, counts
    finally:
        for node in nodes:
            node.terminate()
        for node in nodes:
            node.wait()


def idle() -> float:
    """Return the percentage of a core that the panel uses while ten nodes are idle."""
    nodes = [
        subprocess.Popen(["rosrun", "course_pkg", "server", f"__name:=n{number}"]) for number in range(10)
    ]
    return share(nodes, lambda panel: sum(each["kind"] == "node" for each in panel.facts) == len(nodes))[0]


def busy() -> tuple[float, Counter[str]]:
    """Return the percentage of a core and the number of updates while 20 nodes use 40 topics."""
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


def graph_main() -> int:
    """Print the results. Return 1 if a result does not meet its limit."""
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"] = master.uri
        os.environ["ROS_HOSTNAME"] = "localhost"
        updated, resting, (talking, sent) = update(), idle(), busy()
    print(f"update with {NODES} nodes, {TOPICS} topics: {updated:.0f} ms, bar {UPDATE_BAR:.0f} ms")
    print(f"idle: {resting:.2f} % of a core, bar {IDLE_BAR:.0f} %")
    print(f"{TOPICS} topics of {RATE} Hz: {talking:.2f} % of a core, bar {IDLE_BAR:.0f} %")
    print(f"  sent to the page in {GRAPH_WATCH:.0f} s: {dict(sent) or 'nothing'}; there should be no drawing")
    return int(updated > UPDATE_BAR or max(resting, talking) > IDLE_BAR or sent["drawing"] > 0)


# timeline: measures the time until a browser has drawn 2,000 events, and the frame rate while the view moves.
# `./course test` installs the browser.

EVENTS, LENGTH = 2000, 10.0  # s
# The first drawing may take at most this many ms. Moving the view must reach at least this many frames per
# second.
DRAW_BAR, PAN_BAR = 500.0, 30.0
REPEATS, TIMELINE_WATCH = 9, 2000  # The benchmark draws this many times, and moves the view for this many ms.
PANELS = Path(__file__).parents[2] / "course_pkg" / "panels"
DRAW = """async (state) => {
    const url = URL.createObjectURL(new Blob([state._esm], {type: "text/javascript"}))
    const {render} = (await import(url)).default
    const el = document.getElementById("main")
    const model = {get: name => state[name], on() {}, send() {}, set() {}, save_changes() {}}
    const frame = () => new Promise(requestAnimationFrame)
    await frame()
    const start = performance.now()
    const end = render({model, el})
    await frame()
    await frame()
    const took = performance.now() - start
    window.again = () => { end(); el.replaceChildren() }
    return took
}"""
PAN = """async (watch) => {
    const canvas = document.querySelector("canvas.ros-body")
    const box = canvas.getBoundingClientRect()
    const send = (kind, x) => canvas.dispatchEvent(new PointerEvent(kind,
        {clientX: box.left + x, clientY: box.top + 3, bubbles: true, pointerId: 1, button: 0}))
    canvas.setPointerCapture = () => {}
    send("pointerdown", 400)
    const frames = []
    const start = performance.now()
    let last = start
    while (last - start < watch) {
        send("pointermove", 400 + 200 * Math.sin((last - start) / 300))
        await new Promise(requestAnimationFrame)
        const now = performance.now()
        frames.push(now - last)
        last = now
    }
    send("pointerup", 400)
    return frames
}"""


def timeline_main() -> int:
    """Print the results. Return 1 if a result does not meet its limit."""
    files = {"_esm": module(PANELS / "timeline/timeline.js"), "recorded": state(recording())}
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        page = browser.new_page(viewport={"width": 1000, "height": 900})
        style = sheet(PANELS / "look.css", PANELS / "timeline/timeline.css")
        host = Path(folder, "page.html")
        host.write_text(f"<!doctype html><style>{style}</style><main id=main></main>")
        page.goto(host.as_uri())
        drawn = [first_drawing(page, files) for _ in range(REPEATS)]
        rates = {"all": moving(page)}
        for _ in range(3):
            page.get_by_role("button", name="Zoom in").click()
        rates["an eighth"] = moving(page)
        browser.close()
    size = len(json.dumps(files["recorded"])) / 1000
    middle = statistics.median(drawn)
    print(f"drawing of {EVENTS} events: median {middle:.0f} ms, bar {DRAW_BAR:.0f} ms; state {size:.0f} kB")
    for label, rate in rates.items():
        print(f"moving with {label} in view: {rate:.0f} frames per second, bar {PAN_BAR:.0f}")
    return int(middle > DRAW_BAR or min(rates.values()) < PAN_BAR)


def first_drawing(page: Page, files: dict[str, object]) -> float:
    """Return the time in ms until the page shows the first picture."""
    page.evaluate("window.again?.()")
    return float(page.evaluate(DRAW, files))


def moving(page: Page) -> float:
    """Return the frames per second while the mouse moves the timeline to the left and to the right."""
    frames = page.evaluate(PAN, TIMELINE_WATCH)
    slow = sorted(frames)[int(0.95 * len(frames))]
    print(f"  frames: median {statistics.median(frames):.1f} ms, 95 % within {slow:.1f} ms")
    return 1000 * len(frames) / sum(frames)


def recording() -> Recording:
    """Return a recording with messages at 80 Hz and with calls that take 0.1 s."""
    events: list[Event] = []
    for number in range(int(80 * LENGTH)):
        at, key = number / 80, f"message {number}"
        events.append(Event(PUBLISH, "/robot", "/joints", at, at + 1e-4, "/simulator", key, "MainThread"))
        events.append(
            Event(CALLBACK, "/simulator", "/joints", at + 3e-4, at + 6e-4, "/robot", key, "/joints")
        )
    number = 0
    while len(events) < EVENTS:
        events += call(number, 0.02 + 0.145 * number)
        number += 1
    return Recording(events=tuple(sorted(events[:EVENTS], key=lambda event: event.start)), length=LENGTH)


def call(number: int, at: float) -> list[Event]:
    """Return the events of a call that begins at `at` s."""
    key, who, whom = f"call {number}", "/customer", "/cashier"
    parts = (
        (LOOKUP, 0, 1e-3),
        (CONNECT, 1e-3, 2e-3),
        (REQUEST, 2e-3, 2.1e-3),
        (WAIT, 2.1e-3, 0.1),
        (RESPONSE, 0.1, 0.1),
    )
    mine = [
        Event(kind, who, "/detect", at + start, at + end, whom, key, "MainThread")
        for kind, start, end in parts
    ]
    return [*mine, Event(HANDLER, whom, "/detect", at + 2.2e-3, at + 0.0999, who, key, f"Thread-{number}")]


# turtles: measures the cost of a turtle panel with five moving turtles. The benchmark `turtles` needs an idle
# machine. `./course test` installs the browser. Bars: at least 50 frames per second, at most 20 KiB/s on the
# websocket, and at most 3 % of a core for the kernel.

SETUP = """
from course_pkg import TurtlePanel, join
from turtlesim.srv import Spawn
node = join("bench")
simulator = node.run("turtlesim", "turtlesim_node")
simulator.wait_for_service("/spawn", timeout=20)
for number in range(4):
    node.call("/spawn", Spawn, 2 + 2 * number, 2 + number, number, "")
"""
DRIVE = """
import os, sys
program = '''
import rospy
from geometry_msgs.msg import Twist
rospy.init_node("driver")
publishers = [rospy.Publisher(f"/turtle{number}/cmd_vel", Twist, queue_size=1) for number in range(1, 6)]
rate, order = rospy.Rate(10), Twist()
while not rospy.is_shutdown():
    for number, publisher in enumerate(publishers):
        order.linear.x, order.angular.z = 1 + number / 2, 1.0
        publisher.publish(order)
    rate.sleep()
'''
# NodeProcess has a supervisor, which ends the process when the kernel ends.
from course_pkg.ros import NodeProcess
driver = NodeProcess([sys.executable, "-c", program])
os.getpid()
"""


def turtles_main() -> None:
    """Print the frames per second, the bytes per second, and the CPU time of the kernel."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    seconds = parser.parse_args().seconds
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        with running_lab(Path(folder) / "lab") as lab, new_page(browser.new_context()) as page:
            received = counted(page)
            with running_notebook(page, lab, "turtles", SETUP, "TurtlePanel()", DRIVE):
                measure(page, received, seconds)
        browser.close()


def counted(page: Page) -> list[int]:
    """Return a list with one number: how many bytes the page's websockets have received."""
    received = [0]

    def count(socket: WebSocket) -> None:
        socket.on("framereceived", lambda frame: received.__setitem__(0, received[0] + len(frame)))

    page.on("websocket", count)
    return received


def measure(page: Page, received: list[int], seconds: float) -> None:
    """Print the frames, the bytes and the CPU time while the turtles move for `seconds` s."""
    turtles = panel(page, "Turtle panel")
    pid = int(page.locator(".jp-OutputArea-output").last.inner_text())
    page.wait_for_timeout(3000)
    frames, bytes_, load = _frames(turtles), received[0], _processor_time(pid)
    started = time.monotonic()
    page.wait_for_timeout(seconds * 1000)
    took = time.monotonic() - started
    print(f"frames {(_frames(turtles) - frames) / took:.1f} per second (≥ 50)")
    print(f"websocket {(received[0] - bytes_) / took / 1024:.1f} KiB/s (≤ 20)")
    print(f"kernel {100 * (_processor_time(pid) - load) / took:.1f} % of a core (≤ 3)")


def _frames(turtles: Locator) -> int:
    return int(turtles.get_attribute("data-frames") or 0)


def _processor_time(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    run_command(
        {
            "graph": graph_main,
            "timeline": timeline_main,
            "turtles": turtles_main,
        }
    )
