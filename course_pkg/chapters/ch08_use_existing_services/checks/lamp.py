"""08.2: a server that handles each call with a call of another service, which has a different type."""

from __future__ import annotations

from course_pkg.checking import ANYTHING, CheckContext, Refuse, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.peers.service_calls import Service
from course_pkg.checking.shared.served_by import require_served_by_notebook, require_still_served

LAMP = "/on_off"
KIND = "course_pkg/ServiceExample"
STATES = {True: "ON", False: "OFF"}
NO_ERROR: Hints = [
    (
        matches("field message"),
        "The field `message` has to be a string. Convert the exception with str(error).",
    ),
    (
        matches("error processing request: timeout exceeded"),
        "The handler did not catch rospy.ROSException. Catch this exception, too, and return success=False.",
    ),
    (
        matches("cannot process request: (?!service handler|handler)"),
        "The call of /lamp failed, because your handler raised an exception. Catch "
        "rospy.ServiceException, and return success=False.",
    ),
]
OBEYED = "Call /on_off once with 1 or 0. Return success=True if the lamp has the wanted state."
COMPARED = "Return success=False if /on_off refuses the request or the lamp has the wrong state."


@part(
    "08.2",
    points=3,
    goal=(
        "Serve /lamp. In the handler, call /on_off once with 1 or 0. Return success=True only if the "
        "lamp has the wanted state."
    ),
    needs=["handle_lamp|lamp_service"],
    deadline=20.0,
    goals=[OBEYED, COMPARED, "Return success=False if no server offers /on_off."],
)
def translate(context: CheckContext) -> None:
    """Call /lamp several times; its server obeys, returns the wrong state, refuses, or does not exist."""
    panel = context.service("/lamp", "std_srvs/SetBool", hints=NO_ERROR)
    require_served_by_notebook(context, "/lamp")
    for data in (*context.random.shuffled([True, False]), context.random.choice([True, False])):
        _obeys(context, panel, data)
    context.fulfilled(OBEYED)
    for data in context.random.shuffled([True, False]):
        _disobeys(context, panel, data)
    for data in context.random.shuffled([True, False]):
        _refuses(context, panel, data)
    for obeys in context.random.shuffled([True] * context.random.integer(1, 3) + [False] * 2):
        try_lamp = _obeys if obeys else _disobeys
        try_lamp(context, panel, context.random.choice([True, False]))
    context.fulfilled(COMPARED)
    require_still_served(context, "/lamp")
    context.absent(LAMP)
    data = context.random.choice([True, False])
    _fails(context, panel, data, "no server offers /on_off", "unavailable", "timeout exceeded")


def _obeys(context: CheckContext, panel: Service, data: bool) -> None:
    lamp = context.serve(LAMP, KIND, lambda request: {"state": STATES[request.number == 1]})
    response = panel(data=data)
    context.expect(
        "the handler calls /on_off once, with 1 for True and 0 for False",
        expected=[{"number": int(data)}],
        actual=lamp.requests,
        hints=[
            (
                [],
                "The handler did not call /on_off. Create a proxy without persistent=True, and "
                "call this proxy.",
            ),
            (
                [{"number": int(not data)}],
                "The number in the request to /on_off is wrong. Send 1 to switch the lamp on, and 0 to "
                "switch the lamp off.",
            ),
            (
                lambda actual: len(actual) > 1,
                "The handler called /on_off more than once. Call /on_off only once, and store the response.",
            ),
            (
                ANYTHING,
                "The number in the request to /on_off has to be 1 or 0. Send 1 for True, and 0 for False.",
            ),
        ],
    )
    context.expect(
        "the lamp has the wanted state: success is True",
        expected=True,
        actual=response.success,
        hints=(
            "The lamp has the wanted state, but success is not True. Compare the state with ON if "
            "`data` is True, and with OFF if `data` is False."
        ),
    )
    context.expect(
        "the lamp has the wanted state: the message is the state",
        expected=STATES[data],
        actual=response.message,
        hints="The message is wrong. Return the field `state` of the lamp's response without any change.",
    )
    lamp.leave()


def _disobeys(context: CheckContext, panel: Service, data: bool) -> None:
    state = STATES[not data]
    lamp = context.serve(LAMP, KIND, lambda _: {"state": state})
    response = panel(data=data)
    context.expect(
        "the lamp has the wrong state: success is False",
        expected=False,
        actual=response.success,
        hints=(
            "The lamp responded with the wrong state, but success is True. Compare the state "
            "in the response with the wanted state."
        ),
    )
    context.expect(
        "the lamp has the wrong state: the message is the lamp's state",
        expected=state,
        actual=response.message,
        hints="The message is the wanted state. Return the state in the lamp's response instead.",
    )
    _was_called_once(context, lamp)
    lamp.leave()


def _was_called_once(context: CheckContext, lamp: ScriptedServer) -> None:
    if len(lamp.requests) != 1:
        context.fail(
            "the handler calls /on_off once, with 1 for True and 0 for False",
            expected="one call for each call of /lamp",
            actual=f"{len(lamp.requests)} calls",
            hint=(
                "The handler repeated the call of /on_off. Call /on_off only once, even after "
                "an error or a wrong state."
            ),
        )


def _refuses(context: CheckContext, panel: Service, data: bool) -> None:
    reason = f"{context.random.word()} is hot"
    lamp = context.serve(LAMP, KIND, lambda _: Refuse(reason))
    _fails(context, panel, data, "/on_off refuses the request", reason)
    _was_called_once(context, lamp)
    lamp.leave()


def _fails(context: CheckContext, panel: Service, data: bool, failure: str, *reasons: str) -> None:
    response = panel(data=data)
    context.expect(
        f"{failure}: success is False",
        expected=False,
        actual=response.success,
        hints="The call of /on_off failed, but success is True. Return success=False in this case.",
    )
    context.require(
        f"{failure}: the message is the error message",
        holds=any(reason in response.message for reason in reasons),
        expected=f"a message that contains {reasons[0]!r}",
        actual=response.message,
        hints=(
            "The message does not contain the reason for the failure. Use the text of the "
            "exception, str(error), as the message."
        ),
    )
