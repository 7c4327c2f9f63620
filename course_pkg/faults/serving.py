"""Faults in a server: mistakes in its handler, and in the creation of its service."""

from __future__ import annotations

from functools import partial

from course_pkg.faults.fault import Fault
from course_pkg.faults.programs import VISITOR, asking, keeper, running, serving
from course_pkg.faults.stage import Stage

_served = partial(Fault, group="serving", chapter="05", visitor=VISITOR)
_replied = partial(_served, look="reply", story="A client calls the door's service and gets an error.")
_silent = partial(_served, story="A client calls the door's service.", chapter="12", hangs=True)

LOCKED = """\
import threading

import rospy
from std_srvs.srv import SetBool, SetBoolResponse, Trigger, TriggerResponse

moving = threading.Lock()

def handle(request):
    with moving:
        print("calling the bolt")
        bolt = rospy.ServiceProxy("/lab/bolt", Trigger)()
        return SetBoolResponse(bolt.success, bolt.message)

def handle_bolt(request):
    print("the bolt is called")
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

# some time later, the student corrects the cell and runs it again

def handle(request):
    return SetBoolResponse(True, "open")

try:
    rospy.Service("/lab/door", SetBool, handle)
except rospy.ServiceException as error:
    print(error)
rospy.spin()
"""


# In this fault, the handler returns three values, but the response of GetLoggers has only one field, a list.
LOGGERS = (
    keeper('return ["rosout", "hinge", "bell"]')
    .replace("std_srvs.srv import SetBool, SetBoolResponse", "roscpp.srv import GetLoggers")
    .replace('"/lab/door", SetBool', '"/lab/door", GetLoggers')
)


def _two_providers(stage: Stage) -> None:
    code = keeper('return SetBoolResponse(False, "this is the wardrobe, not the door")', keeper="wardrobe")
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
        diagnosis="The handler creates its response, but does not return this response.",
        remedy="Write `return` before the response.",
        reason=(
            "A function without `return` returns None, and the error message shows this value. A "
            "handler must return a response, even if the response has no fields."
        ),
    ),
    _replied(
        name="raises",
        play=serving('angle = {"open": 90}["closed"]\nreturn SetBoolResponse(True, str(angle))'),
        diagnosis="The handler raises an unexpected exception.",
        remedy=(
            "Read the traceback in the server's output, and correct the line of code that the "
            "traceback shows."
        ),
        reason=(
            "After `error processing request`, the client receives the message of the exception. The "
            "traceback is only in the server's output. rospy handles all exceptions except ServiceException "
            "in this way."
        ),
    ),
    _replied(
        name="refuses",
        play=serving('raise rospy.ServiceException("a person stands in the doorway")'),
        diagnosis="The handler refuses this request on purpose, and gives the reason.",
        remedy="Remove the cause that the message describes, and call the service again.",
        reason=(
            "The server works. If a handler raises ServiceException, the client receives "
            "`service cannot process request` and the reason."
        ),
    ),
    _replied(
        name="returns_number",
        play=serving("return 90"),
        diagnosis="The handler returns a single value, but the response has several fields.",
        remedy="Return one value for each field, in a response, a tuple, a list or a dict.",
        reason=(
            "A single value is allowed only for a response with one field. Here the response has two fields."
        ),
        unlike=("wrong_length",),
    ),
    _replied(
        name="wrong_length",
        play=serving('return [True, "open", 90]'),
        diagnosis="The handler returns a list or a tuple that is too long or too short.",
        remedy="Return one value for each field of the response, in the order of the fields.",
        reason=(
            "`wrong number of values`: the handler returned three values, but SetBool's response has only "
            "the fields success and message."
        ),
    ),
    _replied(
        name="flat_list",
        visitor=asking(
            'print(rospy.ServiceProxy("/lab/door", GetLoggers)())', "from roscpp.srv import GetLoggers"
        ),
        play=running(LOGGERS),
        diagnosis=(
            "The response has only one field, which is a list. The handler returns this list directly, and "
            "not a list that contains it."
        ),
        remedy="Put the list into a second list, [[…]], or return a dict with the name of the field.",
        reason=(
            "rospy uses the elements of a returned list as the values of the fields. Three values are "
            "too many for one field. The value of this field must be the whole list."
        ),
        unlike=("wrong_length",),
    ),
    _replied(
        name="dict_slip",
        play=serving('return {"sucess": True, "message": "open"}'),
        diagnosis="The handler returns a dict with a key that is not a field of the response.",
        remedy="Compare the keys with the fields that `rossrv show` prints, and correct the spelling.",
        reason=(
            "The error message contains the key `sucess` and the name of the response class. This class "
            "has no field with that name."
        ),
    ),
    _replied(
        name="wrong_type",
        play=serving('return SetBoolResponse("yes", "open")'),
        diagnosis="A field of the response gets a value of the wrong type.",
        remedy="Convert the value to the type of its field before you return it.",
        reason=(
            "`field success is not a bool`: the handler creates the response without an error. "
            "rospy finds the error later, when it converts the response to bytes."
        ),
    ),
    _replied(
        name="wrong_arity",
        play=running(keeper('return SetBoolResponse(True, "open")', **{"(request)": "()"})),
        diagnosis="The handler does not accept the request as its argument.",
        remedy="Give the handler one parameter, the request.",
        reason=(
            "`takes 0 positional arguments but 1 was given`: rospy passes the request to every handler,"
            " even if the request has no fields."
        ),
    ),
    _silent(
        name="sleeps",
        look="wait call",
        play=serving(
            'print("waiting for the hinge")\nhinge.wait()\nreturn SetBoolResponse(True, "open")',
            "import threading\n\nhinge = threading.Event()\n",
        ),
        diagnosis="The handler waits for an event that does not happen.",
        remedy="Give each wait in a handler a time limit, and give the call a deadline.",
        reason=(
            "The node answers `rosnode ping` and a probe of its service, because both use other "
            "threads. The last line of the server's output shows what the handler waits for. rospy "
            "has no time limit for calls."
        ),
        unlike=("lock",),
    ),
    _silent(
        name="exits",
        look="wait call",
        play=serving('print("there is no door: leaving")\nsys.exit(1)', "import sys\n"),
        diagnosis="The handler calls sys.exit(). This ends the handler's thread, so no response is sent.",
        remedy="Raise ServiceException to refuse a request, and never call sys.exit() in a handler.",
        reason=(
            "sys.exit() raises SystemExit, which rospy does not print and does not send to the client. The "
            "process still runs. Only the handler's thread has ended, and the client waits."
        ),
    ),
    _served(
        name="request_for_type",
        look="gone unavailable",
        story="A student starts the program that serves the door.",
        play=_requests_class,
        visitor="$ rosservice info /lab/door",
        diagnosis="The service is created with its request class instead of its type.",
        remedy="Use SetBool, the type that contains request and response.",
        reason=(
            "The server's output ends with `has no attribute '_request_class'`: only the service type has "
            "this attribute, so rospy never provided the service."
        ),
    ),
    _served(
        name="declared_twice",
        look="quiet call",
        story="A student corrects the handler and runs its cell again. The door still does not open.",
        play=running(TWICE),
        diagnosis="The service was created a second time in one program, and the old handler still answers.",
        remedy="Call shutdown() of the first service before you create the service again.",
        reason=(
            "The server's output contains `already registered`: rospy refused the second service, and "
            "the first handler still answers."
        ),
    ),
    _served(
        name="two_providers",
        look="quiet call",
        story="The door's node works, but the door does not open.",
        play=_two_providers,
        diagnosis="A second node now provides a service with the same name, and receives all calls.",
        remedy="End the second node, or rename its service. Then start the door's node again.",
        reason=(
            "Only one node can provide a service with a certain name: the node that registered last. No "
            "node gets an error. `rosservice info` shows a node that is not the door's node."
        ),
    ),
    _silent(
        name="lock",
        look="wait call",
        play=running(LOCKED),
        diagnosis="The handler holds a lock while it calls a service that needs the same lock.",
        remedy="Release the lock before the call, or pass the data without a call.",
        reason=(
            "The door's handler holds the thread lock and waits for the response of the bolt. The bolt's "
            "handler waits for the same thread lock. A handler may call another service of its own node. But "
            "during this call, it must not hold a lock that the other service needs."
        ),
        unlike=("sleeps",),
    ),
)
