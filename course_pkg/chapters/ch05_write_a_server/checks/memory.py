"""Servers with a state: the counter and the switch."""

from collections.abc import Callable

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Condition
from course_pkg.checking.formatting import explained
from course_pkg.checking.peers.service_calls import TIMEOUT, response_of
from course_pkg.checking.plain_values import Message, Value
from course_pkg.checking.shared.served_by import require_served_by_notebook, require_still_served
from course_pkg.ros.node.proxy import BoundedProxy

# The check creates a new object of the student's class, registers a service for it, and calls the service. If
# the kernel returned the result of a direct call, the student's code could replace this result.
A_NEW_SERVER = """
import rospy
from std_srvs import srv


class NewServer:
    def open(self, kind, handler, name, service):
        self.service = rospy.Service(service, getattr(srv, name), getattr(kind(), handler))

    def close(self):
        self.service.shutdown("checked")


new_server = NewServer()
"""
NEW_AND_OFF = "handle_switch(data=False) of a new Switch()"
MESSAGE: list[tuple[Condition, str]] = [
    (
        "",
        "The message is empty, because ROS sends an empty string for a string that you do not set. "
        'Set the message to "on" or "off".',
    ),
    (matches("True|False"), 'The message is "True" or "False". Convert this value to "on" or "off".'),
    (
        matches("on|off"),
        'The message contains more than "on" or "off" in small letters. Return only one of these two words.',
    ),
]
ANOTHER_CLIENT = """
import rospy
from std_srvs import srv


def another_client(name, kind, **fields):
    return rospy.ServiceProxy(name, getattr(srv, kind))(**fields).message
"""
NO_REFUSAL = (
    "It is not an error if the switch already has the wanted position. Return success=False and the "
    "position in the response."
)
ALWAYS_TRUE: list[tuple[Condition, str]] = [
    (
        lambda actual: actual == {"success": True, "message": "off"},
        "A new switch is off, so a call with data=False does not move it. Return success=False in this case.",
    )
]
NOT_OFF: list[tuple[Condition, str]] = [
    (
        lambda actual: actual["message"] == "on",
        "A call with data=False switched a new switch on. The field `data` is the wanted position.",
    ),
    (ANYTHING, "A new switch was not off. In `__init__`, store the value that your handler stores for off."),
]
SHARES = (
    "A new Switch() was on, because it shares a variable with the switch at /switch. Store the "
    "position in `self`, not in the class or in a global variable."
)
ELSEWHERE = {
    True: (
        "The switch was already in the wanted position, but the handler moved it. The field "
        "`data` is the wanted position."
    ),
    False: (
        "The message is the position before the call. Change the position first, and then set the message."
    ),
}
COUNTED = "In the field `message`, return the number of calls since the last reset."
SUCCESS = "Return success=True."
POSITION = "In the field `message`, return the position after the call."
MOVED = "In the field `success`, return whether the switch moved."


@part(
    "05.2",
    points=2,
    goal="Serve /count, which counts its calls, and /reset_count, which sets the count to zero.",
    needs=["Counter|count_service"],
    goals={COUNTED: 3, SUCCESS: 1},
)
def a_counter_that_resets(context: CheckContext) -> None:
    """Call /count, reset the counter, and call /count until the count has two digits."""
    count = context.service(
        "/count",
        "std_srvs/Trigger",
        hints=[
            (
                matches("field message"),
                "The message has to be a string. Convert the count to a string: str(self.count).",
            ),
            (
                matches(r"args are\(,\)"),
                "The handler of /count returned an empty response. Use the handler of "
                "/reset_count only for /reset_count.",
            ),
        ],
    )
    reset = context.service(
        "/reset_count",
        "std_srvs/Empty",
        hints=[
            (
                matches("returned None"),
                "The handler returned None. Return a response, even if the response is empty: "
                "EmptyResponse().",
            )
        ],
    )
    require_served_by_notebook(context, "/count", "/reset_count")
    count(), count()
    before = count().message
    for last in (context.random.integer(3, 6), context.random.integer(14, 60)):
        reset()
        for number in range(1, last + 1):
            response = count()
            with context.goal(SUCCESS):
                context.expect(
                    "success is True",
                    expected=True,
                    actual=response.success,
                    hints=[
                        (
                            False,
                            "success is False, because ROS sends False for a bool that you do not "
                            "set. Set success to True.",
                        )
                    ],
                )
            context.expect(
                "after each reset, the messages of the calls are 1, 2, 3",
                expected=str(number),
                actual=response.message,
                hints=[
                    (
                        "",
                        "The message is empty, because ROS sends an empty string for a string that "
                        "you do not set. Set the message to the count.",
                    ),
                    (matches(r"^0\d"), "The message begins with an extra zero. Use str(self.count)."),
                    (
                        matches(r"\D"),
                        "The message contains more than the number. Return only the number, as a string.",
                    ),
                    (
                        _lost_a_digit(number),
                        "For counts above 9, the message has only one digit. Return all digits "
                        "of the number.",
                    ),
                    (
                        _follows(before),
                        "The count continued after the reset. In handle_reset, set self.count to zero, and "
                        "use the same Counter object for both services.",
                    ),
                    (
                        _is_two(number),
                        "The first call after a reset returned 2. Set the count to 0 in the reset, not to 1.",
                    ),
                    ("0", "The message is 0 after a call. Add 1 to the count before you return the message."),
                    (
                        "1",
                        "The message is also 1 after the second call. Store the count in `self`, so that "
                        "the next call can use this count.",
                    ),
                ],
            )
            before = response.message
    require_still_served(context, "/count", "/reset_count")
    context.prepare(ANOTHER_CLIENT)
    context.expect(
        "after each reset, the messages of the calls are 1, 2, 3",
        expected=str(int(before) + 1),
        actual=context.run("another_client", "/count", "Trigger", worded="a call from another client").value,
        hints=("Each client has a separate count. Store one count for all clients in `self`."),
    )
    _starts_from_zero(context)
    context.fulfilled(COUNTED)


def _starts_from_zero(context: CheckContext) -> None:
    """While the count of /count is not 0, create a new Counter(), and assert that its first call returns 1.

    If the student has no class Counter, nothing is tested.
    """
    if not context.has("Counter"):
        return
    worded = "handle_count() of a new Counter()"
    new, error, created = _answer_of_a_new(context, "Counter", "handle_count", "Trigger", worded)
    if created and (error or new.message != "1"):
        context.fail(
            "after each reset, the messages of the calls are 1, 2, 3",
            expected="'1'",
            actual=error or repr(new.message),
            hint="A new counter did not start from zero. Set the count to zero in `__init__`, and "
            "store this count in `self`.",
        )


def _lost_a_digit(number: int) -> Callable[[str], bool]:
    return lambda message: len(message) < len(str(number))


def _is_two(number: int) -> Callable[[str], bool]:
    return lambda message: number == 1 and message == "2"


def _follows(before: str) -> Callable[[str], bool]:
    return lambda message: int(message) == int(before) + 1


@part(
    "05.4",
    points=2,
    goal=(
        "Serve /switch. Move the switch to the wanted position; return the new position, and "
        "whether the switch moved."
    ),
    needs=["Switch|switch_service"],
    goals={POSITION: 2, MOVED: 2, "Make sure that each new Switch() is off.": 1},
)
def a_switch_that_tells(context: CheckContext) -> None:
    """Call /switch with data=False, and then ten more times; also call it from another client.

    At the end, create a new Switch(), which must be off.
    """
    turn = context.service(
        "/switch", "std_srvs/SetBool", hints=[(matches("process request: (?!service handler)"), NO_REFUSAL)]
    )
    require_served_by_notebook(context, "/switch")
    turn(data=False)
    with context.goal(POSITION):
        context.expect(
            'after a call with data=False, the message is "off"',
            expected="off",
            actual=turn(data=False).message,
            hints=[
                (
                    "on",
                    'The field `data` is False, but the message is "on". Return "on" for True, '
                    'and "off" for False.',
                ),
                *MESSAGE,
            ],
        )
    on, never_false = False, True
    for data in [True, True, False, False, *(context.random.choice([True, False]) for _ in range(6))]:
        response = turn(data=data)
        never_false = never_false and response.success
        with context.goal(POSITION):
            context.expect(
                "the message is the position after the call",
                expected="on" if data else "off",
                actual=response.message,
                hints=[("off" if data else "on", ELSEWHERE[data == on]), *MESSAGE],
            )
        with context.goal(MOVED):
            context.expect(
                "success shows whether the switch moved",
                expected=data != on,
                actual=response.success,
                hints=[
                    (
                        True,
                        "The switch was already in the wanted position, but success is True. Set "
                        "success to True only if the old position differs from `data`.",
                    ),
                    (
                        False,
                        "The switch moved, but success is False. Compare `data` with the "
                        "position before you change the position."
                        if data
                        else "The switch moved from on to off, but success is False. A move to off counts, "
                        "too: set success to True if the old position differs from `data`.",
                    ),
                ],
            )
        on = data
    # The kernel is the other client, so the check compares only the next response to the check's own client.
    context.prepare(ANOTHER_CLIENT)
    worded = f"a call from another client with data={not on}"
    context.run("another_client", "/switch", "SetBool", data=not on, worded=worded)
    with context.goal(MOVED):
        context.expect(
            "success shows whether the switch moved",
            expected=False,
            actual=turn(data=not on).success,
            hints=(
                "Another client moved the switch to this position, but for the next client, success is True. "
                "Store one position for all clients in `self`."
            ),
        )
    context.fulfilled(POSITION)
    context.fulfilled(MOVED)
    require_still_served(context, "/switch")
    if not context.has("Switch"):  # The student may use a function as the handler, without a class.
        return
    for stands, hints in ((False, [*ALWAYS_TRUE, *NOT_OFF] if never_false else NOT_OFF), (True, SHARES)):
        turn(data=stands)
        new, error, _ = _answer_of_a_new(
            context, "Switch", "handle_switch", "SetBool", NEW_AND_OFF, data=False
        )
        context.require(
            f"{NEW_AND_OFF} returns",
            holds=not error,
            expected="a value",
            actual=error,
            hints=explained(error),
        )
        context.expect(
            "a new switch is off",
            expected={"success": False, "message": "off"},
            actual=new,
            hints=hints,
        )
    turn(data=False)


def _answer_of_a_new(
    context: CheckContext, kind: str, handler: str, type_name: str, worded: str, **fields: Value
) -> tuple[Message, str, bool]:
    """Call a handler of a new object of the student's class once.

    Return (the response, an error message, whether the object could be created without arguments).
    """
    name, service = f"/{context.random.word()}", f"std_srvs/{type_name}"
    context.prepare(A_NEW_SERVER)
    opened = context.run("new_server.open", Its(kind), handler, type_name, name, worded=worded)
    if opened.error:
        return None, opened.error, False
    service_class = context.service_class(service)
    proxy = BoundedProxy(name, service_class, timeout=TIMEOUT)
    try:
        return (*response_of(proxy.call, service_class._request_class(**fields)), True)
    finally:
        proxy.close()
        context.run("new_server.close", worded=worded)
