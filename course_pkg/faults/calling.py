"""Faults in a call: how it is made, and what has become of the server."""

from __future__ import annotations

import socket
from functools import partial
from typing import TYPE_CHECKING

from course_pkg.faults.fault import Fault
from course_pkg.faults.texts import VISITOR, asking, calling, keeper, kill_server, nothing, running, serving
from course_pkg.graph.ports import port_of
from course_pkg.graph.rpc import MasterClient

if TYPE_CHECKING:
    from course_pkg.faults.stage import Stage

NO_HOST = "robot-2"  # a name that this machine cannot look up

_well = partial(Fault, group="calling", chapter="06", play=serving('return SetBoolResponse(True, "open")'))
_python = partial(
    _well, look="python", story="The door is asked to open, and the program ends with an error."
)
_broken = partial(
    Fault,
    group="calling",
    chapter="10",
    visitor=VISITOR,
    story="The door has opened all day. Now it is asked once more.",
)

SLOW_KEEPER = keeper().replace(
    'rospy.Service("/lab/door"', 'rospy.sleep(60)  # the motor warms up\nrospy.Service("/lab/door"'
)

RESTARTED = """\
import multiprocessing
import os
import threading

import rospy
from std_srvs.srv import SetBool, SetBoolResponse

def handle(request):
    if multiprocessing.parent_process():
        threading.Timer(0.1, os._exit, [1]).start()  # the first one crashes after its first answer
    return SetBoolResponse(True, "open" if request.data else "shut")

def serve():
    rospy.init_node("keeper")
    rospy.Service("/lab/door", SetBool, handle)
    rospy.spin()

first = multiprocessing.get_context("fork").Process(target=serve)
first.start()
first.join()
serve()  # and is started again
"""

KEEPS_CALLING = """\
import time

import rospy
from std_srvs.srv import SetBool

rospy.init_node("visitor")
move_door = rospy.ServiceProxy("/lab/door", SetBool, persistent=True)
print(move_door(True).message)
time.sleep(1)
for attempt in range(3):
    try:
        print(move_door(False).message)
    except Exception as error:
        print(f"{type(error).__name__}: {error}")
"""

SHARED = """\
import threading

import rospy
from std_srvs.srv import SetBool

rospy.init_node("visitor")
move_door = rospy.ServiceProxy("/lab/door", SetBool, persistent=True)
wrong = []

def ask(wanted, expected):
    for _ in range(100):
        try:
            message = move_door(wanted).message
        except Exception as error:
            message = f"{type(error).__name__}: {error}"
        if message != expected:
            wrong.append(f"asked for {expected}, got {message}")

pairs = [(True, "open"), (False, "shut")] * 2
threads = [threading.Thread(target=ask, args=pair, daemon=True) for pair in pairs]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join(0.4)
print("\\n".join(wrong[:3]))
print("some answers went to the wrong thread, or nowhere:", bool(wrong) or any(t.is_alive() for t in threads))
"""


def _freeze(stage: Stage) -> None:
    stage.serve(keeper()).freeze()


def _hog(stage: Stage) -> None:
    """Connect to the server and say nothing, as a port scan or a hanging client does."""
    stage.serve(keeper())
    uri = MasterClient(stage.uri).lookup_service(stage.door) or ""
    stage.later(socket.create_connection(("127.0.0.1", port_of(uri)), timeout=2.0).close)


def _misname(stage: Stage) -> None:
    """Serve under a host name that leads nowhere; so nobody can ask whether the server answers."""
    master = MasterClient(stage.uri)
    # With the name localhost, rospy refuses other names in words of its own before it looks them up.
    stage.visitor_env = {"ROS_HOSTNAME": "127.0.0.1"}
    program = stage.keep(keeper(), {"ROS_HOSTNAME": NO_HOST})
    stage.await_that(lambda: master.lookup_service(stage.door), program)


def _start_slowly(stage: Stage) -> None:
    master = MasterClient(stage.uri)
    program = stage.keep(SLOW_KEEPER)
    stage.await_that(lambda: master.lookup_node(f"{stage.namespace}/keeper"), program)


CALLING: tuple[Fault, ...] = (
    _well(
        name="no_service",
        look="gone unavailable",
        story="The door is asked to open.",
        visitor=VISITOR.replace("/lab/door", "/lab/dor"),
        diagnosis="The client asks for a name that nobody serves: the two are spelt differently.",
        remedy="Compare the name in the client with `rosservice list`.",
        reason="`unavailable` means that the master has no provider of this name. The server is there, and "
        "its name has one letter more.",
    ),
    _well(
        name="wait_in_vain",
        look="gone unavailable",
        story="The door is asked to open, as soon as there is one.",
        play=_start_slowly,
        visitor=asking('rospy.wait_for_service("/lab/door", timeout=1)', "import std_srvs.srv"),
        diagnosis="The server's node is up, and serves the name only after the client's wait is over.",
        remedy="Wait longer than the server takes to start, or try again after a while.",
        reason="wait_for_service() gave up after its second: `rosnode list` shows the keeper, and "
        "`rosservice list` has no door yet.",
        unlike=("no_service",),
    ),
    _well(
        name="wait_for_ever",
        look="wait start",
        story="The door is asked to open, as soon as there is one.",
        play=nothing,
        visitor=asking('rospy.wait_for_service("/lab/door")', "import std_srvs.srv"),
        diagnosis="The client waits, without a limit, for a server that was never started.",
        remedy="Start the server, and give wait_for_service() a timeout.",
        reason="`rosservice list` has no door and `rosnode list` no keeper. Without a timeout "
        "wait_for_service() waits for ever, and says nothing.",
        hangs=True,
    ),
    _python(
        name="zero_timeout",
        play=nothing,
        visitor=asking('rospy.wait_for_service("/lab/door", timeout=0)', "import std_srvs.srv"),
        diagnosis="wait_for_service() is given a time of 0, which it does not take.",
        remedy="Give it some seconds, or leave the wait out and catch the exception of the call.",
        reason="`timeout must be non-zero` is a ValueError of the client's own: nobody was asked anything.",
    ),
    _python(
        name="too_few",
        visitor=calling('print(move_door(True, "slowly"))'),
        diagnosis="The call gives more, or fewer, values by position than the request has fields.",
        remedy="Give one value for each field, or name the fields.",
        reason="It is a TypeError, and no ServiceException: the request could not be made, so nothing was "
        "sent. `except rospy.ServiceException` would not have caught it.",
    ),
    _python(
        name="mixed",
        visitor=calling("print(move_door(True, data=True))"),
        diagnosis="The call gives values by position and by keyword at once.",
        remedy="Give all values in one way.",
        reason="The message speaks of publish(): services and topics make their messages with the same code.",
    ),
    _python(
        name="misspelt",
        visitor=calling("print(move_door(dat=True))"),
        diagnosis="The call names a field that the request does not have.",
        remedy="Compare the name with the request in `rossrv show`.",
        reason="`dat is not an attribute of SetBoolRequest`: an AttributeError of the client's own, before "
        "anything was sent.",
    ),
    _well(
        name="left_out",
        look="quiet call",
        story="The door is asked to open, and the answer is another one than hoped for.",
        play=running(keeper()),
        visitor=calling("print(move_door())"),
        diagnosis="The call leaves a field out, which is then False or 0 without a word.",
        remedy="Give every field a value, by name.",
        reason="A field that is not given has the zero of its type. Nothing tells that from a False that was "
        "meant.",
    ),
    _python(
        name="wrong_value",
        visitor=calling('print(move_door("yes"))'),
        diagnosis="A value in the call is of another type than its field.",
        remedy="Convert the value to the type of its field before the call.",
        reason="The request was made and could not be packed: a SerializationError in the client, and no "
        "ServiceException.",
    ),
    _broken(
        name="md5",
        look="gone connection",
        chapter="04",
        story="The door is asked to open.",
        play=serving('return SetBoolResponse(True, "open")'),
        visitor=VISITOR.replace("SetBool", "Trigger").replace("(True)", "()"),
        diagnosis="Client and server do not mean the same type of service.",
        remedy="Compare `rosservice type` and `rossrv md5`, and use one definition on both sides.",
        reason="`md5sums do not match`: the server compares a sum over the definition before it reads any "
        "request. Here one side has Trigger, the other SetBool.",
    ),
    _broken(
        name="stale",
        look="gone connection",
        play=kill_server,
        diagnosis="The server was killed, and the master still lists it.",
        remedy="Start the server again, or remove the dead entry with `rosnode cleanup`.",
        reason="The master led the client to a port where nobody listens any more: `Connection refused`. A "
        "process that is killed by SIGKILL cannot sign off.",
        unlike=("killed",),
    ),
    _broken(
        name="died",
        look="gone connection",
        play=running("import os\n" + keeper("os._exit(1)  # the motor takes the power supply down")),
        diagnosis="The server took the request, and ended before it answered.",
        remedy="Start the server again and repeat the call, if doing it twice does no harm.",
        reason="`unable to receive data from sender`: the connection stood, and broke while the client was "
        "waiting. Nobody knows how far the work has come.",
        unlike=("stale",),
    ),
    _broken(
        name="stopped",
        look="wait call",
        play=_freeze,
        diagnosis="The server's process is stopped: it is there and does nothing.",
        remedy="Let the process go on: `kill -CONT`, or `fg` where Ctrl-Z was pressed.",
        reason="The system still takes connections for it, so that wait_for_service() succeeds; but no "
        "thread of the process runs. `rosnode ping` gets no answer either.",
        hangs=True,
    ),
    _broken(
        name="hogged",
        look="wait call",
        play=_hog,
        diagnosis="A client that connected and says nothing keeps the server from all others.",
        remedy="End that client; have the server read each header on a thread of its own.",
        reason="rospy reads the header of each connection on the one thread that accepts them. `rosnode "
        "ping` goes by another way and is answered, while no probe of the service is. prepare_node() of the "
        "course is the way round.",
        hangs=True,
    ),
    _broken(
        name="persistent",
        look="gone connection",
        chapter="09",
        story="A door is opened. Its keeper crashes and is started again, and the door is to be shut.",
        play=running(RESTARTED),
        visitor=KEEPS_CALLING,
        diagnosis="The client keeps a connection to a server that is gone, and never makes a new one.",
        remedy="Close the persistent proxy and make a new one, or call without persistent=True.",
        reason="A persistent proxy asks the master once. After the restart each call fails in other words: "
        "first the transport, then a broken pipe, then 'tell'. The new server is never asked.",
    ),
    _broken(
        name="hostname",
        look="gone connection",
        play=_misname,
        diagnosis="The server is registered under a host name that cannot be looked up here.",
        remedy="Start the server with ROS_HOSTNAME=localhost, or a name that all machines know.",
        reason="The server is listed and runs, but its address is of no use: `rosservice uri` shows the "
        "name. The node takes it from ROS_HOSTNAME and does not try it.",
    ),
    _well(
        name="shared_proxy",
        look="quiet call",
        chapter="10",
        story="Four threads ask the door again and again. Each should get the answer to its own question.",
        play=running(keeper()),
        visitor=SHARED,
        diagnosis="Several threads share one persistent proxy, and read each other's answers.",
        remedy="Give each thread a proxy of its own, or hold a lock around each call.",
        reason="The answers of one connection come one after the other, and who reads first gets the first. "
        "rospy's proxy does not keep its callers apart.",
    ),
)
