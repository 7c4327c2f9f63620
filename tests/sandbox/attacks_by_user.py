"""Runs attacks in the sandbox that runs submissions as other users; prints the results as JSON.

The arguments of the program are a folder that no student may read, and files that no student may change.
"""

from __future__ import annotations

import json
import os
import sys
import textwrap

import psutil

from course_pkg.checking.fixtures import around
from course_pkg.checking.parts import find
from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.linux import users
from course_pkg.sandbox.worker_client import SandboxWorker

BEFORE, AFTER = around("05.1")
RIGHT = """
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)
geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)
"""
WRONG = RIGHT.replace("request.width * request.length", "1.0")
# Each line of PROBES is a Python expression. Each expression must raise an error or be false, except the
# expression in the first line.
PROBES = """
os.getuid() == UID
open(SECRET[0]).read()
open(SECRET[1]).read()
open(SECRET[0], "a").close()
open(SECRET[1], "a").close()
os.listdir(FOLDER)
os.symlink(SECRET[0], "link") or open("link").read()
os.link(SECRET[0], "hard")
os.rename(FOLDER, FOLDER + ".away")
open(f"/proc/{GRADER}/environ").read()
open(f"/proc/{GRADER}/mem", "rb").read(1)
os.listdir(f"/proc/{GRADER}/fd")
os.kill(GRADER, 9) or True
os.kill(os.getppid(), 9) or True
libc.ptrace(16, GRADER, 0, 0) + 1
libc.ptrace(16, os.getppid(), 0, 0) + 1
libc.setuid(0) + 1
libc.unshare(0x10000000) + 1
libc.mount(b"none", b"/tmp", b"tmpfs", 0, None) + 1
open(course_pkg.__file__, "a").close()
open("/etc/shadow").read()
os.environ.get("SECRET_OF_THE_GRADER")
os.setuid(UID + 1) or True
[each for each in os.listdir("/proc/self/fd") if os.path.realpath(f"/proc/self/fd/{each}").startswith(FOLDER)]
"""
PROBE = """
import ctypes, json, os, course_pkg
libc = ctypes.CDLL(None, use_errno=True)
FOLDER, SECRET, GRADER, UID = {folder!r}, {secret!r}, {grader}, os.getuid()
done = []
for probe in {probes!r}:
    try:
        if probe.startswith("open") and probe.endswith("close()"):
            eval(probe)
            done.append(probe)
        elif eval(probe):
            done.append(probe)
    except Exception:
        pass
raise RuntimeError("done: " + json.dumps([UID, done]))
"""
FORK_BOMB = """
import os, time
for _ in range(5000):
    try:
        if not os.fork():
            os.setsid()
            time.sleep(600)
    except OSError:
        break
"""
FULL_DISK = """
import itertools, time
for number in itertools.count():
    with open(f"/var/tmp/filler-{number}", "wb") as file:
        file.write(bytes(32 << 20))
    time.sleep(0.05)
"""
FILLED = "/var/tmp"  # noqa: S108 -- the attack writes there
DAEMON = """
import os, time
if not os.fork():
    os.setsid()
    if not os.fork():
        for descriptor in range(256):
            try:
                os.close(descriptor)
            except OSError:
                pass
        time.sleep(600)
    os._exit(0)
"""
KILL_ALL = """
import os
os.kill(-1, 15)
"""
REGISTER = """
import os, xmlrpc.client
master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
master.registerService("/chapter_05", "/getGeometry", "rosrpc://localhost:1", "http://localhost:1/")
"""


def main() -> None:
    """Run the attacks, and run a right answer after each attack."""
    folder, *secret = sys.argv[1:]
    refusal = users.refusal([*map(users.Path, secret)])
    os.environ["SECRET_OF_THE_GRADER"] = "yes"  # noqa: S105 -- a marker
    with SandboxWorker(users=True) as worker:
        said = _run(worker, _probe(folder, secret)).messages
        uid, done = json.loads(
            next(each["error"] for each in said if "done:" in each["error"]).partition("done: ")[2]
        )
        attacks = {
            "fork bomb": FORK_BOMB + WRONG,
            "full disk": FULL_DISK,
            "daemon": DAEMON + WRONG,
            "kill all": KILL_ALL + WRONG,
            "another registration": REGISTER + WRONG,
        }
        points, later, left = {}, {}, {}
        for name, attack in attacks.items():
            points[name] = _points(_run(worker, attack))
            left[name] = [each.pid for each in psutil.process_iter(["uids"]) if uid in each.info["uids"]]
            left[name] += [each for each in os.listdir(FILLED) if each.startswith("filler")]
            later[name] = _points(_run(worker, RIGHT))
    found = {"refusal": refusal, "uid": uid, "done": done, "points": points, "later": later, "left": left}
    sys.stdout.write(json.dumps(found))


def _probe(folder: str, secret: list[str]) -> str:
    probes = PROBES.strip().splitlines()
    return PROBE.format(folder=folder, secret=secret, grader=os.getpid(), probes=probes)


def _run(worker: SandboxWorker, source: str) -> PartResult:
    job = PartJob("05.1", BEFORE, (textwrap.dedent(source),), AFTER, 1, find("05.1").deadline, 10.0, 4.0)
    return worker.run(job)


def _points(result: PartResult) -> int:
    return int((result.record or {}).get("points", 0))


if __name__ == "__main__":
    main()
