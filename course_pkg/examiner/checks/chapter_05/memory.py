"""The servers that remember: the counter, and the switch."""

from collections.abc import Callable

from course_pkg.examiner import Exam, Its, part, says

A_NEW_SWITCH = """
from rospy.impl.tcpros_service import convert_return_to_response
from std_srvs.srv import SetBoolRequest, SetBoolResponse


def a_new_switch(kind, data):
    return convert_return_to_response(kind().handle_switch(SetBoolRequest(data)), SetBoolResponse)
"""
NEW_AND_OFF = "handle_switch(data=False) of a new Switch()"
MESSAGE = {
    "": "The message is empty: a field that is left out is an empty text.",
    says("True|False"): "The message is the word on or the word off.",
    says("on|off"): "The message is on or off, in small letters, and nothing else.",
}
NO_REFUSAL = "It is there already, and that is no error: answer, with success=False and where it stands."
STARTS_ON = "A new switch was told to go off, where it should have been already: start with False."
SHARES = (
    "The switch at /switch was on, and so was a new one, before anybody touched it: they share one value. "
    "Keep it in self, which each switch has for itself, not in the class or in a global."
)
ELSEWHERE = {
    True: "It stood there already, and now it says the other: data is where to go, not a push of a button.",
    False: "That is where it stood before. Turn it first, and answer then.",
}


@part(
    "05.2",
    points=2,
    goal="Count the calls of /count, and start again from zero when /reset_count is called.",
    needs=["Counter"],
)
def a_counter_that_resets(exam: Exam) -> None:
    """Count once to know where earlier calls have left it; then a short round and one beyond 9."""
    count = exam.service(
        "/count", "std_srvs/Trigger", hints={says("field message"): "The message is a text: str(self.count)."}
    )
    reset = exam.service(
        "/reset_count",
        "std_srvs/Empty",
        hints={says("returned None"): "Even an empty response has to be returned: return EmptyResponse()."},
    )
    before = count().message
    for last in (exam.draw.integer(3, 6), 12):
        reset()
        for number in range(1, last + 1):
            response = count()
            exam.expect(
                "success is True",
                expected=True,
                seen=response.success,
                hints={False: "success is False, as a field is that is left out: set it to True."},
            )
            exam.expect(
                "the message counts 1, 2, 3 from each reset",
                expected=str(number),
                seen=response.message,
                hints={
                    "": "The message is empty: a field that is left out is an empty text.",
                    says(r"^0\d"): "No zero stands in front: str(self.count).",
                    says(r"\D"): "The message is the number as text, and nothing else.",
                    _lost_a_digit(number): "After 9 comes 10, with both of its digits.",
                    _follows(before): "It went on from the old count: set self.count to zero in the reset.",
                    "0": "It says 0 after a call: add one first, and answer then.",
                    "1": "It says 1 again: keep the count in self, which outlives the call.",
                },
            )
            before = response.message


def _lost_a_digit(number: int) -> Callable[[str], bool]:
    return lambda message: len(message) < len(str(number))


def _follows(before: str) -> Callable[[str], bool]:
    return lambda message: int(message) == int(before) + 1


@part(
    "05.4",
    points=2,
    goal="A switch at /switch that goes where it is told, and says whether it moved and where it stands.",
    needs=["Switch"],
)
def a_switch_that_tells(exam: Exam) -> None:
    """Put it in a known place, then ten turns; the one at /switch may be on, so ask a new one, too."""
    turn = exam.service(
        "/switch", "std_srvs/SetBool", hints={says("process request: (?!service handler)"): NO_REFUSAL}
    )
    turn(data=False)
    exam.expect(
        "data=False means off",
        expected="off",
        seen=turn(data=False).message,
        hints={"on": "It was told data=False, and says on: True means on, False means off.", **MESSAGE},
    )
    on = False
    for data in [True, True, False, False, *(exam.draw.choice([True, False]) for _ in range(6))]:
        response = turn(data=data)
        exam.expect(
            "the message says where it stands now",
            expected="on" if data else "off",
            seen=response.message,
            hints={"off" if data else "on": ELSEWHERE[data == on], **MESSAGE},
        )
        exam.expect(
            "success says whether it moved",
            expected=data != on,
            seen=response.success,
            hints={
                True: "It was already there, so it did not move: success is not about whether all went well.",
                False: "It did move. Compare with where it stood before you turn it.",
            },
        )
        on = data
    exam.prepare(A_NEW_SWITCH)
    for stands, hint in ((False, STARTS_ON), (True, SHARES)):
        turn(data=stands)
        exam.expect(
            "a new switch is off",
            expected={"success": False, "message": "off"},
            seen=exam.run("a_new_switch", Its("Switch"), False, worded=NEW_AND_OFF).value,
            hints=hint,
        )
    turn(data=False)
