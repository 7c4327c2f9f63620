"""The checks of chapter 00: read the graph, call a service, receive from a topic."""

from collections.abc import Sequence
from math import prod

from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.assertions import Hints, same
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.publisher import Publisher
from course_pkg.checking.plain_values import of_kind
from course_pkg.checking.shared.geometry import boxes
from course_pkg.ros.protocol.json_channel import Json

NOT_RECEIVED = [
    (
        matches("^ROSException.*timeout|^TimesUp"),
        "No message arrived, although a node publishes more than 20 messages per second on the "
        "topic. Receive messages of the type UInt32 from the topic whose name is in the argument "
        "`topic`.",
    )
]
NODE, SERVICE, TYPE = (
    "Find the name of the node.",
    "Find the name of the service.",
    "Find the type of the service.",
)
TOO_LONG = (
    "The pause is too long. Pause for the time in the argument `pause`, and receive only one number "
    "after the pause."
)
RECEIVED = "Return two numbers from the topic: one number before the pause, and one number after the pause."
MISSED = "Return how many numbers were published between the two received numbers."


@part(
    "00.1",
    points=1,
    goal=(
        "Find the node that measures boxes, the service that this node offers, and the type of this service."
    ),
    needs=["name_of_node", "name_of_service", "name_of_type"],
    goals=[NODE, SERVICE, TYPE],
    runs=["server"],
)
def read_the_graph(context: CheckContext) -> None:
    """Compare the right names of the node, the service and the type with the names that the student found."""
    with context.goal(NODE):
        context.expect(
            "the name of the node is right",
            expected="/SERVER_NODE",
            actual=context.read("name_of_node"),
            hints=[
                (
                    "SERVER_NODE",
                    (
                        "Your answer is almost right, but every name on the graph starts with a slash. "
                        "Add the slash."
                    ),
                ),
                (
                    matches("^/?server$"),
                    (
                        "Your answer is the name of the program. The command `rosnode list` shows "
                        "the names of the nodes."
                    ),
                ),
                (
                    matches("^/chapter"),
                    (
                        "Your answer is the node of this notebook, which is the client. Find the "
                        "node of the server."
                    ),
                ),
                (
                    matches("getGeometry"),
                    "Your answer is the name of a service. Find the node that offers this service.",
                ),
                (
                    matches("^/server_node/?$"),
                    "Compare your answer with the name on the graph, letter by letter. Check the "
                    "capital letters, and write only one slash, at the start of the name.",
                ),
                (
                    ANYTHING,
                    "Your answer is not the name of the server's node. Look for this name in the output "
                    "of `rosnode list`.",
                ),
            ],
        )
    with context.goal(SERVICE):
        context.expect(
            "the name of the service is right",
            expected="/getGeometry",
            actual=context.read("name_of_service"),
            hints=[
                (
                    "getGeometry",
                    (
                        "Your answer is almost right, but every name on the graph starts with a slash. "
                        "Add the slash."
                    ),
                ),
                (
                    matches("logger"),
                    (
                        "Every node offers a service for log messages, such as the one in your "
                        "answer. Find the service that measures boxes."
                    ),
                ),
                (
                    matches("^/?SERVER_NODE$"),
                    (
                        "Your answer is the name of the node. The command `rosservice list` shows "
                        "the names of the services."
                    ),
                ),
                (
                    matches("course_pkg"),
                    "Your answer is the type of the service. The name of the service is the "
                    "text that you write after `rosservice call`.",
                ),
                (
                    matches("^/getgeometry/?$"),
                    "Compare your answer with the name on the graph, letter by letter. Check the "
                    "capital letters, and write only one slash, at the start of the name.",
                ),
                (
                    ANYTHING,
                    "Your answer is not the name of the service that measures boxes. Look for this name in "
                    "the output of `rosservice list`.",
                ),
            ],
        )
    with context.goal(TYPE):
        context.expect(
            "the type of the service is right",
            expected="course_pkg/geometry",
            actual=context.read("name_of_type"),
            hints=[
                (
                    matches("^geometry$"),
                    "The name of the package is missing. Write the type in the form package/type.",
                ),
                (
                    matches("^/course_pkg"),
                    "The name of a type does not start with a slash. Remove the slash.",
                ),
                (
                    matches(r"object|course_pkg\.srv"),
                    "Your answer is the Python class of the type. Write the name of the type "
                    "as a string in the form package/type.",
                ),
                (
                    matches("getGeometry"),
                    (
                        "Your answer is the name of the service. The command `rosservice type` "
                        "shows the type of a service."
                    ),
                ),
                (
                    matches("(?-i:course_pkg/Geometry)"),
                    ("The name of this type starts with a small letter. Write `geometry` with a small g."),
                ),
                (
                    ANYTHING,
                    "Your answer is not the type of the service that measures boxes. Write the "
                    "name of this service after `rosservice type`.",
                ),
            ],
        )


@part(
    "00.2",
    points=2,
    goal="Return the volume from the response of a service.",
    needs=["ask_for_volume"],
    runs=["server"],
)
def ask_a_question(context: CheckContext) -> None:
    """Respond with random volumes; the student's function can know a volume only from the response.

    The second request contains the same sides as the first request, but its response contains a new volume.
    """
    for _ in range(2):
        name = f"/{context.random.word()}"
        response: dict[str, float] = {}
        server = context.serve(name, "course_pkg/geometry", lambda _, response=response: response)
        first, *others = boxes(context, context.random.integer(2, 4))
        for number, sides in enumerate([first, first, *others]):
            area, volume = (
                whole + 0.375 for whole in context.random.integers(2, 1000, 9000)
            )  # A float32 stores the area and the volume exactly.
            response.update(area=area, volume=volume)
            before = len(server.requests)
            returned = context.run("ask_for_volume", name, *sides).returned()
            requests = server.requests[before:]
            context.require(
                "the given service is called",
                holds=bool(requests),
                expected=f"a call of {name}",
                actual="no call",
                hints=(
                    "The check called ask_for_volume() twice with the same sides, but the second "
                    "time, your function did not call the service. Call the service each time your "
                    "function runs."
                )
                if number == 1
                else (
                    "Your function did not call the given service. Pass the argument `service` "
                    "to rospy.ServiceProxy."
                ),
            )
            named = dict(zip(("length", "width", "height"), sides, strict=True))
            for request in requests:
                context.expect(
                    "the sides are sent in the order length, width, height",
                    expected=named,
                    actual=request,
                    near=1e-4,
                    hints=_other_sides(named),
                )
            context.expect(
                "the volume of the response is returned",
                expected=volume,
                actual=returned,
                near=1e-6,
                hints=_no_volume(area, volume, sides),
            )


def _other_sides(sides: dict[str, float]) -> Hints:
    """Return hints for a request with wrong values; the dict `sides` contains the right values."""
    return [
        (
            lambda actual: 0.0 in actual.values(),
            (
                "One side in the request is 0, because ROS sends 0 for a number that you do not set. "
                "Set all three sides."
            ),
        ),
        (
            lambda actual: not same([*sorted(sides.values())], sorted(actual.values()), near=1e-4),
            (
                "The numbers in the request differ from the arguments of your function. Send the arguments "
                "unchanged."
            ),
        ),
        (
            ANYTHING,
            "The order of the sides in the request is wrong. Compare this order with "
            "the output of `rossrv show course_pkg/geometry`.",
        ),
    ]


def _no_volume(area: float, volume: float, sides: Sequence[float]) -> Hints:
    """Return hints for a returned value that is not `volume`, the volume in the response."""
    return [
        (None, NO_RETURN),
        (area, "Your function returned the area. Return the volume."),
        (
            area * sides[2],
            (
                "Your function multiplied the area in the response by the height. Return the field `volume` "
                "of the response."
            ),
        ),
        (
            prod(sides),
            (
                "Your function multiplied the sides, but the server of this check returns a "
                "different volume. Return the volume from the response of the server."
            ),
        ),
        (
            int(volume),
            (
                "Your function returned the volume without the digits after the decimal point. Do not "
                "round the volume."
            ),
        ),
        (
            lambda actual: "volume" in actual,
            ("Your function returned the whole response. Return only the field `volume` of the response."),
        ),
        (
            lambda actual: volume in actual,
            "Your function returned more than the volume. Return only the volume.",
        ),
        (
            lambda actual: str(volume) in actual,
            "Your function returned the volume as a string. Return the volume as a number.",
        ),
        (ANYTHING, "Return the volume from the response without any change."),
    ]


@part(
    "00.3",
    points=2,
    goal=(
        "Return three numbers: a number from the topic, a later number, and how many numbers were "
        "published between these two."
    ),
    needs=["count_missed"],
    deadline=25.0,
    goals=[RECEIVED, MISSED],
    runs=["server"],
)
def count_what_was_missed(context: CheckContext) -> None:
    """Run the student's function twice: first with a short pause, and then with a long pause.

    In each run, the check publishes consecutive numbers on a new topic.
    """
    # The second pause is longer than 2 s: a function that always sleeps for 2 s, as in the chapter, fails.
    for shortest in (0.25, 2.2):
        topic = f"/{context.random.word()}"
        first = context.random.integer(1000, 9000)
        numbers = [{"data": first + step} for step in range(1000)]
        every = context.random.number(0.02, 0.045, digits=3)
        publisher = context.publish(topic, "std_msgs/UInt32", numbers, every=every)
        pause = context.random.number(shortest, shortest + 0.15)
        done = context.run("count_missed", topic, pause, within=4.0 + pause, hints=_no_numbers(publisher))
        before, after, missed = _three_numbers(context, done.returned())
        sent = publisher.sent
        context.require(
            "the first two numbers were published on the topic",
            holds=all(0 <= number - first < len(sent) for number in (before, after)),
            expected=f"numbers such as {first + 5}",
            actual=[before, after],
            hints=(
                "The numbers that your function returned were not published on the given "
                "topic. Receive messages from the topic whose name is in the argument `topic`."
            )
            if not 0 <= before - first < len(sent)
            else (
                "The second number was not published. Do not calculate this number: receive a message "
                "after the pause, and return the number in this message."
            ),
        )
        between = sent[after - first] - sent[before - first]
        context.require(
            "the second number is received after the pause",
            holds=before < after and between > pause - 0.1,
            expected=f"{pause} s between the two numbers",
            actual=f"{before}, and then {after}" if before > after else f"{between:.2f} s",
            hints=(
                "The order of the two numbers is wrong. The first number has to be the number before "
                "the pause, and the second number has to be the number after the pause."
            )
            if before > after
            else (
                "The time between the two numbers is too short. After you receive the first number, "
                "use `time.sleep` to pause for the time in the argument `pause`."
            ),
        )
        # A subscriber receives a number only if it is connected to the publisher. The subscriber may connect
        # just after the publisher has counted its subscribers, so accept a number if the publisher counted a
        # subscriber for this number or for the next number.
        subscribers = publisher.subscribers
        for place in (before - first, after - first):
            if not any(subscribers[place : place + 2]):
                context.fail(
                    "the first two numbers were published on the topic",
                    expected="two numbers that your function received from the topic",
                    actual=f"{first + place}, a number that was published while the topic had no subscriber",
                    hint=(
                        "Your function returned a number that it did not receive. Receive one number before "
                        "the pause and one number after the pause, and return these two numbers."
                    ),
                )
        unheard = subscribers[before - first : after - first].count(0)
        # On a busy machine, the publisher may count a subscriber for some time after the subscriber has
        # unsubscribed.
        if unheard < (1 if shortest < 1 else (after - before) / 2):
            context.fail(
                "the second number is received after the pause",
                expected="no subscriber during the pause",
                actual="a subscriber that received numbers during the pause",
                hint=(
                    "Your function received numbers during the pause. Use "
                    "rospy.wait_for_message: this function unsubscribes after one message."
                ),
            )
        with context.goal(MISSED):
            context.expect(
                "the third number is the count of missed numbers",
                expected=after - before - 1,
                actual=missed,
                hints=[
                    (
                        after - before,
                        "Your count includes one of the two numbers that you received. For example, "
                        "if you receive 17 and 25, you miss 7 numbers.",
                    ),
                    (
                        after - before + 1,
                        "Your count includes both numbers that you received. For example, if you "
                        "receive 17 and 25, you miss 7 numbers.",
                    ),
                    (
                        before - after + 1,
                        "Your count is negative. Subtract the first number from the second number.",
                    ),
                    (
                        ANYTHING,
                        "Calculate the third number from the first two numbers. For example, if you "
                        "receive 17 and 25, you miss 7 numbers.",
                    ),
                ],
            )
    context.fulfilled(RECEIVED)


def _no_numbers(publisher: Publisher) -> Hints:
    """Return hints for a student's function that takes too long or raises a timeout error."""
    return [
        (lambda actual: "TimesUp" in actual and any(publisher.subscribers), TOO_LONG),
        *NOT_RECEIVED,
    ]


def _three_numbers(context: CheckContext, returned: Json) -> tuple[int, int, int]:
    """Assert that the student's function returned three whole numbers, and return these numbers."""
    context.require(
        "three numbers are returned",
        holds=isinstance(returned, list) and len(returned) == 3,
        expected="three numbers",
        actual=returned,
        hints=[
            (None, NO_RETURN),
            (
                lambda actual: isinstance(actual, int),
                (
                    "Your function returned only one number. Return the three numbers `before`, "
                    "`after` and `missed`."
                ),
            ),
            (ANYTHING, "Return the three numbers in one line: `return before, after, missed`."),
        ],
    )
    before, after, missed = of_kind(list, returned, "the result")
    context.require(
        "the three results are whole numbers",
        holds=all(type(number) is int for number in (before, after, missed)),
        expected="three values of type int",
        actual=returned,
        hints=[
            (
                matches("data"),
                (
                    "Your function returned a whole message. Return only the number in the field "
                    "`data` of the message."
                ),
            ),
            (ANYTHING, "The three results have to be whole numbers. Return values of type int."),
        ],
    )
    return before, after, missed
