"""What watching five turtles costs: `./course run python tests/bench/turtle_panel.py`.

Bars: at least 50 frames a second drawn, at most 20 KiB a second on the websocket, at most 3 % of a core for
the kernel. Needs an idle machine, and the browser that `./course test` installs.
"""

from __future__ import annotations

import argparse
import os
import shutil
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Locator, Page, WebSocket, sync_playwright

from tests.browser.chromium import FLAGS
from tests.browser.jupyter import new_page, panel, running_lab, running_notebook

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
# The leash of a node ends it with the kernel; a plain process would outlive the bench.
from course_pkg.graph import NodeProcess
driver = NodeProcess([sys.executable, "-c", program])
os.getpid()
"""


def main() -> None:
    """Print the three figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    seconds = parser.parse_args().seconds
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        with running_lab(Path(folder) / "lab") as lab, new_page(browser) as page:
            received = counted(page)
            with running_notebook(page, lab, "turtles", SETUP, "TurtlePanel()", DRIVE):
                measure(page, received, seconds)
        browser.close()


def counted(page: Page) -> list[int]:
    """Return a list whose one number grows by the bytes that the page's websockets receive."""
    received = [0]

    def count(socket: WebSocket) -> None:
        socket.on("framereceived", lambda frame: received.__setitem__(0, received[0] + len(frame)))

    page.on("websocket", count)
    return received


def measure(page: Page, received: list[int], seconds: float) -> None:
    """Print frames, bytes and processor time over some seconds of driving."""
    turtles = panel(page, "Turtle panel")
    pid = int(page.locator(".jp-OutputArea-output").last.inner_text())
    page.wait_for_timeout(3000)
    frames, bytes_, load = _frames(turtles), received[0], _processor_time(pid)
    started = time.monotonic()
    page.wait_for_timeout(seconds * 1000)
    took = time.monotonic() - started
    print(f"frames {(_frames(turtles) - frames) / took:.1f} a second (≥ 50)")
    print(f"websocket {(received[0] - bytes_) / took / 1024:.1f} KiB/s (≤ 20)")
    print(f"kernel {100 * (_processor_time(pid) - load) / took:.1f} % of a core (≤ 3)")


def _frames(turtles: Locator) -> int:
    return int(turtles.get_attribute("data-frames") or 0)


def _processor_time(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main()
