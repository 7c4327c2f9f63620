"""Faults of nodes and topics."""

from __future__ import annotations

import signal
from functools import partial
from typing import TYPE_CHECKING

from course_pkg.faults.fault import Fault
from course_pkg.faults.texts import VISITOR, keeper, kill_server, nothing, running
from course_pkg.graph.rpc import MasterClient

if TYPE_CHECKING:
    from course_pkg.faults.stage import Stage

_fault = partial(Fault, group="masters", chapter="10")
_asked = partial(_fault, visitor=VISITOR, story="The door is asked to open.")

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
    pass

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


NODES: tuple[Fault, ...] = (
    _fault(
        name="init_again",
        chapter="02",
        look="python",
        story="A cell of a notebook is changed and run again.",
        play=nothing,
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
        play=nothing,
        visitor=ON_A_THREAD,
        diagnosis="The node is initialized on a thread that is not the main one.",
        remedy="Restart the kernel, and call init_node() on the main thread, before any other.",
        reason="init_node() sets handlers for signals, which Python allows on the main thread only. By then "
        "it has noted that it was called, so that a second try does nothing.",
    ),
    _asked(
        name="spun",
        look="gone unavailable",
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
        look="gone unavailable",
        chapter="01",
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
        look="gone connection",
        story="The keeper stands in `rosnode list`. Is it well?",
        play=kill_server,
        visitor="$ rosnode ping -c 1 /lab/keeper",
        diagnosis="The node was killed, and its name is still in the master's list.",
        remedy="Remove it with `rosnode cleanup`, and start the node again.",
        reason="`rosnode list` shows what the master was told, not who lives. `rosnode ping` asks the node "
        "itself, and nobody is there.",
        unlike=("stale",),
    ),
    _fault(
        name="first_message",
        look="quiet topic",
        chapter="02",
        story="The bell is rung once, and the keeper should have heard it.",
        play=running(LISTENER),
        visitor=RINGS_ONCE,
        diagnosis="The message was published before any subscriber was connected, and is lost.",
        remedy="Wait for the connection before publishing, or latch the topic.",
        reason="A publisher tells the master, the master tells the subscribers, and these connect: that "
        "takes some milliseconds, and what is published meanwhile goes to nobody.",
    ),
    _fault(
        name="topic_types",
        look="quiet topic",
        chapter="02",
        story="The bell is rung ten times, and the keeper should have heard it.",
        play=running(LISTENER),
        visitor=RINGS_OTHERWISE,
        diagnosis="Publisher and subscriber have different types for one topic.",
        remedy="Compare them with `rostopic info`, and use one type on both sides.",
        reason="The subscriber's connection is refused, and it is not told. Only the publisher's log has a "
        "line about it, if anywhere.",
        unlike=("first_message",),
    ),
    _fault(
        name="print_in_callback",
        look="quiet topic",
        chapter="02",
        story="The first cell of a notebook subscribes to the bell, the second one only adds two numbers.",
        play=_ring,
        visitor=NOTEBOOK,
        diagnosis="A callback prints, and its words come out below whatever cell runs at the time.",
        remedy="Have callbacks record what came, and show the record in a cell of its own.",
        reason="Callbacks run on threads of rospy's. A notebook puts what they print below the cell that "
        "runs then, or the last one.",
    ),
)
