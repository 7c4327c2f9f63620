"""08.5: a client in Python that can call services of any type."""

from __future__ import annotations

from course_pkg.chapters.ch08_use_existing_services.checks.example_calls import ExampleCall, example_calls
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN

IS_MESSAGE = """
def is_message(function, *args):
    return hasattr(function(*args), "_slot_types")
"""  # A check receives a message as a dict, so only code in the kernel sees the difference.
ERRORS = [
    (
        matches("'str' object has no attribute '_request_class'"),
        "This is the name of the type, which is a string. Get the class with get_service_class_by_name.",
    ),
    (
        matches("must be a Message"),
        "This is the class of the service type. Create an object of its _request_class, and "
        "fill this object.",
    ),
    (
        matches(r"type object '\w+' has no attribute '_request_class'"),
        "rospy.ServiceProxy got the class of the request. Pass the class of the service type.",
    ),
    (
        matches(r"args are\(None,\)"),
        "fill_message_args returns None, and your function sent this value. Send the request "
        "that was filled.",
    ),
    (
        matches("No field name"),
        "This service had another type before. Get the class of its type in each call, and don't store it.",
    ),
    (matches("KeyError: 0"), "fill_message_args needs a list of values. Write [fields]."),
    (
        matches("md5sums do not match"),
        "Your proxy has the wrong type for this service. Get the class of its type in each "
        "call, with get_service_class_by_name.",
    ),
]
FLAT = (
    "The request did not get the values of the dict. Fill its fields by name: "
    "genpy.message.fill_message_args(request, [fields])."
)
NESTED = (
    "The field `camera_info` needs a message, but it got a dict. "
    "genpy.message.fill_message_args can fill a request from a dict that contains dicts."
)
CALLED = "Call services of three types, and return the fields of the response."


@part(
    "08.5",
    points=3,
    goal="Call a service of any type with the fields in a dict, and return its response.",
    needs=["call_any"],
    deadline=25.0,
    goals={CALLED: 2, "Raise an error for an unknown field, and return the whole response.": 1},
)
def call_of_any_type(context: CheckContext) -> None:
    """Serve three types with random names; then change the type of a name, and pass an unknown field."""
    for example in example_calls(context):
        _calls(context, example)
    context.fulfilled(CALLED)
    name = f"/{context.random.word()}"
    former = context.serve(name, "std_srvs/Trigger", lambda _: {"success": True})
    context.run("call_any", name, {}, hints=ERRORS).returned()
    former.leave()
    server = context.serve(name, "std_srvs/SetBool", lambda _: {"success": True})
    wrong = context.run("call_any", name, {"dat": True})
    context.require(
        "a field that the type does not have is an error",
        holds=bool(wrong.error) and not server.requests and not wrong.error.startswith("ROSServiceException"),
        expected="an error about dat",
        actual=wrong.error or "no error, and a call without this field",
        hints=[
            (
                matches("^ROSServiceException"),
                "rosservice.call_service catches the exception of genpy, and raises a "
                "different exception. Fill the request with genpy.message.",
            ),
            (
                ANYTHING,
                "The function ignored a field name that the type does not have. Do not catch the "
                "exception that is raised for this name.",
            ),
        ],
    )
    context.prepare(IS_MESSAGE)
    whole = context.run(
        "is_message", Its("call_any"), name, {"data": True}, worded="call_any()", hints=ERRORS
    )
    context.expect(
        "the response is returned",
        expected="a response",
        actual="a response" if whole.returned() else "an object of another type with the same values",
        hints="Return the object that the proxy returns, not a dict of its fields.",
    )


CALLED_WRONGLY: Hints = [
    (0, "The function did not call the service. Call the proxy with the request."),
    (
        ANYTHING,
        "The function called the service more than once, so the server repeated its work. "
        "Call the service once.",
    ),
]


NOT_RETURNED: Hints = [
    (None, NO_RETURN),
    (
        (lambda actual: isinstance(actual, list) and all(isinstance(item, str) for item in actual)),
        "These are lines of text. Return the object that the proxy returns.",
    ),
    ((lambda actual: isinstance(actual, list)), "This is more than the response. Return only the response."),
    (ANYTHING, "Return the whole response, unchanged."),
]


def _calls(context: CheckContext, example: ExampleCall) -> None:
    name = f"/{context.random.word()}"
    server = context.serve(name, example.kind, lambda _: example.answer)
    unfilled = NESTED if "camera_info" in example.fields else FLAT
    hints = [*ERRORS, (ANYTHING, unfilled)]
    returned = context.run("call_any", name, example.fields, hints=hints).returned()
    context.expect(
        "the service is called once", expected=1, actual=len(server.requests), hints=CALLED_WRONGLY
    )
    context.expect(
        f"{example.what}: the fields arrive as they were given",
        expected=example.fields,
        actual=example.given(server.requests[0]),
        hints=[
            (
                example.mixed_up,
                "The values are in the wrong fields. Fill them by name, not by position.",
            ),
            (
                matches(": ''|: 0|: False"),
                "A field without a value is empty, 0 or False. Fill the request before the call.",
            ),
        ],
    )
    context.expect("the response is returned", expected=example.answer, actual=returned, hints=NOT_RETURNED)
