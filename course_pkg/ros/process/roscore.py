"""Start the same things as `roscore`: a master, its parameters, and the node /rosout."""

from __future__ import annotations

import os
import re
import shutil
import uuid
from pathlib import Path

from course_pkg.errors import NodeFailed, SetupError
from course_pkg.ros.process.master import OTHER_ADDRESSES, PrivateMaster, local_environment
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.waiting import at_this_load, wait_until

ROSOUT = "/rosout"  # The node and its topic both have this name.
# Wait up to this time in s for /rosout. The registration usually takes 0.05 s; on a busy machine, it takes
# much longer.
READY = 15.0
INTERVAL = 0.005  # This is the time in s between two polls of /rosout.
VERSION = re.compile(r"<version[^>]*>\s*([^<\s]+)")


class Roscore(PrivateMaster):
    """A private master with the same node and parameters as `roscore`, for a graph that a student inspects.

    A Roscore also runs the node /rosout and sets the parameters /rosdistro, /rosversion and /run_id. A
    PrivateMaster is only one process and starts faster.
    """

    def __init__(self, port: int | None = None) -> None:
        super().__init__(port)
        self._rosout: SupervisedProcess | None = None

    def start(self) -> Roscore:
        """Start the master and /rosout, and wait until both are registered.

        Raises the errors of PrivateMaster.start(), SetupError if the package rosout is missing, and
        NodeFailed if /rosout does not start.
        """
        super().start()
        try:
            self._start_rosout()
        except BaseException:
            self.stop()
            raise
        return self

    def stop(self) -> None:
        """End /rosout and the master; a second call has no effect."""
        rosout, self._rosout = self._rosout, None
        if rosout is not None:
            rosout.end(grace=0)  # The master ends next, so /rosout need not unregister.
        super().stop()

    def _start_rosout(self) -> None:
        client = MasterClient(self.uri)
        prefix = _prefix()
        for name, value in _parameters(prefix).items():
            client.set_param(name, value)
        program = prefix / "lib" / "rosout" / "rosout"
        if not program.is_file():
            raise SetupError(f"{program} does not exist. Run `./course doctor` to list what is missing.")
        environment = {**local_environment(), "ROS_MASTER_URI": self.uri, "ROS_LOG_DIR": str(self.logs)}
        rosout = self._rosout = SupervisedProcess([str(program), "__name:=rosout"], env=environment)

        def settled() -> str:
            ended = rosout.returncode is not None
            return "met" if _receives(client) else "ended" if ended else ""

        if wait_until(settled, at_this_load(READY), INTERVAL) != "met":
            raise NodeFailed(
                f"The node {ROSOUT} has ended, or does not appear on the graph. Start this node again.",
                "",
                rosout.returncode,
            )


def find_or_start_master() -> Roscore | MasterClient:
    """Return the master at ROS_MASTER_URI if the variable is set, or start a private master and return it.

    The private master's address is written to ROS_MASTER_URI, for rospy and for new child processes. Raises a
    GraphError if the master at ROS_MASTER_URI does not answer.
    """
    if given := os.environ.get("ROS_MASTER_URI"):
        client = MasterClient(given)
        client.pid()
        return client
    master = Roscore().start()
    for name in OTHER_ADDRESSES:
        os.environ.pop(name, None)
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_HOSTNAME="localhost")
    return master


def _prefix() -> Path:
    """Return the folder in which ROS is installed, such as /usr or /opt/ros/noetic."""
    return Path(shutil.which("rosmaster") or "/usr/bin/rosmaster").parents[1]


def _parameters(prefix: Path) -> dict[str, str]:
    package = prefix / "share" / "roslaunch" / "package.xml"
    version = VERSION.search(package.read_text("utf-8")) if package.is_file() else None
    return {
        "/rosdistro": f"{os.environ.get('ROS_DISTRO', 'unknown')}\n",
        "/rosversion": f"{version[1] if version else 'unknown'}\n",
        "/run_id": str(uuid.uuid1()),
    }


def _receives(client: MasterClient) -> bool:
    """Return whether /rosout has subscribed to the log messages, the last step of its start."""
    return ROSOUT in client.system_state().subscribers.get(ROSOUT, ())
