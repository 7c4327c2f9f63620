"""Faults of the master, and of the connection to the master."""

from __future__ import annotations

import socket
from functools import partial

from course_pkg.faults.fault import Fault
from course_pkg.faults.programs import VISITOR, keeper
from course_pkg.faults.stage import Stage

_fault = partial(Fault, group="masters", chapter="12")
_asked = partial(_fault, visitor=VISITOR, story="A client calls the door's service.")

BARE = VISITOR.replace('rospy.init_node("visitor")\n', "")


def _no_master(stage: Stage) -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        stage.uri = f"http://localhost:{listener.getsockname()[1]}"


def _restart_master(stage: Stage) -> None:
    master = stage.own_master()
    stage.serve(keeper())
    master.stop()
    stage.own_master(master.port)


def _hang_master(stage: Stage) -> None:
    master = stage.own_master()
    stage.serve(keeper())
    stage.hang(master)


def _malform(stage: Stage) -> None:
    stage.visitor_env = {"ROS_MASTER_URI": stage.uri.removeprefix("http://")}
    stage.serve(keeper())


def _own_master(stage: Stage) -> None:
    stage.own_master()


MASTERS: tuple[Fault, ...] = (
    _asked(
        name="no_master",
        look="wait start",
        play=_no_master,
        diagnosis="No master runs, and init_node() keeps trying to reach one.",
        remedy="Start a master, or correct ROS_MASTER_URI.",
        reason=(
            "The program prints `Unable to register with master node … Will keep trying` only "
            "once. The program has not reached its call yet."
        ),
        hangs=True,
    ),
    _asked(
        name="no_master_call",
        look="gone connection",
        play=_no_master,
        visitor=BARE,
        diagnosis="No master runs, so the client cannot look up the service.",
        remedy="Start a master, or correct ROS_MASTER_URI.",
        reason=(
            "`unable to contact master`: without init_node(), the call is the first step that needs the"
            " master, and this call fails at once. The command-line tools print the same message."
        ),
    ),
    _asked(
        name="no_master_param",
        look="python",
        story="A program reads the width of the door from a parameter.",
        play=_no_master,
        visitor='import rospy\n\nprint(rospy.get_param("/lab/width", 0.9))\n',
        diagnosis="No master runs, so the program cannot read a parameter.",
        remedy="Start a master. Catch ConnectionRefusedError if the master may be missing.",
        reason=(
            "get_param() raises the socket's ConnectionRefusedError. The default value does not "
            "help, because rospy uses it only if a master answers and the parameter is not set."
        ),
    ),
    _asked(
        name="restarted_master",
        look="gone unavailable",
        story="The door's service has worked all day. Now a client calls it again.",
        play=_restart_master,
        diagnosis="The master was restarted and does not know the server, which still runs.",
        remedy="Start the server again, because rospy does not register it with the new master.",
        reason=(
            "The server's process works, but the new master's list of services is empty. rospy registers a "
            "service once, when it is created."
        ),
        unlike=("no_service", "wait_in_vain"),
    ),
    _asked(
        name="hung_master",
        look="wait call",
        play=_hang_master,
        diagnosis="The master accepts connections, but does not answer.",
        remedy=(
            "Resume the master's process with `kill -CONT`, or end this process and restart the "
            "master and all nodes."
        ),
        reason=(
            "All tools hang, too, because each of them calls the master first. The operating system "
            "still accepts connections for a stopped process."
        ),
        hangs=True,
    ),
    _fault(
        name="port_taken",
        look="gone connection",
        chapter="01",
        story="A student starts a master.",
        play=_own_master,
        visitor="$ roscore -p MASTER_PORT",
        diagnosis="A master already runs on this port.",
        remedy="Use the running master, or start the second one on another port.",
        reason="roscore checks the port before it starts, and ends with status 1.",
        unlike=("port_taken_rosmaster",),
    ),
    _fault(
        name="port_taken_rosmaster",
        look="wait start",
        chapter="01",
        story="A student starts a master without roscore.",
        play=_own_master,
        visitor="$ rosmaster --core -p MASTER_PORT",
        diagnosis="Another program uses the port, and the new master's process runs without doing anything.",
        remedy=(
            "End the new master's process, and find out which program uses the port before you "
            "start a master again."
        ),
        reason=(
            "rosmaster prints `[Errno 98] Address already in use` and never ends. So a running process "
            "does not prove that the master answers."
        ),
        hangs=True,
    ),
    _asked(
        name="malformed_uri",
        look="wait start",
        play=_malform,
        diagnosis="ROS_MASTER_URI is not a valid address, but init_node() keeps trying to reach a master.",
        remedy="Write the whole address: http://localhost:11311.",
        reason=(
            "An address begins with http://. Without http://, init_node() behaves as if the master "
            "had not started yet. The tools show that the master and the server work."
        ),
        hangs=True,
    ),
    _asked(
        name="malformed_uri_call",
        look="python",
        play=_malform,
        visitor=BARE,
        diagnosis="ROS_MASTER_URI is not a valid address, so the call cannot begin.",
        remedy="Write the whole address: http://localhost:11311.",
        reason="The call raises a ValueError, `invalid master URI`, and not a ServiceException.",
    ),
)
