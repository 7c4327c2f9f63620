"""Faults of the master, and of the way to it."""

from __future__ import annotations

import socket
from functools import partial
from typing import TYPE_CHECKING

from course_pkg.faults.fault import Fault
from course_pkg.faults.texts import VISITOR, keeper

if TYPE_CHECKING:
    from course_pkg.faults.stage import Stage

_fault = partial(Fault, group="masters", chapter="10")
_asked = partial(_fault, visitor=VISITOR, story="The door is asked to open.")

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
        diagnosis="There is no master, and init_node() goes on looking for one.",
        remedy="Start a master, or correct ROS_MASTER_URI.",
        reason="`Unable to register with master node … Will keep trying` comes once, then nothing more. The "
        "program has not even come to its call.",
        hangs=True,
    ),
    _asked(
        name="no_master_call",
        look="gone connection",
        play=_no_master,
        visitor=BARE,
        diagnosis="There is no master to ask where the service is.",
        remedy="Start a master, or correct ROS_MASTER_URI.",
        reason="`unable to contact master`: without init_node() the call itself is the first to miss it, and "
        "says so at once. The tools say the same.",
    ),
    _asked(
        name="no_master_param",
        look="python",
        story="The width of the door is looked up in a parameter.",
        play=_no_master,
        visitor='import rospy\n\nprint(rospy.get_param("/lab/width", 0.9))\n',
        diagnosis="There is no master to ask for a parameter.",
        remedy="Start a master; catch ConnectionRefusedError where one may be missing.",
        reason="get_param() lets the socket's own ConnectionRefusedError through, in spite of its default: "
        "the default is for a parameter that is not set.",
    ),
    _asked(
        name="restarted_master",
        look="gone unavailable",
        story="The door has opened all day. Now it is asked once more.",
        play=_restart_master,
        diagnosis="The master was restarted, and knows nothing of the server, which still runs.",
        remedy="Start the server again: rospy does not register it a second time.",
        reason="The keeper's process is well, and a new master has an empty list. rospy registers a service "
        "once, when it is declared.",
        unlike=("no_service", "wait_in_vain"),
    ),
    _asked(
        name="hung_master",
        look="wait call",
        play=_hang_master,
        diagnosis="The master takes connections and does not answer.",
        remedy="Let the master's process go on, or end it and start everything again.",
        reason="Every tool hangs, too, since each asks the master first. A stopped process still gets "
        "connections from the system.",
        hangs=True,
    ),
    _fault(
        name="port_taken",
        look="gone connection",
        chapter="01",
        story="A master is to be started.",
        play=_own_master,
        visitor="$ roscore -p MASTER_PORT",
        diagnosis="A master runs on this port already.",
        remedy="Use the one that runs, or start the second on another port.",
        reason="roscore looks before it starts, and ends with status 1.",
        unlike=("port_taken_rosmaster",),
    ),
    _fault(
        name="port_taken_rosmaster",
        look="wait start",
        chapter="01",
        story="A master is started without roscore.",
        play=_own_master,
        visitor="$ rosmaster --core -p MASTER_PORT",
        diagnosis="The port is taken, and the program that wanted it stays, of no use to anybody.",
        remedy="End it, and look who has the port before starting another.",
        reason="rosmaster prints `[Errno 98] Address already in use` and never ends. So whether it runs says "
        "nothing about whether it serves.",
        hangs=True,
    ),
    _asked(
        name="malformed_uri",
        look="wait start",
        play=_malform,
        diagnosis="ROS_MASTER_URI is not written as an address, and init_node() waits all the same.",
        remedy="Write it whole: http://localhost:11311.",
        reason="Without http:// in front it is no address, and init_node() treats that like a master that is "
        "not there yet. The master and the server are well, as the tools show.",
        hangs=True,
    ),
    _asked(
        name="malformed_uri_call",
        look="python",
        play=_malform,
        visitor=BARE,
        diagnosis="ROS_MASTER_URI is not written as an address, so that the call cannot even begin.",
        remedy="Write it whole: http://localhost:11311.",
        reason="`invalid master URI` is a ValueError, and no ServiceException.",
    ),
)
