"""Faults of nodes and topics."""

from __future__ import annotations

import signal
from functools import partial

from course_pkg.faults.fault import Fault
from course_pkg.faults.programs import VISITOR, keeper, kill_server, nothing, running
from course_pkg.faults.stage import Stage
from course_pkg.ros.protocol.master_api import MasterClient

_fault = partial(Fault, group="masters", chapter="12")
_asked = partial(_fault, visitor=VISITOR, story="A client calls the door's service.")

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
print("a second call prints no error; initialized:", rospy.core.is_initialized())
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
        story="A student changes a cell of a notebook and runs it again.",
        play=nothing,
        visitor=TWO_NAMES,
        diagnosis="One program calls init_node() with two different node names.",
        remedy="Use the first name again, or restart the kernel to use a different name.",
        reason=(
            "A second init_node() with the same arguments does nothing, and with other arguments it "
            "raises an error. A process can be only one node."
        ),
    ),
    _fault(
        name="init_on_thread",
        chapter="02",
        look="python",
        story="A button in a notebook starts the node in the background.",
        play=nothing,
        visitor=ON_A_THREAD,
        diagnosis="init_node() is called on a thread that is not the main thread.",
        remedy="Restart the kernel, and call init_node() on the main thread first.",
        reason=(
            "init_node() sets signal handlers, which Python permits only on the main thread. Before this "
            "error, rospy has already stored that init_node() was called. So a second call does nothing."
        ),
    ),
    _asked(
        name="spun",
        look="gone unavailable",
        story=(
            "The output of a notebook reports that the notebook provides the door's service. A "
            "client calls this "
            "service."
        ),
        play=_spin_and_interrupt,
        diagnosis=(
            "rospy.spin() was interrupted in the server's notebook. This shut down the node of the notebook."
        ),
        remedy="Restart the kernel, or call join() again. Never call spin() in a notebook.",
        reason=(
            "Interrupting spin() shuts the node down without a message. After that, init_node() and "
            "Service() do nothing and raise no error."
        ),
        unlike=("no_service", "wait_in_vain", "restarted_master"),
    ),
    _asked(
        name="same_name",
        look="gone unavailable",
        chapter="01",
        story="The door's service has worked all day. Now a client calls it again.",
        play=_twin,
        diagnosis="Another node has started with the node name of the server, so the server was shut down.",
        remedy="Give each node its own name, and start the server again.",
        reason=(
            "The server's output contains `new node registered with same name`: the master shuts down the "
            "older node with this name."
        ),
        unlike=("no_service",),
    ),
    _fault(
        name="killed",
        look="gone connection",
        story="`rosnode list` shows the door's node. Does this node work?",
        play=kill_server,
        visitor="$ rosnode ping -c 1 /lab/keeper",
        diagnosis="The node was killed, and its name is still registered with the master.",
        remedy="Remove the stale registration with `rosnode cleanup`, and start the node again.",
        reason=(
            "`rosnode list` shows the registrations, not the running nodes. `rosnode ping` calls the "
            "node itself, which does not answer."
        ),
        unlike=("stale",),
    ),
    _fault(
        name="first_message",
        look="quiet topic",
        chapter="02",
        story="A program rings the bell with one message. The door's node should have received the message.",
        play=running(LISTENER),
        visitor=RINGS_ONCE,
        diagnosis="The message was published before a subscriber was connected, so it was lost.",
        remedy="Wait for the connection before you publish, or use a latched topic.",
        reason=(
            "A publisher registers with the master, the master informs the subscribers, and then the "
            "subscribers connect. This takes some milliseconds. Messages that are published during this time "
            "are lost."
        ),
    ),
    _fault(
        name="topic_types",
        look="quiet topic",
        chapter="02",
        story="A program rings the bell with ten messages. The door's node should have received all of them.",
        play=running(LISTENER),
        visitor=RINGS_OTHERWISE,
        diagnosis="Publisher and subscriber use different types for one topic.",
        remedy="Use `rostopic info` to find the type of the topic, and use this type in both nodes.",
        reason=(
            "The publisher refuses the connection, and the subscriber gets no error. The publisher's log "
            "may contain a line about this refusal."
        ),
        unlike=("first_message",),
    ),
    _fault(
        name="print_in_callback",
        look="quiet topic",
        chapter="02",
        story=(
            "The first cell of a notebook subscribes to the bell's topic. The second cell only "
            "adds two numbers."
        ),
        play=_ring,
        visitor=NOTEBOOK,
        diagnosis="A callback prints, and its output appears below the cell that runs at that time.",
        remedy="Let callbacks store the messages, and print them in a separate cell.",
        reason=(
            "Callbacks run on threads of rospy. If a callback prints a text, the notebook shows the "
            "text below the cell that is running then, or below the last cell that ran."
        ),
    ),
)
