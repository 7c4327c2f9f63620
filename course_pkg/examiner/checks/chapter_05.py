"""The checks of chapter 05: the student's servers, called from outside."""

from collections.abc import Callable

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.calls import Service

SIDES = ("length", "width", "height")
MESSAGE = {
    "": "The message is empty: a field that is left out is an empty text.",
    says("True|False"): "The message is the word on or the word off.",
    says("on|off"): "The message is on or off, in small letters, and nothing else.",
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
                0.0: "The field area was never given a value: a field that is left out is 0.",
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
                0.0: "The field volume was never given a value: a field that is left out is 0.",
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
    """Reset first, since the count goes on from whatever earlier calls have left; then two rounds."""
    count = exam.service("/count", "std_srvs/Trigger")
    reset = exam.service(
        "/reset_count",
        "std_srvs/Empty",
        hints={says("returned None"): "Even an empty response has to be returned: return EmptyResponse()."},
    )
    for _ in range(2):
        reset()
        for number in range(1, exam.draw.integer(3, 6)):
            response = count()
            exam.expect(
                "success is True",
                expected=True,
                seen=response.success,
                hints={False: "success was never set to True: a field that is left out is False."},
            )
            exam.expect(
                "the message counts 1, 2, 3 from each reset",
                expected=str(number),
                seen=response.message,
                hints={
                    "": "The message is empty: a field that is left out is an empty text.",
                    "0": "One behind: add one first, and answer then.",
                    "1": "It says 1 again: keep the count in self, which outlives the call.",
                    says(r"\D"): "The message is the number as text, and nothing else.",
                    _is_above(number): "It went on from the old count: set self.count to zero in the reset.",
                },
            )


def _is_above(number: int) -> Callable[[str], bool]:
    return lambda message: int(message) > number


@part(
    "05.3",
    points=2,
    goal="Answer /getGeometryChecked as before, but refuse a negative side, and name it.",
    needs=["handle_checked_geometry"],
)
def a_box_that_cannot_be(exam: Exam) -> None:
    """Send a good box, a flat one, and then each side negative in turn."""
    get_geometry = exam.service(
        "/getGeometryChecked",
        "course_pkg/geometry",
        hints={says("process"): "This box can be. Zero is fine; less is not."},
    )
    for height in (exam.draw.number(0.5, 9.0), 0.0):
        length, width = exam.draw.numbers(2, 0.5, 9.0)
        response = get_geometry(length=length, width=width, height=height)
        exam.expect(
            "a box that can be is measured",
            expected=[width * length, width * length * height],
            seen=[response.area, response.volume],
            near=1e-3,
        )
    for side in exam.draw.shuffled(SIDES):
        _negative(exam, get_geometry, side)


def _negative(exam: Exam, get_geometry: Service, side: str) -> None:
    sides = dict(zip(SIDES, exam.draw.numbers(3, 0.5, 9.0), strict=True))
    sides[side] = -float(exam.draw.integer(2, 9))
    words = get_geometry.refused(
        "a negative side is refused",
        saying="responded with an error",
        hints={
            says("area"): "It was measured like any other. Look at each side before you multiply.",
        },
        **sides,
    )
    exam.hold(
        "the refusal is a rospy.ServiceException",
        "cannot process request" in words,
        expected="service cannot process request: …",
        seen=words,
        hints={
            says(
                "error processing request"
            ): "Another exception came out of the handler. Only rospy.ServiceException "
            "reads as a refusal; any other reads as a fault.",
        },
    )
    exam.hold(
        "the words name the side and its value",
        side in words and f"{sides[side]:g}" in words,
        expected=f"words with {side} and {sides[side]:g} in them",
        seen=words,
        hints={
            says(
                "returned None"
            ): "The handler returned None, so rospy found the words. Raise rospy.ServiceException "
            "with words of your own.",
            says("|".join(SIDES)): "Name the side that is negative, and say its value.",
            says(""): "The client can't know which side was wrong. Name it, and say its value.",
        },
    )


@part(
    "05.4",
    points=2,
    goal="A switch at /switch that goes where it is told, and says whether it moved and where it stands.",
    needs=["Switch"],
)
def a_switch_that_tells(exam: Exam) -> None:
    """Put it in a known place, then ten random turns."""
    turn = exam.service("/switch", "std_srvs/SetBool")
    turn(data=False)
    exam.expect(
        "data=False means off",
        expected="off",
        seen=turn(data=False).message,
        hints={"on": "That is the other way round: data=True means on.", **MESSAGE},
    )
    on = False
    for data in [True, True, False, False, *(exam.draw.choice([True, False]) for _ in range(6))]:
        response = turn(data=data)
        exam.expect(
            "the message says where it stands now",
            expected="on" if data else "off",
            seen=response.message,
            hints={
                "on" if on else "off": "That is where it stood before. Turn it first, and answer then.",
                **MESSAGE,
            },
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


@part(
    "05.5",
    points=1,
    goal="Serve a Trigger under any name, and take it away again so that nobody finds it.",
    needs=["open_service", "close_service"],
)
def open_and_close(exam: Exam) -> None:
    """Open two, close one, and see that the other one and the node are still there; open it once more."""
    closing, staying = (f"/{exam.draw.word()}" for _ in range(2))
    for name in (closing, staying):
        exam.run("open_service", name).value  # noqa: B018 -- that it returns is a rule
        _is_open(exam, name)
    exam.run("close_service", closing).value  # noqa: B018
    served = [name for name in (closing, staying) if _is_served(exam, name)]
    exam.expect(
        "a closed service is gone, and the others stay",
        expected=[staying],
        seen=served,
        hints={
            (closing, staying): "rospy keeps a reference of its own, so forgetting yours changes nothing. "
            "Call its shutdown().",
            (closing,): "The other one was closed. Keep each service under its name, and look it up there.",
            (): "Everything was closed. Shut down the one service; if the node is gone, restart the kernel.",
        },
    )
    exam.run("open_service", closing).value  # noqa: B018
    _is_open(exam, closing)


def _is_served(exam: Exam, name: str) -> bool:
    return any(service.name == name for service in exam.look().services)


def _is_open(exam: Exam, name: str) -> None:
    exam.hold(
        "open_service() serves the name that it is given",
        _is_served(exam, name),
        expected=f"{name} on the graph",
        seen="nobody who serves it",
        hints="Use the name that it is given, and serve it before you return.",
    )
    response = exam.service(name, "std_srvs/Trigger")()
    exam.expect(
        "an open service answers True and open",
        expected=[True, "open"],
        seen=[response.success, response.message],
    )
