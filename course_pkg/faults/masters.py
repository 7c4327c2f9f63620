"""Faults of nodes, topics and the master."""

from __future__ import annotations

import signal
import socket
from functools import partial
from typing import TYPE_CHECKING

from course_pkg.faults.fault import Fault
from course_pkg.faults.texts import VISITOR, keeper
from course_pkg.graph.rpc import MasterClient

if TYPE_CHECKING:
    from course_pkg.faults.stage import Stage

_fault = partial(Fault, group="masters", chapter="10")
_asked = partial(_fault, visitor=VISITOR, story="The door is asked to open.")

BARE = VISITOR.replace('rospy.init_node("visitor")\n', "")

SPUN = """\
import rospy
from std_srvs.srv import SetBool, SetBoolResponse

def handle(request):
    return SetBoolResponse(True, "open")

rospy.init_node("keeper", disable_signals=True)
try:
    print("spinning", flush=True)
    rospy.spin()
except KeyboardInterrupt:
    print("interrupted", flush=True)

# the next cells of the notebook

rospy.init_node("keeper", disable_signals=True)
rospy.Service("/lab/door", SetBool, handle)
print("the door is served", flush=True)
"""

LISTENER = """\
import rospy
from std_msgs.msg import String
from std_srvs.srv import Trigger, TriggerResponse

heard = []
rospy.init_node("keeper")
rospy.Subscriber("/lab/bell", String, heard.append)
rospy.Service("/lab/door", Trigger, lambda request: TriggerResponse(True, f"heard {len(heard)}"))
rospy.spin()
"""

RINGS_ONCE = """\
import rospy
from std_msgs.msg import String
from std_srvs.srv import Trigger

rospy.init_node("visitor")
bell = rospy.Publisher("/lab/bell", String, queue_size=10)
bell.publish("ring")
rospy.sleep(1)
print("published 1, the keeper", rospy.ServiceProxy("/lab/door", Trigger)().message)
"""

RINGS_OTHERWISE = """\
import rospy
from std_msgs.msg import Bool
from std_srvs.srv import Trigger

rospy.init_node("visitor")
bell = rospy.Publisher("/lab/bell", Bool, queue_size=10)
for _ in range(10):
    rospy.sleep(0.1)
    bell.publish(True)
print("published 10, the keeper", rospy.ServiceProxy("/lab/door", Trigger)().message)
"""

NOTEBOOK = '''\
from subprocess import DEVNULL

from jupyter_client.manager import start_new_kernel

CELLS = ["""
import rospy, time
from std_msgs.msg import String
rospy.init_node("visitor", disable_signals=True)
rospy.Subscriber("/lab/bell", String, lambda message: print("heard:", message.data))
""", """
time.sleep(1.5)
print("the sum is", 1 + 1)
"""]

manager, kernel = start_new_kernel(kernel_name="python3", stderr=DEVNULL)
for number, cell in enumerate(CELLS, start=1):
    printed = []
    kernel.execute_interactive(cell, output_hook=printed.append)
    texts = [message["content"].get("text", "") for message in printed]
    print(f"below cell {number}:", "".join(texts).split("\\n")[:3])
'''

RINGER = """\
import rospy
from std_msgs.msg import String

rospy.init_node("keeper")
bell = rospy.Publisher("/lab/bell", String, queue_size=10)
while not rospy.is_shutdown():
    bell.publish("ring")
    rospy.sleep(0.5)
"""

TWO_NAMES = """\
import rospy

rospy.init_node("visitor")
rospy.init_node("guest")
"""

ON_A_THREAD = """\
import threading

import rospy
from std_srvs.srv import SetBool

thread = threading.Thread(target=rospy.init_node, args=["visitor"])
thread.start()
thread.join()
rospy.init_node("visitor")
print("a second try says nothing; initialized:", rospy.core.is_initialized())
"""


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
    stage.serve(keeper(), visitor={"ROS_MASTER_URI": stage.uri.removeprefix("http://")})


def _serve(stage: Stage) -> None:
    stage.serve(keeper('return SetBoolResponse(True, "open")'))


def _listen(stage: Stage) -> None:
    stage.serve(LISTENER)


def _ring(stage: Stage) -> None:
    master, name = MasterClient(stage.uri), f"{stage.namespace}/bell"
    program = stage.keep(RINGER)
    stage.await_that(lambda: name in master.system_state().publishers, program)


def _spin_and_interrupt(stage: Stage) -> None:
    program = stage.keep(SPUN)
    stage.await_that(lambda: "spinning" in program.output(), program)
    program.signal(signal.SIGINT)
    stage.await_that(lambda: program.over, program)


def _twin(stage: Stage) -> None:
    twin = stage.program("guard.py", keeper().replace("/lab/door", "/lab/gate"))
    first = stage.serve(keeper())
    twin.begin()
    stage.await_that(lambda: first.over, twin)


def _kill(stage: Stage) -> None:
    stage.serve(keeper()).kill()


def _own_master(stage: Stage) -> None:
    stage.own_master()


def _nothing(_: Stage) -> None:
    """Leave the graph as it is."""


MASTERS: tuple[Fault, ...] = (
    _asked(
        name="no_master",
        look="wait",
        play=_no_master,
        diagnosis="There is no master, and init_node() goes on looking for one.",
        remedy="Start a master, or correct ROS_MASTER_URI.",
        reason="`Unable to register with master node … Will keep trying` comes once, then nothing more. The "
        "program has not even come to its call.",
        hangs=True,
    ),
    _asked(
        name="no_master_call",
        look="gone",
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
        look="gone",
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
        look="wait",
        play=_hang_master,
        diagnosis="The master takes connections and does not answer.",
        remedy="Let the master's process go on, or end it and start everything again.",
        reason="Every tool hangs, too, since each asks the master first. A stopped process still gets "
        "connections from the system.",
        hangs=True,
    ),
    _fault(
        name="init_again",
        chapter="02",
        look="python",
        story="A cell of a notebook is changed and run again.",
        play=_nothing,
        visitor=TWO_NAMES,
        diagnosis="One program tries to be two nodes.",
        remedy="Keep the name, or restart the kernel to take another.",
        reason="init_node() with the same arguments again does nothing; with others it refuses. A process is "
        "one node, once.",
    ),
    _fault(
        name="init_on_thread",
        chapter="02",
        look="python",
        story="A button of a notebook starts the node in the background.",
        play=_nothing,
        visitor=ON_A_THREAD,
        diagnosis="The node is initialized on a thread that is not the main one.",
        remedy="Restart the kernel, and call init_node() on the main thread, before any other.",
        reason="init_node() sets handlers for signals, which Python allows on the main thread only. By then "
        "it has noted that it was called, so that a second try does nothing.",
    ),
    _asked(
        name="spun",
        look="gone",
        story="A notebook serves the door, says its output. The door is asked to open.",
        play=_spin_and_interrupt,
        diagnosis="rospy.spin() was interrupted in the server's notebook, and its node is dead since.",
        remedy="Restart the kernel, or join() again; and never spin in a notebook.",
        reason="Interrupting spin() shuts the node down without a word. After that init_node() and Service() "
        "raise nothing and do nothing.",
        unlike=("no_service", "wait_in_vain", "restarted_master"),
    ),
    _asked(
        name="same_name",
        chapter="01",
        look="gone",
        story="The door has opened all day. Now it is asked once more.",
        play=_twin,
        diagnosis="Another node has taken the server's node name, which ended the server.",
        remedy="Give each node a name of its own, and start the server again.",
        reason="The server's output has `new node registered with same name`: the master shuts the older "
        "node of a name down.",
        unlike=("no_service",),
    ),
    _fault(
        name="killed",
        look="gone",
        story="The keeper stands in `rosnode list`. Is it well?",
        play=_kill,
        visitor="$ rosnode ping -c 1 /lab/keeper",
        diagnosis="The node was killed, and its name is still in the master's list.",
        remedy="Remove it with `rosnode cleanup`, and start the node again.",
        reason="`rosnode list` shows what the master was told, not who lives. `rosnode ping` asks the node "
        "itself, and nobody is there.",
        unlike=("stale",),
    ),
    _fault(
        name="port_taken",
        chapter="01",
        look="gone",
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
        chapter="01",
        look="wait",
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
        look="wait",
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
    _fault(
        name="first_message",
        chapter="02",
        look="quiet",
        story="The bell is rung once, and the keeper should have heard it.",
        play=_listen,
        visitor=RINGS_ONCE,
        diagnosis="The message was published before any subscriber was connected, and is lost.",
        remedy="Wait for the connection before publishing, or latch the topic.",
        reason="A publisher tells the master, the master tells the subscribers, and these connect: that "
        "takes some milliseconds, and what is published meanwhile goes to nobody.",
    ),
    _fault(
        name="topic_types",
        chapter="02",
        look="quiet",
        story="The bell is rung ten times, and the keeper should have heard it.",
        play=_listen,
        visitor=RINGS_OTHERWISE,
        diagnosis="Publisher and subscriber have different types for one topic.",
        remedy="Compare them with `rostopic info`, and use one type on both sides.",
        reason="The subscriber's connection is refused, and it is not told. Only the publisher's log has a "
        "line about it, if anywhere.",
        unlike=("first_message",),
    ),
    _fault(
        name="print_in_callback",
        chapter="02",
        look="quiet",
        story="The first cell of a notebook subscribes to the bell, the second one only adds two numbers.",
        play=_ring,
        visitor=NOTEBOOK,
        diagnosis="A callback prints, and its words come out below whatever cell runs at the time.",
        remedy="Have callbacks record what came, and show the record in a cell of its own.",
        reason="Callbacks run on threads of rospy's. A notebook puts what they print below the cell that "
        "runs then, or the last one.",
    ),
)
