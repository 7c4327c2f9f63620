"""A driver that is steered by services: how often it speaks, how fast it goes, whether it moves."""

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.calls import Service
from course_pkg.examiner.checks.chapter_08.streams import STANDING, STRAIGHT, TURNING, Stream, kind
from course_pkg.examiner.hearing import rate

NEAR = 0.25  # of a rate that counts as kept: the machine may be busy
OWN_WORDS = says("cannot process request: (?!(service )?handler returned)")
ALLOWED = "It was refused, and is allowed: above 0 and at most 100, fractions and 100 itself included."
ANY_SPEED = "It was refused, and is allowed: every finite number is a speed, and a negative one is backwards."
SO_FAR = "the response tells the speed so far"
A_NEW_ONE = """
from course_pkg.srv import ChangeSpeedRequest, ChangeSpeedResponse
from rospy.impl.tcpros_service import convert_return_to_response

begins = []


def a_new_one(kind):
    response = kind(rate=20.0).handle_speed(ChangeSpeedRequest(speed=2.0))
    begins[:] = [convert_return_to_response(response, ChangeSpeedResponse).before]
"""  # the one that drives may have been told another speed before
OWN_WORD = (
    "The client was told of a fault in the server (error processing request). Refuse on purpose: raise "
    "rospy.ServiceException."
)


@part(
    "08.3",
    points=2,
    goal="Have /change_rate set how often the driver speaks, tell the rate so far, and refuse nonsense.",
    needs=["Plus"],
    deadline=30.0,
)
def change_the_rate(exam: Exam) -> None:
    """Ask for two rates and listen; then for what is no rate."""
    change = exam.service("/change_rate", "course_pkg/ChangeRate", hints={OWN_WORDS: ALLOWED})
    stream = Stream(exam)
    fast, slow = exam.draw.number(20.0, 40.0), exam.draw.number(4.0, 8.0)
    change(rate=fast)
    for wanted, before in ((slow, fast), (fast, slow)):
        response = change(rate=wanted)
        exam.expect(
            "the response tells the rate so far",
            expected=before,
            seen=response.before,
            hints={
                float(int(before)): "The fraction is lost. A rate may be 2.5 as well.",
                0.0: "It is 0. Keep the old rate in a variable before you set the new one, and return it.",
                wanted: "That is the new rate. Keep the old one before you set it.",
                1.0 / before: "That is a period, in seconds. The rate is how often in a second.",
            },
        )
        heard = rate(stream.next(int(wanted) + 2)[1:])
        exam.hold(
            "it speaks as often as it was told",
            abs(heard - wanted) < NEAR * wanted,
            expected=f"{wanted:g} messages a second",
            seen=f"{heard:.1f} a second",
            hints="The drive reads `rate` of the driver: self.rate, in messages a second.",
        )
    for allowed in (100.0, 0.5, fast):
        change(rate=allowed)
    for nonsense in (0.0, -slow, 100.5, 1e6, float("nan")):
        _refuses(change, "what is no rate is refused", rate=nonsense)
    exam.expect(
        "after a refusal all is as before",
        expected=fast,
        seen=change(rate=fast).before,
        hints="The refused rate was set all the same. Look at it first, then set it.",
    )


@part(
    "08.4",
    points=2,
    goal="Have /change_speed set how fast the driver goes straight on.",
    needs=["Faster"],
    deadline=30.0,
)
def change_the_speed(exam: Exam) -> None:
    """Ask for speeds, look at what is published going and turning, and ask for what is no speed."""
    change = exam.service("/change_speed", "course_pkg/ChangeSpeed", hints={OWN_WORDS: ANY_SPEED})
    toggle = exam.service("/toggle_forward", "std_srvs/Empty")
    stream = Stream(exam)
    if kind(stream.now()) == TURNING:
        toggle()
    first, second = exam.draw.number(2.0, 4.0), -exam.draw.number(5.0, 9.0)
    change(speed=first)
    for wanted, before in ((second, first), (first, second)):
        response = change(speed=wanted)
        exam.expect(
            SO_FAR,
            expected=before,
            seen=response.before,
            near=1e-6,
            hints={
                0.0: "It is 0. Keep the old speed in a variable before you set the new one, and return it.",
                wanted: "That is the new speed. Keep the old one before you set it.",
                abs(before): "It was negative: backwards. Keep it as it came.",
                says(""): "It is the speed that was sent last: not more, and nothing added to it.",
            },
        )
        exam.expect(
            "straight on it goes at that speed",
            expected=(wanted, 0.0),
            seen=stream.now(),
            near=1e-6,
            hints={
                (1.0, 0.0): "It goes at 1.0 still. velocity() has to return self.speed.",
                (abs(wanted), 0.0): "A negative speed is one backwards. Pass it on as it is.",
                (float(int(wanted)), 0.0): "The fraction is lost. A speed is a float.",
                (wanted, wanted): "The turn is no speed. Straight on it is 0.0.",
            },
        )
    toggle()
    exam.expect(
        "turning it turns as before",
        expected=(0.0, 1.0),
        seen=stream.now(),
        hints={
            (0.0, first): "The turn has changed with the speed. Only the way straight on is faster.",
            (first, 0.0): "It goes straight on still. Ask self.forward which of the two it is.",
            says(""): "Turning, it stands on the spot: (0.0, 1.0).",
        },
    )
    for nonsense in (float("nan"), float("inf"), -float("inf")):
        _refuses(change, "what is no speed is refused", speed=nonsense)
    exam.expect(
        SO_FAR,
        expected=first,
        seen=change(speed=second).before,
        near=1e-6,
        hints="The refused speed was set all the same. Look at it first, then set it.",
    )
    exam.prepare(A_NEW_ONE)
    exam.run("a_new_one", Its("Faster"), worded="handle_speed() of a new Faster(rate=20.0)")
    begins = exam.read("begins")
    exam.hold(
        SO_FAR,
        begins in ([], [1.0]),  # none where it takes other arguments to make one
        expected="1.0 from a new one",
        seen=begins,
        hints="A new one goes at 1.0.",
    )


@part(
    "08.5",
    points=2,
    goal="Have /start_stop move or stop the turtle, and say whether it did already.",
    needs=["Stoppable"],
    deadline=30.0,
)
def start_and_stop(exam: Exam) -> None:
    """Stop, stop again, start, start again; then see that it goes on as it went before."""
    switch = exam.service(
        "/start_stop",
        "std_srvs/SetBool",
        hints={
            OWN_WORDS: "Asked for what is so already, it does not refuse: success=True, and says already."
        },
    )
    toggle = exam.service("/toggle_forward", "std_srvs/Empty")
    stream = Stream(exam)
    switch(data=True)
    for wanted in (STRAIGHT, TURNING):
        if kind(stream.now()) != wanted:
            toggle()
        for moving in (False, True):
            _switches(exam, switch, moving)
            seen = kind(stream.now())
            exam.hold(
                "False stops it, and velocities of 0 are published" if not moving else "True lets it go on",
                seen == (wanted if moving else STANDING),
                expected=wanted if moving else STANDING,
                seen=seen,
                hints=_what_went_wrong(moving, seen, wanted),
            )


def _switches(exam: Exam, switch: Service, moving: bool) -> None:
    """Ask twice for the same."""
    for again in (False, True):
        response = switch(data=moving)
        exam.expect(
            "success is True, also when nothing had to be done",
            expected=True,
            seen=response.success,
            hints="Asked for what is so already, the answer is yes: success=True.",
        )
        exam.hold(
            "the message says already where it was so already, and only there",
            ("already" in response.message.lower()) == again and response.message.strip() != "",
            expected="a message with the word already" if again else "a message without it",
            seen=response.message,
            hints={
                "": "The message is empty. Say what was done, or that it was so already.",
                says("already"): "It had just been changed. Compare before you set.",
                says(""): "It was so already: say so. Compare what is asked with what is before you set it.",
            },
        )


def _what_went_wrong(moving: bool, seen: str, wanted: str) -> str:
    if not moving:
        return "It goes on. velocity() has to return (0.0, 0.0) while the turtle is stopped."
    if seen == STANDING:
        return "It stands still. Keep whether it moves in a variable of its own, and set it to request.data."
    return f"It was {wanted} when it was stopped. Stopping leaves self.forward alone."


def _refuses(service: Service, rule: str, **fields: float) -> None:
    (number,) = fields.values()
    why = "nan is neither above nor below anything" if number != number else f"{number:g} is not allowed"
    service.refused(
        rule,
        saying="cannot process request",
        hints={
            says("^ServiceException.*error processing"): OWN_WORD,
            says(""): f"It was accepted. Look at the number first: {why}.",
        },
        **fields,
    )
