"""A turtle from a simulator that may come late, or never."""

from threading import Timer

from course_pkg.examiner import Exam, Refuse, part, says
from course_pkg.examiner.outcome import Outcome

SPAWN = "turtlesim/Spawn"
LONGEST = 1.9  # s for a patience of 0.5; a busy machine may need more once, and not twice
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."
TOO_LONG = "It waited longer than `patience` says. Give wait_for_service the limit: timeout=patience."


@part(
    "08.1",
    points=2,
    goal="Return the name of a new turtle, or None where there is no simulator or it refuses.",
    needs=["spawn_turtle"],
    deadline=25.0,
)
def wait_and_spawn(exam: Exam) -> None:
    """Be the simulator: one that gives names of its own, one that refuses, none, and one that comes late."""
    x, y, theta = exam.draw.numbers(3, 0.5, 9.0)
    wish, given = exam.draw.word(), exam.draw.word()
    with_names = exam.serve("/spawn", SPAWN, lambda _: {"name": given})
    returned = exam.run("spawn_turtle", x, y, theta, wish, 0.5).value
    exam.hold(
        "/spawn is called once",
        len(with_names.requests) == 1,
        expected="one call",
        seen=f"{len(with_names.requests)} calls",
        hints={
            says("^0"): "Nobody was asked. Call /spawn.",
            says(""): "Each call makes a turtle: call once.",
        },
    )
    exam.expect(
        "the request holds x, y, theta and the name",
        expected={"x": x, "y": y, "theta": theta, "name": wish},
        seen=with_names.requests[0],
        near=1e-4,
        hints={
            (lambda seen: seen["name"] == ""): "Without a name the simulator chooses one. Send `name`.",
            (
                lambda seen: seen["name"] != wish
            ): "The name is another than `name`. Send the one that is given.",
            (lambda seen: seen["theta"] == 0.0): "The turtle would look to the right. Send `theta`.",
            says(""): "Compare the order of your arguments with rossrv show turtlesim/Spawn.",
        },
    )
    exam.expect(
        "the name of the response is returned",
        expected=given,
        seen=returned,
        hints={
            None: NO_RETURN,
            wish: "That is the name that was wished for. The simulator says which one it gave.",
            (lambda seen: "name" in seen): "That is the whole response. Return its name.",
        },
    )
    with_names.leave()
    _refused(exam, x, y)
    _nobody(exam, x, y)
    Timer(1.3, exam.serve, ["/spawn", SPAWN, lambda _: {"name": given}]).start()
    exam.expect(
        "a simulator that comes in time is waited for",
        expected=given,
        seen=exam.run("spawn_turtle", x, y, theta, "", 4.0, within=8.0).value,
        hints={None: "It came after 1.3 s, and there were 4. Wait for as long as `patience` says."},
    )


def _refused(exam: Exam, x: float, y: float) -> None:
    server = exam.serve("/spawn", SPAWN, lambda _: Refuse(""))
    outcome = exam.run(
        "spawn_turtle",
        x,
        y,
        0.0,
        exam.draw.word(),
        0.5,
        hints={says("^ServiceException"): "A refusal raises rospy.ServiceException. Catch it, return None."},
    )
    exam.expect(
        "None where the simulator refuses",
        expected=None,
        seen=outcome.value,
        hints="The simulator made no turtle, so there is no name to return. Return None.",
    )
    server.leave()


def _nobody(exam: Exam, x: float, y: float) -> None:
    exam.absent("/spawn")
    outcome = _in_vain(exam, x, y)
    exam.expect("None where there is no simulator", expected=None, seen=outcome.value, hints="Return None.")
    exam.hold(
        "it waits no longer than it is told to",
        outcome.took < LONGEST or _in_vain(exam, x, y).took < LONGEST,
        expected="an end after 0.5 s or little more",
        seen=f"an end after {outcome.took:.1f} s",
        hints=TOO_LONG,
    )


def _in_vain(exam: Exam, x: float, y: float) -> Outcome:
    return exam.run(
        "spawn_turtle",
        x,
        y,
        0.0,
        exam.draw.word(),
        0.5,
        within=3.0,
        hints={
            says("TimesUp"): TOO_LONG,
            says("^ROSException"): "wait_for_service raises rospy.ROSException when the time is up. "
            "Catch that one, too.",
            says("unavailable"): "Wait for the service first: it may come within `patience` seconds.",
        },
    )
