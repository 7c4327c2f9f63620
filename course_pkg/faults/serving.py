"""Faults in a server: its handler, and how it is declared."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from course_pkg.faults.fault import Fault
from course_pkg.faults.texts import VISITOR, asking, keeper, running, serving

if TYPE_CHECKING:
    from course_pkg.faults.stage import Stage

_served = partial(Fault, group="serving", chapter="05", visitor=VISITOR)
_replied = partial(_served, look="reply", story="The door is asked to open, and an error comes back.")
_silent = partial(_served, story="The door is asked to open.", chapter="10", hangs=True)

LOCKED = """\
import threading

import rospy
from std_srvs.srv import SetBool, SetBoolResponse, Trigger, TriggerResponse

moving = threading.Lock()

def handle(request):
    with moving:
        print("asking the bolt")
        bolt = rospy.ServiceProxy("/lab/bolt", Trigger)()
        return SetBoolResponse(bolt.success, bolt.message)

def handle_bolt(request):
    print("the bolt is asked")
    with moving:
        return TriggerResponse(True, "the bolt is drawn")

rospy.init_node("keeper")
rospy.Service("/lab/bolt", Trigger, handle_bolt)
rospy.Service("/lab/door", SetBool, handle)
rospy.spin()
"""

TWICE = """\
import rospy
from std_srvs.srv import SetBool, SetBoolResponse

def handle(request):
    return SetBoolResponse(False, "not yet written")

rospy.init_node("keeper")
rospy.Service("/lab/door", SetBool, handle)

# some time later, the cell mended and run again

def handle(request):
    return SetBoolResponse(True, "open")

try:
    rospy.Service("/lab/door", SetBool, handle)
except rospy.ServiceException as error:
    print(error)
rospy.spin()
"""


# A type of ROS itself whose response has a list as its only field.
LOGGERS = (
    keeper('return ["rosout", "hinge", "bell"]')
    .replace("std_srvs.srv import SetBool, SetBoolResponse", "roscpp.srv import GetLoggers")
    .replace('"/lab/door", SetBool', '"/lab/door", GetLoggers')
)


def _two_providers(stage: Stage) -> None:
    code = keeper('return SetBoolResponse(False, "no door here: this is the wardrobe")', keeper="wardrobe")
    other = stage.program("wardrobe.py", code)
    stage.serve(keeper())
    stage.serve_too(other)


def _requests_class(stage: Stage) -> None:
    code = keeper(
        **{"SetBool, handle": "SetBoolRequest, handle", "import SetBool,": "import SetBoolRequest,"}
    )
    program = stage.keep(code)
    stage.await_that(lambda: program.over, program)


SERVING: tuple[Fault, ...] = (
    _replied(
        name="returns_none",
        play=serving('message = "open" if request.data else "shut"\nSetBoolResponse(True, message)'),
        diagnosis="The handler builds its response and does not return it.",
        remedy="Write return in front of the response.",
        reason="A function without return returns None, and rospy says just that. An empty response has to "
        "be returned, too.",
    ),
    _replied(
        name="raises",
        play=serving('angle = {"open": 90}["closed"]\nreturn SetBoolResponse(True, str(angle))'),
        diagnosis="The handler fails with an exception that nobody expected.",
        remedy="Read the traceback in the server's output, and mend the line that it names.",
        reason="`error processing request` comes before the words of any exception but ServiceException. The "
        "client gets the words; the traceback stays with the server.",
    ),
    _replied(
        name="refuses",
        play=serving('raise rospy.ServiceException("somebody stands in the doorway")'),
        diagnosis="The handler refuses this request on purpose, and says why.",
        remedy="Do what the reason asks for, and call again.",
        reason="`service cannot process request` with a reason in plain words is what a handler says by "
        "raising ServiceException. The server is well.",
    ),
    _replied(
        name="returns_number",
        play=serving("return 90"),
        diagnosis="The handler returns a plain value where the response has several fields.",
        remedy="Return one value for each field: a response, a tuple, a list or a dict.",
        reason="A single value stands for a response of one field. SetBool's response has two.",
        unlike=("wrong_length",),
    ),
    _replied(
        name="wrong_length",
        play=serving('return [True, "open", 90]'),
        diagnosis="The handler returns a list or a tuple that is too long or too short.",
        remedy="Return as many values as the response has fields, in their order.",
        reason="`wrong number of values`: three came, and SetBool's response has success and message.",
    ),
    _replied(
        name="flat_list",
        visitor=asking(
            'print(rospy.ServiceProxy("/lab/door", GetLoggers)())', "from roscpp.srv import GetLoggers"
        ),
        play=running(LOGGERS),
        diagnosis="The response has one field that is a list, and the handler returns that list bare.",
        remedy="Put the list into a list, [[…]], or name the field in a dict.",
        reason="rospy takes a returned list for the values of the fields. Three values for one field are two "
        "too many; the list itself has to be the one value.",
        unlike=("wrong_length",),
    ),
    _replied(
        name="dict_slip",
        play=serving('return {"sucess": True, "message": "open"}'),
        diagnosis="The handler returns a dict, and one of its keys is no field of the response.",
        remedy="Compare the keys with `rossrv show`, and correct the spelling.",
        reason="The message names both: the key `sucess`, and the response class that has no such field.",
    ),
    _replied(
        name="wrong_type",
        play=serving('return SetBoolResponse("yes", "open")'),
        diagnosis="A field of the response gets a value of another type.",
        remedy="Convert the value to the type of its field before it is returned.",
        reason="`field success is not a bool`: the response is made without a word, and refused when it is "
        "packed to be sent. So the handler itself has no error to show.",
    ),
    _replied(
        name="wrong_arity",
        play=running(keeper('return SetBoolResponse(True, "open")', **{"(request)": "()"})),
        diagnosis="The handler does not take the request as its argument.",
        remedy="Give the handler one parameter, the request.",
        reason="`takes 0 positional arguments but 1 was given`: rospy calls every handler with the request, "
        "be it empty.",
    ),
    _silent(
        name="sleeps",
        look="wait call",
        play=serving(
            'print("waiting for the hinge")\nhinge.wait()\nreturn SetBoolResponse(True, "open")',
            "import threading\n\nhinge = threading.Event()\n",
        ),
        diagnosis="The handler waits for something that does not happen.",
        remedy="Give every wait in a handler a limit, and the call a deadline.",
        reason="The node answers `rosnode ping` and a probe of its service: both go by other threads. Its "
        "output ends with what the handler waits for, and rospy puts no limit on a call.",
        unlike=("lock",),
    ),
    _silent(
        name="exits",
        look="wait call",
        play=serving('print("there is no door: leaving")\nsys.exit(1)', "import sys\n"),
        diagnosis="The handler calls sys.exit(), which ends its thread and sends no answer.",
        remedy="Have the handler raise ServiceException to refuse; end programs elsewhere.",
        reason="sys.exit() raises SystemExit, which rospy neither answers nor reports. The output ends with "
        "a goodbye, and the process is still there: only the thread is gone, and the client waits.",
    ),
    _served(
        name="request_for_type",
        look="gone unavailable",
        story="The program that serves the door is started.",
        play=_requests_class,
        visitor="$ rosservice info /lab/door",
        diagnosis="The service is declared with its request class in the place of its type.",
        remedy="Give SetBool, the type that holds both halves.",
        reason="The server's output ends with `has no attribute '_request_class'`: only the type itself "
        "knows its two halves. The server never came to serve anything.",
    ),
    _served(
        name="declared_twice",
        look="quiet call",
        story="The handler was mended and its cell run again. The door still does not open.",
        play=running(TWICE),
        diagnosis="The service was declared a second time in one program, and the old handler still answers.",
        remedy="Call shutdown() on the first service before declaring it again.",
        reason="The server's output says `already registered`: the second declaration was refused, and the "
        "first handler goes on answering.",
    ),
    _served(
        name="two_providers",
        look="quiet call",
        story="The keeper of the door is well, and yet the door does not open.",
        play=_two_providers,
        diagnosis="Another node serves the same name since, and gets all calls.",
        remedy="End that node, or give one of the two services another name, and start the other again.",
        reason="A name has one provider: who registers last, without an error to anybody. `rosservice info` "
        "names the node, and it is not the keeper.",
    ),
    _silent(
        name="lock",
        look="wait call",
        play=running(LOCKED),
        diagnosis="The handler holds a lock while it calls a service that needs the same lock.",
        remedy="Let go of the lock before calling, or pass on what is needed without a call.",
        reason="Each waits for the other: the handler for the bolt's answer, the bolt for the lock. That a "
        "service calls another of its own node does no harm; the lock held across the call does.",
        unlike=("sleeps",),
    ),
)
