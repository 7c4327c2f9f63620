"""08.5: a client in Python that can call services of any type."""

from __future__ import annotations

import io

from course_pkg.chapters.ch08_use_existing_services.checks.example_calls import ExampleCall, example_calls
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.result import Result

SERIALISED = """
import io


def serialised(function, *args):
    response, data = function(*args), io.BytesIO()
    if hasattr(response, "_slot_types"):
        response.serialize(data)
    return list(data.getvalue())
"""  # A check receives a message as a dict, but code in the kernel can serialise only a message.
WRONG_TYPE = (
    "Your function used a wrong type for this service. In each call, get the class of the "
    "service's type with get_service_class_by_name."
)
ERRORS = [
    (
        matches("'str' object has no attribute '_request_class'"),
        "Your function used the name of the type as the class, but the name is a string. Get the class with "
        "get_service_class_by_name.",
    ),
    (
        matches("must be a Message"),
        "Your function passed an object of the wrong class to fill_message_args. Pass a request: "
        "its class is the attribute `_request_class` of the service type.",
    ),
    (
        matches(r"type object '\w+' has no attribute '_request_class'"),
        "Your function passed the class of the request to rospy.ServiceProxy. Pass the class of the "
        "service type instead.",
    ),
    (
        matches(r"args are\(None,\)"),
        "Your function sent the return value of fill_message_args, which is None. Send the request that "
        "you passed to fill_message_args.",
    ),
    (
        matches("No field name"),
        "This service had a different type in an earlier call. Get the class of the type again in each call.",
    ),
    (matches("KeyError: 0"), "The second argument of fill_message_args has to be a list. Write [fields]."),
    (matches("md5sums do not match"), WRONG_TYPE),
]
UNKNOWN_TYPE = (
    "Your function found no type for this service. Get the class from the server with "
    "rosservice.get_service_class_by_name."
)
FLAT = (
    "The request does not contain the values of the dict. Fill the fields by name: "
    "genpy.message.fill_message_args(request, [fields])."
)
NESTED = (
    "The field `camera_info` needs a message, but it got a dict. Use genpy.message.fill_message_args, "
    "which also accepts a dict inside a dict."
)
CALLED = "Call services of three different types, and return the fields of each response."


@part(
    "08.5",
    points=3,
    goal="Call a service of any type, and return its response. A dict contains the fields of the request.",
    needs=["call_any"],
    deadline=25.0,
    goals={
        CALLED: 2,
        ("Raise an error if the type has no field with the given name. Return the whole response."): 1,
    },
)
def call_of_any_type(context: CheckContext) -> None:
    """Call services of three types, change the type of a service, and make a call with an unknown field."""
    for example in example_calls(context):
        _calls(context, example)
    context.fulfilled(CALLED)
    name = f"/{context.random.word()}"
    former = context.serve(name, "std_srvs/Trigger", lambda _: {"success": True})
    context.run("call_any", name, {}, hints=ERRORS).returned()
    former.leave()
    answer = context.service_class("std_srvs/SetBool")._response_class(True, context.random.word())
    server = context.serve(name, "std_srvs/SetBool", lambda _: answer)
    strays = context.random.shuffled(["dat", context.random.word()])
    for fields, stray in zip(({}, {"data": True}), strays, strict=True):
        wrong = context.run("call_any", name, {**fields, stray: True})
        _is_an_error(context, wrong, server, stray)
    nested = f"/{context.random.word()}"
    camera = context.serve(nested, "sensor_msgs/SetCameraInfo", lambda _: {"success": True})
    stray = context.random.word()
    wrong = context.run("call_any", nested, {"camera_info": {"width": 640, stray: 480}})
    _is_an_error(context, wrong, camera, stray)
    context.prepare(SERIALISED)
    whole = context.run(
        "serialised", Its("call_any"), name, {"data": True}, worded="call_any()", hints=ERRORS
    ).returned()
    data = io.BytesIO()
    answer.serialize(data)
    context.require(
        "call_any() returns the response",
        holds=whole == list(data.getvalue()),
        expected="a response",
        actual="an object of a different type, or with other values",
        hints="The function returned a dict or a similar object. Return the object that the proxy returns.",
    )


def _is_an_error(context: CheckContext, wrong: Result, server: ScriptedServer, stray: str) -> None:
    context.require(
        "an unknown field name causes an error",
        holds=bool(wrong.error) and not server.requests and not wrong.error.startswith("ROSServiceException"),
        expected=f"an error for the field {stray}",
        actual=wrong.error or "no error, and a call of the service without this field",
        hints=[
            (
                matches("^ROSServiceException"),
                "rosservice.call_service raises its own exception instead of the exception of genpy. "
                "Fill the request with genpy.message.fill_message_args.",
            ),
            (
                ANYTHING,
                "The function ignored a field name that the type does not have. Pass all fields to "
                "genpy, and do not catch its exception.",
            ),
        ],
    )


CALLED_WRONGLY: Hints = [
    (0, "The function did not call the service. Call the proxy with the filled request."),
    (
        ANYTHING,
        "The function called the service more than once. Call the service only once.",
    ),
]


NOT_RETURNED: Hints = [
    (None, NO_RETURN),
    (
        (lambda actual: isinstance(actual, list) and all(isinstance(item, str) for item in actual)),
        "The function returned lines of text. Return the object that the proxy returns.",
    ),
    (
        (lambda actual: isinstance(actual, list)),
        "The function returned a list, but it has to return only the response.",
    ),
    (ANYTHING, "The function did not return the response. Return the whole response without any change."),
]


def _calls(context: CheckContext, example: ExampleCall) -> None:
    name = f"/{context.random.word()}"
    server = context.serve(name, example.kind, lambda _: example.answer)
    unfilled = NESTED if "camera_info" in example.fields else FLAT
    no_entry = matches(rf"^KeyError: '(/?{name[1:]}|{example.kind})'")
    wrong_type = matches("No field name|md5sums do not match")
    hints = [(no_entry, UNKNOWN_TYPE), (wrong_type, WRONG_TYPE), *ERRORS, (ANYTHING, unfilled)]
    returned = context.run("call_any", name, example.fields, hints=hints).returned()
    context.expect(
        "the service is called once", expected=1, actual=len(server.requests), hints=CALLED_WRONGLY
    )
    context.expect(
        f"{example.what}: the server receives the given values",
        expected=example.fields,
        actual=example.given(server.requests[0]),
        hints=[
            (
                example.mixed_up,
                "The values are in the wrong fields. Fill the fields by name, not by position.",
            ),
            (
                matches(": ''|: 0|: False"),
                "All fields of the request have their default values, such as 0 or False. Fill the "
                "fields of the request before the call.",
            ),
        ],
    )
    context.expect(
        "call_any() returns the response", expected=example.answer, actual=returned, hints=NOT_RETURNED
    )
