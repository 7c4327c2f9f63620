"""What a topic panel costs the kernel that shows it, how often it tells the page, and how it keeps a rate.

A real kernel shows the panel; the page is a client that reads what the kernel sends it.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Empty

from jupyter_client.blocking.client import BlockingKernelClient
from jupyter_client.manager import KernelManager

from course_pkg.graph import PrivateMaster

WATCH = 10.0  # s
BAR = 5.0  # % of a core at 100 Hz
UPDATES = 10.0  # a second, at most
DRIFT = 2.0  # % of a rate

SHOW = """
import os
from course_pkg import TopicPanel, join
node = join("bench")
panel = TopicPanel("/speed", "std_msgs/Float64")
panel._dispatch(panel, {"kind": "hello", "view": "one"}, [])
print(os.getpid(), panel._station.pid)
"""
REPEAT = """
panel.received("act", {"action": "repeat", "draft": {"data": "1.5"},
               "settings": {"rate": "RATE", "queue": "10", "latch": False, "path": "data"}})
"""
KEPT = "print(panel.spoken['pace'].get('rate', 0))"
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
    """Run code in the kernel and return what it printed."""
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
    """Publish at a rate from a process of its own."""
    process = subprocess.Popen([sys.executable, "-c", TALKER, str(rate)])
    try:
        time.sleep(3)
        yield
    finally:
        process.terminate()
        process.wait()


def spent(pid: int) -> float:
    """Return the processor time of a process (s)."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def watch(client: BlockingKernelClient, pids: list[int]) -> tuple[list[float], float, float]:
    """Return the share of a core of each process (%), updates a second to the page, and kB a second."""
    before, began, updates, size = [spent(pid) for pid in pids], time.monotonic(), 0, 0
    while (left := began + WATCH - time.monotonic()) > 0:
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
    """Throw away what the page has been told so far."""
    while True:
        try:
            client.get_iopub_msg(timeout=0.05)
        except Empty:
            return


def main() -> int:
    """Print the figures; fail when one misses its bar."""
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
                missed += (rate == 100 and kernel > BAR) or updates > UPDATES
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
    print(f"bars: {BAR:.0f} % of a core at 100 Hz, {UPDATES:.0f} updates/s, {DRIFT:.0f} % of the rate")
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
