"""The checks of chapter 05: the student's servers, called from outside."""

import re
from collections.abc import Callable, Mapping
from itertools import combinations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service
from course_pkg.graph.probe import ask_all, header_fields, service_probe
from course_pkg.graph.snapshot import ServiceSeen

SIDES = ("length", "width", "height")
OWN_WORDS = "cannot process request: (?!(service )?handler returned)"  # else rospy found the words
A_NEW_SWITCH = """
from rospy.impl.tcpros_service import convert_return_to_response
from std_srvs.srv import SetBoolRequest, SetBoolResponse


def a_new_switch(kind, data):
    return convert_return_to_response(kind().handle_switch(SetBoolRequest(data)), SetBoolResponse)
"""
MESSAGE = {
    "": "The message is empty: a field that is left out is an empty text.",
    says("True|False"): "The message is the word on or the word off.",
    says("on|off"): "The message is on or off, in small letters, and nothing else.",
}
ELSEWHERE = {
    True: "It stood there already, and now it says the other: data is where to go, not a push of a button.",
    False: "That is where it stood before. Turn it first, and answer then.",
}


@part(
    "05.1",
    points=2,
    goal="Answer /getGeometry with the area and the volume of a box.",
    needs=["handle_geometry"],
)
def area_and_volume(exam: Exam) -> None:
    """Send three boxes of three different sides each."""
    get_geometry = exam.service("/getGeometry", "course_pkg/geometry")
    for _ in range(3):
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        response = get_geometry(length=length, width=width, height=height)
        exam.expect(
            "area is width times length",
            expected=width * length,
            seen=response.area,
            near=1e-3,
            hints={
                0.0: "The area is 0, as a field is that never gets a value.",
                width + length: "That is width + length. An area is a product.",
                2 * (width + length): "That is the way around the floor. An area is a product.",
                width * height: "That is the front of the box, width times height, and not its floor.",
                length * height: "That is a side of the box, length times height, and not its floor.",
                width * length * height: "That is the volume. The response has area first, then volume.",
            },
        )
        exam.expect(
            "volume is area times height",
            expected=width * length * height,
            seen=response.volume,
            near=1e-3,
            hints={
                0.0: "The volume is 0, as a field is that never gets a value.",
                width + length + height: "That is the sum of the sides. A volume is their product.",
                width * length + height: "That is area + height. A volume is a product.",
                width * length: "That is the area once more: multiply it by the height.",
            },
        )


@part(
    "05.2",
    points=2,
    goal="Count the calls of /count, and start again from zero when /reset_count is called.",
    needs=["Counter"],
)
def a_counter_that_resets(exam: Exam) -> None:
    """Count once to know where earlier calls have left it; then a short round and one beyond 9."""
    count = exam.service("/count", "std_srvs/Trigger")
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
    "05.3",
    points=2,
    goal="Answer /getGeometryChecked as before, but refuse a negative side, and name it.",
    needs=["handle_checked_geometry"],
)
def a_box_that_cannot_be(exam: Exam) -> None:
    """Send a good box and three flat ones; then each side negative in turn, and each two of them."""
    get_geometry = exam.service(
        "/getGeometryChecked",
        "course_pkg/geometry",
        hints={says(OWN_WORDS): "This box can be. Zero is fine; less is not."},
    )
    for flat in ("", *SIDES):
        sides = _box(exam, {flat: 0.0})
        response = get_geometry(**sides)
        area = sides["width"] * sides["length"]
        exam.expect(
            "a box that can be is measured",
            expected=[area, area * sides["height"]],
            seen=[response.area, response.volume],
            near=1e-3,
        )
    depths = [*(-float(depth) for depth in exam.draw.integers(2, 2, 9)), -0.5]
    for side, depth in zip(exam.draw.shuffled(SIDES), depths, strict=True):
        _refused(exam, get_geometry, {side: depth})
    for pair in combinations(SIDES, 2):
        _refused(exam, get_geometry, dict(zip(pair, exam.draw.shuffled(depths[:2]), strict=True)))


def _box(exam: Exam, given: Mapping[str, float]) -> dict[str, float]:
    drawn = zip(SIDES, exam.draw.numbers(3, 0.5, 9.0), strict=True)
    return {side: given.get(side, value) for side, value in drawn}


def _refused(exam: Exam, get_geometry: Service, negative: Mapping[str, float]) -> None:
    """Hold that a box is refused in words that name the first of its negative sides."""
    words = get_geometry.refused(
        "a negative side is refused",
        saying="responded with an error",
        hints={
            (
                lambda seen: isinstance(seen, dict)
            ): "It was measured like any other. Compare each side with zero, as it came: -0.5 is negative.",
        },
        **_box(exam, negative),
    )
    exam.hold(
        "the refusal is a rospy.ServiceException",
        bool(says(OWN_WORDS).search(words)),
        expected="service cannot process request: …, in words of your own",
        seen=words,
        hints={
            says(
                "error processing request"
            ): "Another exception came out of the handler. Only rospy.ServiceException "
            "reads as a refusal; any other reads as a fault.",
            says(
                "returned None"
            ): "The handler returned None, so rospy found the words. Raise rospy.ServiceException "
            "with words of your own.",
            says(
                "handler returned"
            ): "What the handler returned is no response, so rospy found the words. Do not return the "
            "refusal, raise it: raise rospy.ServiceException(...).",
        },
    )
    side, value = next(iter(negative.items()))
    reason = words.lower().partition("process request:")[2]
    named = [name for name in SIDES if name in reason]
    exam.hold(
        "the words name the side and its value",
        named == [side] and value in map(float, re.findall(r"-?\d+(?:\.\d+)?", reason)),
        expected=f"words with {side} and {value:g} in them, and no other side",
        seen=words,
        hints=_unclear(named, side),
    )


def _unclear(named: list[str], side: str) -> str:
    """Return what to do about words that name the sides in `named` where they should name `side`."""
    if not named:
        return "The client can't know which side was wrong. Name it, and say its value."
    if named != [side]:
        return "Name the first negative side, in the order length, width, height, and no other."
    return "The side is named. Say its value, too, as it came."


@part(
    "05.4",
    points=2,
    goal="A switch at /switch that goes where it is told, and says whether it moved and where it stands.",
    needs=["Switch"],
)
def a_switch_that_tells(exam: Exam) -> None:
    """Put it in a known place, then ten turns; the one at /switch may be on, so ask a new one, too."""
    turn = exam.service("/switch", "std_srvs/SetBool")
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
    turn(data=False)
    exam.prepare(A_NEW_SWITCH)
    exam.expect(
        "a new switch is off",
        expected={"success": False, "message": "off"},
        seen=exam.run("a_new_switch", Its("Switch"), False).value,
        hints="A new switch was told to go off, where it should have been already: start with False.",
    )


@part(
    "05.5",
    points=1,
    goal="Serve a Trigger under any name, and take it away again so that nobody finds it.",
    needs=["open_service", "close_service"],
)
def open_and_close(exam: Exam) -> None:
    """Open three, close the one in the middle, ask for the others, and open it once more."""
    names = [f"/{exam.draw.word()}" for _ in range(3)]
    opened = [_opened(exam, name, "Use the name that it is given, and serve it at once.") for name in names]
    first, closing, last = names
    exam.run("close_service", closing).value  # noqa: B018 -- that it returns is a rule
    exam.expect(
        "a closed service is gone, and the others stay",
        expected=[first, last],
        seen=[name for name in names if exam.look().service(name)],
        hints={
            tuple(
                names
            ): "It is still there. rospy keeps a reference of its own, so forgetting yours changes "
            "nothing. Call its shutdown().",
            (): "Everything was closed. Shut down the one service; if the node is gone, restart the kernel.",
            (
                lambda seen: closing in seen
            ): "Another one was closed. Keep each service under its name, and look it up there.",
            says(""): "Another one was closed with it. Shut down the one service.",
        },
    )
    exam.hold(
        "a closed service answers no more",
        not _answers(opened[1]),
        expected="no answer where it was served",
        seen="an answer there",
        hints="The master lists it no more, but the node still serves it. Call the service's own shutdown().",
    )
    _opened(
        exam, closing, "It was closed, and open_service() has to serve it again: is it still in `services`?"
    )


def _opened(exam: Exam, name: str, hint: str) -> ServiceSeen:
    """Have `name` opened, hold that it is there and answers, and return it."""
    exam.run("open_service", name).value  # noqa: B018 -- that it returns is a rule
    service = exam.look().service(name)
    if not service:
        exam.fail(
            "open_service() serves the name that it is given",
            expected=f"{name} on the graph",
            seen="nobody who serves it",
            hint=hint,
        )
    exam.hold("open_service() serves the name that it is given", True)
    response = exam.service(name, "std_srvs/Trigger")()
    exam.expect(
        "an open service answers True and open",
        expected=[True, "open"],
        seen=[response.success, response.message],
    )
    return service


def _answers(service: ServiceSeen) -> bool:
    """Return whether somebody serves it where it was seen; a node that lives on may say that it does not."""
    probe = service_probe(service.name, service.uri)
    ask_all([probe], 1.0)
    return "type" in header_fields(probe.answer)
