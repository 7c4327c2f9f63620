"""08.3: a client that moves a switch and then reads the position of the switch."""

from __future__ import annotations

from dataclasses import dataclass

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.plain_values import Fields, Message


@dataclass(frozen=True)
class Case:
    """The behaviour of a switch in a call, and the value that `move` must return."""

    name: str  # `name` is the name of the case in the titles of assertions.
    there: bool  # True if the switch is already in the requested position.
    obeys: bool
    success: bool
    expected: str
    wrong_results: list[tuple[str, str]]  # Each tuple contains a wrong result and a hint.


CASES = (
    Case(
        "a switch that moves",
        there=False,
        obeys=True,
        success=True,
        expected="moved",
        wrong_results=[
            (
                "was there",
                "The switch responded with success=True and is in the wanted position, so it "
                'has moved. Return "moved".',
            ),
            (
                "failed",
                'The switch is in the wanted position, so the result is not "failed". Compare the '
                'message of `report` with the strings "open" and "closed".',
            ),
        ],
    ),
    Case(
        "a switch that is already in the wanted position",
        there=True,
        obeys=True,
        success=False,
        expected="was there",
        wrong_results=[
            (
                "moved",
                "The switch responded with success=False and is in the wanted position, so it was in "
                'this position before the call. Return "was there".',
            ),
            (
                "failed",
                "success=False does not always mean that the call failed: here, the switch is in the "
                "wanted position. Call `report` to get the position.",
            ),
        ],
    ),
    Case(
        "a switch that responds with success=False and does not move",
        there=False,
        obeys=False,
        success=False,
        expected="failed",
        wrong_results=[
            (
                "was there",
                "The switch responded with success=False and is in the wrong position. Call "
                "`report` to get the position.",
            ),
        ],
    ),
    Case(
        "a switch that responds with success=True but does not move",
        there=False,
        obeys=False,
        success=True,
        expected="failed",
        wrong_results=[
            (
                "moved",
                "The switch responded with success=True, but the switch is in the wrong "
                "position. Call `report` after `set`, and compare the position with `to_open`, even if "
                "success is True.",
            ),
        ],
    ),
    Case(
        "a switch that moves",
        there=True,
        obeys=True,
        success=True,
        expected="moved",
        wrong_results=[
            (
                "was there",
                "The switch responded with success=True and is in the wanted position. To decide whether "
                "the switch has moved, use the field `success`, not the position before the call.",
            ),
        ],
    ),
)


@dataclass
class FakeSwitch:
    """A switch whose behaviour is described by the Case object `case`."""

    case: Case
    is_open: bool
    message: str

    def handle_set(self, request: Message) -> Fields:
        """Move the switch if `case.obeys` is True; return the response that `case` describes."""
        self.is_open = bool(request.data) if self.case.obeys else self.is_open
        return {"success": self.case.success, "message": self.message}

    def handle_report(self, _: Message) -> Fields:
        """Return the true position in the field `message`."""
        return {"success": True, "message": "open" if self.is_open else "closed"}


@part(
    "08.3",
    points=3,
    goal='Call `set` once, and then call `report`. Return "moved", "was there" or "failed".',
    needs=["move"],
    deadline=25.0,
)
def move_and_verify(context: CheckContext) -> None:
    """Call move() for switches that behave differently; request both positions of each kind of switch."""
    moves = [(case, to_open) for case in CASES for to_open in context.random.shuffled([True, False])]
    again = context.random.shuffled(CASES)[: context.random.integer(3, 5)]
    moves += [(case, context.random.choice([True, False])) for case in again]
    settings = [_move(context, case, to_open) for case, to_open in moves]
    # Check the number of calls at the end, because a thread of the student's function can repeat a call
    # later.
    for (_, to_open), setting in zip(moves, settings, strict=True):
        _is_set_once(context, setting, to_open)
    _move_again(context)


def _move_again(context: CheckContext) -> None:
    """Call move() twice with the same arguments; the second time, the switch is in the position already."""
    name, to_open = f"/{context.random.word()}", context.random.choice([True, False])
    moves, is_there = CASES[0], CASES[1]
    switch = FakeSwitch(moves, not to_open, context.random.word())
    setting = context.serve(f"{name}/set", "std_srvs/SetBool", switch.handle_set)
    context.serve(f"{name}/report", "std_srvs/Trigger", switch.handle_report)
    for count, case in enumerate((moves, is_there), start=1):
        switch.case = case
        result = context.run("move", name, to_open).returned()
        again = (
            "The check called move() twice with the same arguments, but the second time, your function did "
            "not call `set`. Call `set` each time move() runs."
        )
        context.expect(
            "`set` is called once, with the wanted position",
            expected=[{"data": to_open}] * count,
            actual=setting.requests,
            hints=[([{"data": to_open}], again), *_wrongly_set(to_open)],
        )
        context.expect(
            f'{case.name}: the result is "{case.expected}"',
            expected=case.expected,
            actual=result,
            hints=_wrong_outcome(case, switch),
        )


def _wrongly_set(to_open: bool) -> Hints:
    return [
        ([], "The function did not call `set`. Call `set` first, and then `report`."),
        (
            [{"data": not to_open}],
            (
                "The field `data` of the request has the wrong value. Send data=True to open the switch, "
                "and data=False to close the switch."
            ),
        ),
        (ANYTHING, "The function called `set` more than once. Call `set` only once, and store the response."),
    ]


def _wrong_outcome(case: Case, switch: FakeSwitch) -> Hints:
    return [
        (None, NO_RETURN),
        (
            (lambda actual: isinstance(actual, bool)),
            "Your function returned a bool, but three results are possible. Return one of the three strings.",
        ),
        (
            (lambda actual: switch.message in actual),
            "Your function returned the message of `set`, which is different for each switch. "
            "Return one of the three strings.",
        ),
        *case.wrong_results,
        (ANYTHING, 'Return "moved", "was there" or "failed". Write the string exactly as in the exercise.'),
    ]


def _is_set_once(context: CheckContext, setting: ScriptedServer, to_open: bool) -> None:
    context.expect(
        "`set` is called once, with the wanted position",
        expected=[{"data": to_open}],
        actual=setting.requests,
        hints=_wrongly_set(to_open),
    )


def _move(context: CheckContext, case: Case, to_open: bool) -> ScriptedServer:
    """Call move() for a new switch, and return the server of its service `set`."""
    name = f"/{context.random.word()}"
    switch = FakeSwitch(case, to_open is case.there, context.random.word())
    setting = context.serve(f"{name}/set", "std_srvs/SetBool", switch.handle_set)
    context.serve(f"{name}/report", "std_srvs/Trigger", switch.handle_report)
    unavailable = (
        "Your function called a service that does not exist. Call only the services `set` and `report` "
        "below the node's name, such as f'{switch}/set'."
    )
    result = context.run("move", name, to_open, hints=[(matches("unavailable"), unavailable)]).returned()
    _is_set_once(context, setting, to_open)
    context.expect(
        f'{case.name}: the result is "{case.expected}"',
        expected=case.expected,
        actual=result,
        hints=_wrong_outcome(case, switch),
    )
    return setting
