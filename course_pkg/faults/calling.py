"""Faults in a call: mistakes of the client, and servers that have ended or do not respond."""

from __future__ import annotations

import socket
from functools import partial

from course_pkg.faults.fault import Fault
from course_pkg.faults.programs import (
    VISITOR,
    asking,
    calling,
    keeper,
    kill_server,
    nothing,
    running,
    serving,
)
from course_pkg.faults.stage import Stage
from course_pkg.ros.protocol.master_api import MasterClient
from course_pkg.ros.protocol.xmlrpc import port_of

NO_HOST = "robot-2"  # The machine cannot resolve this host name.

_well = partial(Fault, group="calling", chapter="06", play=serving('return SetBoolResponse(True, "open")'))
_python = partial(
    _well,
    look="python",
    story="A client calls the door's service, and the client's program ends with an error.",
)
_broken = partial(
    Fault,
    group="calling",
    chapter="12",
    visitor=VISITOR,
    story="The door's service has worked all day. Now a client calls it again.",
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
        threading.Timer(0.1, os._exit, [1]).start()  # the first server crashes after its first response
    return SetBoolResponse(True, "open" if request.data else "shut")

def serve():
    rospy.init_node("keeper")
    rospy.Service("/lab/door", SetBool, handle)
    rospy.spin()

first = multiprocessing.get_context("fork").Process(target=serve)
first.start()
first.join()
serve()  # the second server replaces it
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
print("some responses went to another thread or got lost:", bool(wrong) or any(t.is_alive() for t in threads))
"""


def _freeze(stage: Stage) -> None:
    stage.serve(keeper()).freeze()


def _hog(stage: Stage) -> None:
    """Connect to the server and send nothing; the server then waits for a header."""
    stage.serve(keeper())
    uri = MasterClient(stage.uri).lookup_service(stage.door) or ""
    stage.later(socket.create_connection(("127.0.0.1", port_of(uri)), timeout=2.0).close)


def _misname(stage: Stage) -> None:
    """Start a server with a host name that cannot be resolved.

    No other process can connect to this server, so this function does not wait for a response.
    """
    master = MasterClient(stage.uri)
    # The client uses 127.0.0.1 as its own host name. With localhost, rospy would not try to resolve the
    # server's host name.
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
        story="A client calls the door's service.",
        visitor=VISITOR.replace("/lab/door", "/lab/dor"),
        diagnosis="No node provides this service: client and server spell its name differently.",
        remedy="Compare the name in the client with the names that `rosservice list` prints.",
        reason=(
            "`unavailable` means that no node provides a service of this name. The server runs, but the "
            "name of its service has one letter more than the name in the client."
        ),
    ),
    _well(
        name="wait_in_vain",
        look="gone unavailable",
        story="A client waits for the door's service and calls it.",
        play=_start_slowly,
        visitor=asking('rospy.wait_for_service("/lab/door", timeout=1)', "import std_srvs.srv"),
        diagnosis=(
            "The server's node runs, but it provides the service only after the client has stopped waiting."
        ),
        remedy="Use a longer timeout, or call the service later.",
        reason=(
            "wait_for_service() ended after one second. At that time, `rosnode list` shows the node, but "
            "`rosservice list` does not show the service yet."
        ),
        unlike=("no_service",),
    ),
    _well(
        name="wait_for_ever",
        look="wait start",
        story="A client waits for the door's service and calls it.",
        play=nothing,
        visitor=asking('rospy.wait_for_service("/lab/door")', "import std_srvs.srv"),
        diagnosis="The client waits without a time limit for a server that was never started.",
        remedy="Start the server, and give wait_for_service() a timeout.",
        reason=(
            "`rosservice list` does not show the service, and `rosnode list` does not show the "
            "server's node. Without a timeout, wait_for_service() waits forever and prints nothing."
        ),
        hangs=True,
    ),
    _python(
        name="zero_timeout",
        play=nothing,
        visitor=asking('rospy.wait_for_service("/lab/door", timeout=0)', "import std_srvs.srv"),
        diagnosis="The timeout of wait_for_service() is 0, and this value is not allowed.",
        remedy=(
            "Use a timeout of a few seconds. Or call the service without waiting, and catch the exception "
            "of the call."
        ),
        reason="`timeout must be non-zero` is a ValueError in the client. No request was sent.",
    ),
    _python(
        name="too_few",
        visitor=calling('print(move_door(True, "slowly"))'),
        diagnosis="The call has more or fewer positional values than the request has fields.",
        remedy="Pass one value for each field, or pass the values by field name.",
        reason=(
            "The client could not create the request, so it sent nothing. The exception is a TypeError, "
            "which `except rospy.ServiceException` does not catch."
        ),
    ),
    _python(
        name="mixed",
        visitor=calling("print(move_door(True, data=True))"),
        diagnosis="The call mixes positional values and keywords.",
        remedy="Pass all values by position, or pass all values by keyword.",
        reason=(
            "The error message mentions publish(), because rospy creates requests and topic messages with "
            "the same code."
        ),
    ),
    _python(
        name="misspelt",
        visitor=calling("print(move_door(dat=True))"),
        diagnosis="The call names a field that the request does not have.",
        remedy="Compare the name with the fields of the request that `rossrv show` prints.",
        reason=(
            "`dat is not an attribute of SetBoolRequest` is an AttributeError in the client. The error "
            "occurs before the client sends anything."
        ),
    ),
    _well(
        name="left_out",
        look="quiet call",
        story="A client calls the door's service, and gets an unexpected response.",
        play=running(keeper()),
        visitor=calling("print(move_door())"),
        diagnosis=(
            "The call omits a field, which therefore has the value False or 0. No error message reports this."
        ),
        remedy="In the call, pass a value for each field by its name.",
        reason=(
            "An omitted field has the value False, 0 or an empty string. The server cannot know "
            "whether the client intended this value."
        ),
    ),
    _python(
        name="wrong_value",
        visitor=calling('print(move_door("yes"))'),
        diagnosis="The type of a value in the call differs from the type of its field.",
        remedy="Convert the value to the type of its field before the call.",
        reason=(
            "The client created the request, but could not convert the request to bytes. The exception is a "
            "SerializationError in the client, and not a ServiceException."
        ),
    ),
    _broken(
        name="md5",
        look="gone connection",
        chapter="04",
        story="A client calls the door's service.",
        play=serving('return SetBoolResponse(True, "open")'),
        visitor=VISITOR.replace("SetBool", "Trigger").replace("(True)", "()"),
        diagnosis="Client and server use different service types.",
        remedy=(
            "Compare the output of `rosservice type` and `rossrv md5` with the type in the "
            "client, and use the same type in client and server."
        ),
        reason=(
            "`md5sums do not match`: before the server reads a request, it compares the client's checksum "
            "of the definition with its own checksum. Here the client uses Trigger, and the server uses "
            "SetBool."
        ),
    ),
    _broken(
        name="stale",
        look="gone connection",
        play=kill_server,
        diagnosis="The server was killed, and it is still registered with the master.",
        remedy="Start the server again, or remove the stale registration with `rosnode cleanup`.",
        reason=(
            "The master returned an address at which no process listens any more: `Connection refused`."
            " A process that is killed by SIGKILL cannot unregister."
        ),
        unlike=("killed",),
    ),
    _broken(
        name="died",
        look="gone connection",
        play=running("import os\n" + keeper("os._exit(1)  # the motor causes a power failure")),
        diagnosis="The server received the request, and ended before it sent the response.",
        remedy=(
            "Start the server again. Repeat the call only if the server can do the work twice without harm."
        ),
        reason=(
            "`unable to receive data from sender`: the connection was closed while the client waited for the "
            "response. The client cannot know how much of the work the server has done."
        ),
        unlike=("stale",),
    ),
    _broken(
        name="stopped",
        look="wait call",
        play=_freeze,
        diagnosis="The server's process is stopped: it still exists, but does nothing.",
        remedy="Resume the process with `kill -CONT`, or with `fg` if Ctrl-Z has stopped it.",
        reason=(
            "The operating system still accepts connections for the process, so wait_for_service() "
            "succeeds. But no thread of the process runs, and `rosnode ping` gets no answer either."
        ),
        hangs=True,
    ),
    _broken(
        name="hogged",
        look="wait call",
        play=_hog,
        diagnosis="Another client has connected, but sends nothing. This blocks all other clients.",
        remedy=(
            "End the client that sends nothing. To prevent this problem, let the server read each "
            "header on a separate thread."
        ),
        reason=(
            "rospy has one thread that accepts connections, and this thread also reads the header of each "
            "connection. `rosnode ping` uses another thread and gets an answer, but a probe of the service "
            "gets no answer. The course's function prepare_node() prevents this problem."
        ),
        hangs=True,
    ),
    _broken(
        name="persistent",
        look="gone connection",
        chapter="11",
        story=(
            "A client opens the door. The server crashes and is started again. Then the client calls "
            "again to close the door."
        ),
        play=running(RESTARTED),
        visitor=KEEPS_CALLING,
        diagnosis=(
            "The client keeps a connection to a server that has ended, and never opens a new connection."
        ),
        remedy="Close the persistent proxy and create a new one, or call without persistent=True.",
        reason=(
            "A persistent proxy looks the service up only once, so it never calls the new server. "
            "After the restart, each call fails with a different message: the first message is "
            "about the transport, the second is about a broken pipe, and the third contains "
            "'tell'."
        ),
    ),
    _broken(
        name="hostname",
        look="gone connection",
        play=_misname,
        diagnosis="The server is registered with a host name that the client's machine cannot resolve.",
        remedy="Start the server with ROS_HOSTNAME=localhost, or with a name that all machines know.",
        reason=(
            "The server runs and is registered, but its address cannot be used: `rosservice uri` "
            "shows this address. The node takes the host name from ROS_HOSTNAME and does not test this name."
        ),
    ),
    _well(
        name="shared_proxy",
        look="quiet call",
        chapter="12",
        story=(
            "Four threads call the door's service repeatedly. Each thread should get the response to "
            "its own request."
        ),
        play=running(keeper()),
        visitor=SHARED,
        diagnosis="Several threads share one persistent proxy and read each other's responses.",
        remedy="Give each thread its own proxy, or hold a lock around each call.",
        reason=(
            "The responses arrive one after the other on one connection. The first thread that "
            "reads gets the first response, even if this response belongs to another thread."
        ),
    ),
)
