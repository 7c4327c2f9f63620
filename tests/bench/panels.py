"""Measures panels: the cost of each panel for the kernel and for the page.

usage: ./course run python -m tests.bench.panels graph|timeline|topic|types|turtles [OPTION …]
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
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Empty

from jupyter_client.blocking.client import BlockingKernelClient
from jupyter_client.manager import KernelManager
from playwright.sync_api import Locator, Page, WebSocket, sync_playwright

from course_pkg.panels import GraphPanel, TypeBrowser
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
from tests.bench.commands import run_command, times_of
from tests.browser.chromium import FLAGS
from tests.browser.jupyter import running_lab, running_notebook
from tests.browser.pages import new_page, panel

# graph: measures an update of the graph panel with 20 nodes and 40 topics, and the CPU time for an unchanged
# graph.

UPDATE_BAR = 150.0  # An update may take up to this time in ms.
IDLE_BAR = 2.0  # The panel may use at most this percentage of a core.
NODES, TOPICS = 20, 40
GRAPH_WATCH, SETTLE = 10.0, 10.0  # s
RATE = 5  # Each topic has this rate in Hz.

# This program is a node. The arguments are the topics that the node publishes, and the topics to which the
# node subscribes.
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
    """Return a graph; the name of one topic depends on the given number."""
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
    """Return the panel's percentage of a core and its number of updates while 20 nodes use 40 topics."""
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
    """Print the results. Return 1 if a result is not within its limit."""
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

# The first drawing may take up to this time in ms. While the view moves, the page must draw at least this
# many frames per second.
DRAW_BAR, PAN_BAR = 500.0, 30.0
# The benchmark draws the timeline this many times, and moves the view for this time in ms.
REPEATS, TIMELINE_WATCH = 9, 2000
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
    """Print the results. Return 1 if a result is not within its limit."""
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
    """Return the events of a call that begins at a given time (in s)."""
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


# topic: measures the CPU time of a topic panel, the number of its updates, and the accuracy of its rate. A
# real kernel runs the panel. The benchmark opens no page; a client reads the kernel's messages.

TOPIC_WATCH = 10.0  # s
TOPIC_BAR = 5.0  # The panel may use at most this percentage of a core at 100 Hz.
UPDATES = 10.0  # The panel may send at most this many updates per second.
DRIFT = 2.0  # The displayed rate may differ from the real rate by at most this percentage.

SHOW = """
import os
from course_pkg import TopicPanel, join
node = join("bench")
panel = TopicPanel("/speed", "std_msgs/Float64")
panel._dispatch(panel, {"kind": "hello", "view": "one"}, [])
print(os.getpid(), panel._process.pid)
"""
REPEAT = """
panel.received("act", {"action": "repeat", "draft": {"data": "1.5"},
               "settings": {"rate": "RATE", "queue": "10", "latch": False, "path": "data"}})
"""
KEPT = "print(panel.publisher['statistics'].get('rate', 0))"
TALKER = """
import sys, time, rospy
from std_msgs.msg import Float64
rospy.init_node("talker")
publisher = rospy.Publisher("/speed", Float64, queue_size=100)
rate, start = float(sys.argv[1]), time.monotonic()
for number in range(10**9):
    if rospy.is_shutdown():
        break
    publisher.publish(float(number % 1000))
    time.sleep(max(0, start + number / rate - time.monotonic()))
"""


def run(client: BlockingKernelClient, code: str) -> str:
    """Run code in the kernel, and return its printed output."""
    printed: list[str] = []
    reply = client.execute_interactive(
        code,
        timeout=60,
        output_hook=lambda message: printed.append(message["content"].get("text", "")),
    )
    assert reply["content"]["status"] == "ok", reply["content"]
    return "".join(printed).strip()


@contextmanager
def talker(rate: float) -> Iterator[None]:
    """Publish at the given rate (Hz) from a separate process during the `with` block."""
    process = subprocess.Popen([sys.executable, "-c", TALKER, str(rate)])
    try:
        time.sleep(3)
        yield
    finally:
        process.terminate()
        process.wait()


def spent(pid: int) -> float:
    """Return the CPU time of a process in s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def watch(client: BlockingKernelClient, pids: list[int]) -> tuple[list[float], float, float]:
    """Return the CPU use of each process (% of a core), the updates per second, and the kB per second."""
    before, began, updates, size = [spent(pid) for pid in pids], time.monotonic(), 0, 0
    while (left := began + TOPIC_WATCH - time.monotonic()) > 0:
        try:
            message = client.get_iopub_msg(timeout=left)
        except Empty:
            break
        updates += message["msg_type"] == "comm_msg"
        size += len(str(message["content"]))
    took = time.monotonic() - began
    shares = [100 * (spent(pid) - old) / took for pid, old in zip(pids, before, strict=True)]
    return shares, updates / took, size / took / 1000


def drain(client: BlockingKernelClient) -> None:
    """Read and ignore all waiting updates."""
    while True:
        try:
            client.get_iopub_msg(timeout=0.05)
        except Empty:
            return


def topic_main() -> int:
    """Print the results. Return 1 if a result is not within its limit."""
    missed = 0
    with PrivateMaster() as master:
        os.environ["ROS_MASTER_URI"], os.environ["ROS_HOSTNAME"] = master.uri, "localhost"
        manager = KernelManager(kernel_name="python3")
        manager.start_kernel()
        client = manager.blocking_client()
        client.start_channels()
        client.wait_for_ready(timeout=60)
        try:
            pids = [int(word) for word in run(client, SHOW).split()[-2:]]
            time.sleep(3)
            for name, rate in {"a silent topic": 0.0, "100 Hz": 100.0, "1 kHz": 1000.0}.items():
                with talker(rate or 0.01):
                    drain(client)
                    (kernel, node), updates, size = watch(client, pids)
                print(
                    f"{name}: kernel {kernel:.1f} %, the panel's node {node:.1f} % of a core; "
                    f"{updates:.1f} updates/s, {size:.0f} kB/s to the page"
                )
                missed += (rate == 100 and kernel > TOPIC_BAR) or updates > UPDATES
            for rate in ("0.5", "10", "100"):
                run(client, REPEAT.replace("RATE", rate))
                time.sleep(max(5.0, 6 / float(rate)))
                kept = float(run(client, KEPT).split()[-1])
                drift = 100 * (kept / float(rate) - 1)
                print(f"publishing at {rate} Hz: {kept:.3f} Hz, {drift:+.2f} %")
                missed += abs(drift) > DRIFT
        finally:
            client.stop_channels()
            manager.shutdown_kernel()
    print(f"bars: {TOPIC_BAR:.0f} % of a core at 100 Hz, {UPDATES:.0f} updates/s, {DRIFT:.0f} % of the rate")
    return int(missed > 0)


# types: measures the time until the type browser is open, with the types of this machine and with additional
# types. The benchmark compares this time with the duration of `rossrv list`, which lists the same service
# types in a terminal.

TYPES_BAR = 100.0  # The type browser may need up to this time in ms to open, after the import.
PACKAGES, TYPES = 60, 10
RUNS = 9
MANIFEST = "<package format='2'><name>{}</name><version>1.0.0</version></package>"


def fill(folder: Path) -> None:
    """Write `PACKAGES` packages into a folder, each with `TYPES` service types and `TYPES` message types."""
    for number in range(PACKAGES):
        root = folder / f"bulk_{number}"
        for half, text in (("srv", "geometry_msgs/Pose goal\n---\nbool done\n"), ("msg", "float64 x\n")):
            (root / half).mkdir(parents=True)
            for short in range(TYPES):
                (root / half / f"Type{short}.{half}").write_text(text)
        (root / "package.xml").write_text(MANIFEST.format(root.name))


def median_of(action: Callable[[], object]) -> float:
    """Return the median time of an action in ms."""
    return statistics.median(times_of(action, RUNS))


def report(what: str) -> float:
    """Print the durations for the current ROS_PACKAGE_PATH, and return the first duration in ms."""
    first = time.perf_counter()
    TypeBrowser("std_srvs/SetBool")
    first = 1000 * (time.perf_counter() - first)
    empty, opened = median_of(TypeBrowser), median_of(lambda: TypeBrowser("std_srvs/SetBool"))
    peer = median_of(lambda: subprocess.run(["rossrv", "list"], check=True, stdout=subprocess.DEVNULL))
    print(f"{what}: first {first:.0f} ms, then TypeBrowser() {empty:.0f} ms, with a type {opened:.0f} ms")
    print(f"  rossrv list: {peer:.0f} ms; ratio {empty / peer:.2f}")
    return first


def types_main() -> int:
    """Print the results. Return 1 if the first duration is above its limit."""
    with PrivateMaster() as master, tempfile.TemporaryDirectory() as folder:
        os.environ.update(ROS_MASTER_URI=master.uri, ROS_HOSTNAME="localhost")
        first = report("this machine")
        fill(Path(folder))
        os.environ["ROS_PACKAGE_PATH"] = f"{folder}:{os.environ['ROS_PACKAGE_PATH']}"
        report(f"with {PACKAGES * TYPES} more services and messages")
    print(f"bar for the first opening: {TYPES_BAR:.0f} ms")
    return int(first > TYPES_BAR)


# turtles: measures the cost of a turtle panel with five moving turtles. The benchmark `turtles` needs an idle
# machine. `./course test` installs the browser. The limits are at least 50 frames per second, at most 20
# KiB/s on the websocket, and at most 3 % of a core for the kernel.

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
    """Let the turtles move for some seconds, and print the numbers of frames and bytes, and the CPU time."""
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
            "topic": topic_main,
            "types": types_main,
            "turtles": turtles_main,
        }
    )
