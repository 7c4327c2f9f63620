"""Two turtles that go alike."""

from collections.abc import Callable
from threading import Timer

from course_pkg.examiner import Exam, Refuse, part, says
from course_pkg.examiner.checks.chapter_08.spawning import LONGEST
from course_pkg.examiner.ledger import first_unlike
from course_pkg.examiner.plain import Plain
from course_pkg.examiner.scripted import Script

TWIST = "geometry_msgs/Twist"
ORDER = ["/spawn", "/toggle_forward", "/change_speed"]
IN_ORDER = "spawn, toggle and speed are asked once each, in this order"
NO_RETURN = "None was returned, as by a function that comes to its end without a return line."


@part(
    "08.6",
    points=2,
    goal="Have one turtle obey everything that another one is told.",
    needs=["follow"],
    deadline=25.0,
)
def go_alike(exam: Exam) -> None:
    """Tell a leader of the check's own this and that, and hear what the follower is told."""
    leader, follower = exam.draw.word(), exam.draw.word()
    orders = [_order(*exam.draw.numbers(3, -5.0, 5.0)) for _ in range(20)]
    orders[5] = orders[4]
    hearing = exam.hear(f"/{follower}/cmd_vel", TWIST)
    too_long = {says("TimesUp"): "It never came back. Let a callback do it."}
    _ = exam.run("follow", leader, follower, hints=too_long).value  # that it returns at all is a rule
    hearing.published(
        hints={says("nobody"): "Nobody speaks to the follower. Advertise /FOLLOWER/cmd_vel, with its name."}
    )
    speaking = exam.publish(f"/{leader}/cmd_vel", TWIST, orders, every=0.03, once=True)
    exam.hold(
        "the leader is listened to",
        speaking.heard(5.0),
        expected="a subscriber of the leader's cmd_vel",
        seen="nobody who listens",
        hints="Subscribe to what the leader is told: /LEADER/cmd_vel, with its name.",
    )
    speaking.finish(5.0)
    hearing.wait(len(orders), 3.0)
    seen = [arrival.fields for arrival in hearing.arrivals]
    exam.expect("every order is passed on, once", expected=len(orders), seen=len(seen), hints=_count_hints())
    order, other = first_unlike(orders, seen, near=1e-9)
    exam.expect(
        "each as it was, in order",
        expected=order,
        seen=other,
        near=1e-9,
        hints={
            (lambda one: not one["angular"]["z"]): "The turn is missing: pass the whole message on.",
            (
                lambda one: not one["linear"]["y"]
            ): "A part of the message is missing: pass the whole message on.",
            (lambda one: one in orders): "They come in another order. Pass each on at once, in the callback.",
            says(""): "Pass each message on as it came.",
        },
    )
    late = max(arrival.at - sent for arrival, sent in zip(hearing.arrivals, speaking.sent, strict=True))
    exam.hold(
        "at once",
        late < 0.5,
        expected="each order within half a second",
        seen=f"one {late:.1f} s late",
        hints="Pass it on in the callback; a loop with a pause of its own comes late.",
    )


def _count_hints() -> dict[object, str]:
    return {
        0: "Nothing came. The publisher has to be there before the first order: make it in follow(), not in "
        "the callback.",
        (lambda count: count > 20): "Some came twice. One subscription is enough, and the follower's topic "
        "is not the leader's.",
        (lambda count: count < 20): "Some are missing. Pass on every message, also one like the one before.",
    }


def _order(forward: float, sideways: float, turn: float) -> dict[str, Plain]:
    linear: dict[str, Plain] = {"x": forward, "y": sideways, "z": 0.0}
    angular: dict[str, Plain] = {"x": 0.0, "y": 0.0, "z": turn}
    return {"linear": linear, "angular": angular}


@part(
    "08.7",
    points=2,
    goal="Make a turtle, have the driver change over, set its speed: in this order, as far as it goes.",
    needs=["bring_turtle"],
    deadline=30.0,
)
def bring_a_second_turtle(exam: Exam) -> None:
    """Be simulator and driver, and note who is asked what in which order; then be less of both."""
    asked: list[str] = []

    def noted(name: str, answer: dict[str, Plain] | Refuse) -> Script:
        def note(_: object) -> dict[str, Plain] | Refuse:
            asked.append(name)
            return answer

        return note

    given, wish = exam.draw.word(), exam.draw.word()
    x, y = exam.draw.numbers(2, 1.0, 9.0)
    speed = exam.draw.number(2.0, 9.0)
    answers: dict[str, tuple[str, dict[str, Plain]]] = {
        "/spawn": ("turtlesim/Spawn", {"name": given}),
        "/toggle_forward": ("std_srvs/Empty", {}),
        "/change_speed": ("course_pkg/ChangeSpeed", {"before": 1.0}),
    }
    servers = {name: exam.serve(name, kind, noted(name, answer)) for name, (kind, answer) in answers.items()}
    returned = exam.run("bring_turtle", wish, x, y, speed, 0.5).value
    exam.expect(
        IN_ORDER,
        expected=ORDER,
        seen=asked,
        hints={
            (lambda seen: sorted(seen) == sorted(ORDER)): "All three, in another order: a turtle first.",
            (lambda seen: len(seen) > len(ORDER)): "Something was asked twice. Once is enough.",
            says(""): "Not all three were asked.",
        },
    )
    exam.expect(
        "the turtle is asked for with its name and place",
        expected={"x": x, "y": y, "theta": 0.0, "name": wish},
        seen=servers["/spawn"].requests[0],
        near=1e-4,
        hints={
            (lambda seen: seen["theta"] != 0.0): "It looks to the right: a theta of 0.",
            says(""): "Send x, y, a theta of 0 and the name.",
        },
    )
    exam.expect(
        "the speed is the one that was given",
        expected={"speed": speed},
        seen=servers["/change_speed"].requests[0],
        near=1e-9,
        hints={"{'speed': 10.0}": "That is 10 always. Send `speed`.", says(""): "Send `speed` as it came."},
    )
    exam.expect(
        "the name of the new turtle is returned",
        expected=given,
        seen=returned,
        hints={
            None: NO_RETURN,
            True: "That says that it worked. Return the name of the turtle.",
            wish: "That is the name that was wished for. The simulator says which one it gave.",
        },
    )

    def replace(name: str, answer: dict[str, Plain] | Refuse) -> None:
        servers[name] = exam.serve(name, answers[name][0], noted(name, answer))

    servers["/toggle_forward"].leave()
    exam.absent("/toggle_forward")
    _waits(exam, asked, lambda: replace("/toggle_forward", {}), wish, x, y, speed)
    for missing, until in (("/toggle_forward", ["/spawn"]), ("/change_speed", ["/spawn", "/toggle_forward"])):
        servers[missing].leave()
        exam.absent(missing)
        _fails(exam, asked, "None where there is no driver", until, wish, x, y, speed)
        replace(missing, answers[missing][1])
    for refusing in ("/toggle_forward", "/change_speed"):
        servers[refusing].leave()
        replace(refusing, Refuse("not now"))
        _refused(exam, asked, refusing, wish, x, y, speed)
        servers[refusing].leave()
        replace(refusing, answers[refusing][1])
    servers["/spawn"].leave()
    replace("/spawn", Refuse(""))
    _fails(exam, asked, "None where the simulator refuses", ["/spawn"], wish, x, y, speed)


def _waits(exam: Exam, asked: list[str], late: Callable[[], object], *values: Plain) -> None:
    """Have the driver come late, and hold that it is waited for."""
    asked.clear()
    Timer(0.8, late).start()
    exam.run("bring_turtle", *values, 4.0, within=8.0, hints=_SLIPS).value  # noqa: B018 -- a rule
    exam.expect(
        IN_ORDER,
        expected=ORDER,
        seen=asked,
        hints="The driver came after 0.8 s, and there were 4. Wait for each of the three before you ask it.",
    )


def _fails(exam: Exam, asked: list[str], rule: str, until: list[str], *values: Plain) -> None:
    """Hold that it returns None in time, and asks nobody after the first that fails."""
    asked.clear()
    outcome = exam.run("bring_turtle", *values, 0.5, within=5.0, hints=_SLIPS)
    exam.expect(rule, expected=None, seen=outcome.value, hints="Not all three have answered: return None.")
    exam.hold(
        "nobody is asked after the first that fails",
        asked == until[: len(asked)],  # fewer, where it looks first whether all are there
        expected=", ".join(until),
        seen=", ".join(asked),
        hints="One had failed, and the next was asked all the same. Let one try hold all three calls.",
    )
    if outcome.took > LONGEST and exam.run("bring_turtle", *values, 0.5, within=5.0).took > LONGEST:
        exam.fail(
            "it waits no longer than it is told to",
            expected="an end after 0.5 s or little more",
            seen=f"an end after {outcome.took:.1f} s",
            hint="Give each wait_for_service the limit that was given: timeout=patience.",
        )


def _refused(exam: Exam, asked: list[str], by: str, *values: Plain) -> None:
    """Hold that a refusal of the driver's is no error; it is a rule only where it does not hold."""
    asked.clear()
    outcome = exam.run("bring_turtle", *values, 0.5, within=5.0)
    returned = outcome.error or outcome.value
    if returned is not None or asked[-1:] != [by]:
        exam.fail(
            "None where the driver refuses",
            expected=f"None, and no question after {by}",
            seen=f"{returned}, and questions to {', '.join(asked)}",
            hint="Each of the three may refuse: rospy.ServiceException. Let one try hold all three calls.",
        )


_SLIPS = {
    says("TimesUp"): "It waited for ever. Give wait_for_service the limit: timeout=patience.",
    says("^ROSException"): "wait_for_service raises rospy.ROSException. Catch it, return None.",
    says("^ServiceException"): "A call that fails raises rospy.ServiceException. Catch it, return None.",
}
