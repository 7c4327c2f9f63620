"""Checks of functions that find a service by its name, and the running publishers of a topic."""

from course_pkg.chapters.ch01_name_things.checks.names import GEOMETRY
from course_pkg.checking import ANYTHING, CheckContext, matches, part
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.checking.peers.scripted_server import ScriptedServer
from course_pkg.checking.shared.geometry import boxes
from course_pkg.waiting import at_this_load

NUMBER = "std_msgs/UInt32"
LOOKS_LIKE_IT = (
    "Your function called another service with a similar name. Compare the whole "
    "text after the last slash with the given text."
)
FOUND = "Find the service, call this service, and return the volume."
RUNNING = "Return the sorted names of the running publishers of a topic."


@part(
    "01.3",
    points=3,
    goal=(
        "Find the service that has the given text after the last slash of its name. Call this "
        "service and return the volume, or return None if there is no such service."
    ),
    needs=["ask_wherever"],
    deadline=25.0,
    goals={FOUND: 2, "Return None if there is no such service.": 1},
)
def ask_it_wherever_it_lives(context: CheckContext) -> None:
    """Offer a service with a random name, and other services with similar names, in three runs.

    The namespace of the service has a different depth in each run. Later, call the student's function with
    the name of a service that does not exist.
    """
    similar: list[ScriptedServer] = []
    for depth in context.random.shuffled([0, 1, 3]):
        last = context.random.word()
        place = "".join(f"/{context.random.word()}" for _ in range(depth))
        volume, *others = (whole + 0.375 for whole in context.random.integers(4, 1000, 9000))
        wanted = f"{place}/{last}"
        named = {
            f"{place}/x{last}": others[0],
            f"/{last}/x": others[1],
            f"{wanted}x": others[2],
            wanted: volume,
        }
        # The master lists services in the order of their registration, so register them in a random order.
        servers = {
            name: context.serve(name, GEOMETRY, lambda _, v=named[name]: {"volume": v, "area": v + 1})
            for name in context.random.shuffled([*named])
        }
        similar += [server for name, server in servers.items() if name != wanted]
        length, width, height = context.random.numbers(3, 0.5, 9.0)
        returned = context.run("ask_wherever", last, length, width, height, hints=_LOST).returned()
        context.expect(
            "the volume comes from the right service",
            expected=volume,
            actual=returned,
            near=1e-6,
            hints=[
                (
                    None,
                    NO_RETURN
                    if servers[wanted].requests
                    else (
                        f"The service {wanted} exists, but your function returned None. In each call, get "
                        "the list of services again, and compare the text after the last slash of each name."
                    ),
                ),
                *((other, LOOKS_LIKE_IT) for other in others),
                (
                    length * width * height,
                    "Your function multiplied the sides, but the service returns a different "
                    "number. Call the service, and return the volume in the response.",
                ),
                (volume + 1, "Your function returned the area. Return the volume."),
                (
                    matches("volume"),
                    (
                        "Your function returned the whole response. Return only the field `volume` of "
                        "the response."
                    ),
                ),
                (
                    matches(f"/{last}$"),
                    (
                        "Your function returned the name of the service. Call this service, and "
                        "return the volume."
                    ),
                ),
            ],
        )
        _is_sent(context, servers[wanted], [length, width, height])
        _only_this_one(context, similar)
    last = context.random.word()
    context.serve(f"/{last}", GEOMETRY, lambda _: {"volume": 0.0, "area": 1.0})
    context.expect(
        "the volume comes from the right service",
        expected=0.0,
        actual=context.run("ask_wherever", last, 0.0, 1.0, 2.0, hints=_LOST).returned(),
        hints=[
            (
                None,
                "This service responds with the volume 0, but your function returned None. "
                "Return 0, because 0 is a valid volume.",
            ),
            (ANYTHING, "This service responds with the volume 0. Return this value unchanged."),
        ],
    )
    context.fulfilled(FOUND)
    context.expect(
        "the function returns None if there is no such service",
        expected=None,
        actual=context.run(
            "ask_wherever", context.random.word(), 1.0, 2.0, 3.0, hints=_LOST + _NOBODY
        ).returned(),
        hints="No service has the given name. Return None if your search finds no service.",
    )
    _in_a_random_order(context)


def _is_sent(context: CheckContext, server: ScriptedServer, sides: list[float]) -> None:
    """Assert that the first request contains the sides `sides`."""
    context.expect(
        "the request has length, width and height",
        expected=dict(zip(("length", "width", "height"), sides, strict=True)),
        actual=server.requests[0],
        near=1e-4,
        hints=[
            (
                lambda actual: not any(actual.values()),
                "All sides in the request are 0, because ROS sends 0 for a number that you do not "
                "set. Set all three sides.",
            ),
            (
                ANYTHING,
                "The order of the sides in the request is wrong. Compare this order with "
                "the output of `rossrv show course_pkg/geometry`.",
            ),
        ],
    )


def _only_this_one(context: CheckContext, similar: list[ScriptedServer]) -> None:
    """Assert that the student's function called none of the services with similar names."""
    requests = sum(len(server.requests) for server in similar)
    if requests:
        context.fail(
            "the volume comes from the right service",
            expected="no call of any other service",
            actual=f"{requests} call(s) of services with similar names",
            hint=LOOKS_LIKE_IT,
        )


def _in_a_random_order(context: CheckContext) -> None:
    """Call the student's function with new names; a function with a fixed list of results fails."""
    volumes: list[float | None] = [*context.random.numbers(context.random.integer(2, 4), 1.0, 9.0)]
    missing: list[float | None] = [None] * context.random.integer(1, 3)
    similar: list[ScriptedServer] = []
    for volume in context.random.shuffled([*volumes, *missing]):
        place, last = (context.random.word() for _ in range(2))
        *_, sides = boxes(context, 2)
        for other, wrong in ((f"x{last}", 99.0), (last.capitalize(), 98.0)):
            name = f"/{place}/{other}"
            similar.append(context.serve(name, GEOMETRY, lambda _, wrong=wrong: {"volume": wrong}))
        server = None
        if volume is not None:
            server = context.serve(f"/{place}/{last}", GEOMETRY, lambda _, volume=volume: {"volume": volume})
        _responds(context, last, sides, volume)
        if server:
            _is_sent(context, server, sides)
    # Call the function twice with the same arguments: the service is started between the two calls.
    place, missed = (context.random.word() for _ in range(2))
    later = context.random.number(1.0, 9.0)
    _responds(context, missed, sides, None)
    context.serve(f"/{place}/{missed}", GEOMETRY, lambda _: {"volume": later})
    _responds(context, missed, sides, later)
    _only_this_one(context, similar)


def _responds(context: CheckContext, last: str, sides: list[float], volume: float | None) -> None:
    """Assert that the student's function returns `volume`, or None if the service does not exist."""
    context.expect(
        "the function returns None if there is no such service"
        if volume is None
        else "the volume comes from the right service",
        expected=volume,
        actual=context.run("ask_wherever", last, *sides, hints=_LOST + _NOBODY).returned(),
        near=1e-6,
        hints=[
            (99.0, LOOKS_LIKE_IT),
            (
                98.0,
                "The name of the called service contains a capital letter, but the given text does not. In "
                "ROS, these are two different names.",
            ),
            (
                ANYTHING,
                "The result has to depend on the services that exist now, not on earlier calls of "
                "your function. Each time your function is called, get the list of services again.",
            ),
        ],
    )


_LOST = [
    (
        matches("unavailable"),
        "Your function called a service that does not exist. Use the full name from the list of services.",
    ),
    (
        matches("IndexError|StopIteration|TypeError.*NoneType"),
        "Your search found no service, but your function used the result of the search. Return "
        "None in this case.",
    ),
]


_NOBODY = [
    (
        matches("^(ServiceException|ROS|LookupError|ValueError|RuntimeError|Exception)"),
        "In this exercise, a missing service is not an error. Return None, and do not raise an exception.",
    )
]


@part(
    "01.4",
    points=2,
    goal="Return the sorted names of the nodes that publish a topic and answer a ping.",
    needs=["living_publishers"],
    deadline=25.0,
    goals={RUNNING: 3, "Return an empty list if no running node publishes the topic.": 1},
)
def who_really_publishes(context: CheckContext) -> None:
    """Register running nodes and killed nodes as publishers of several topics.

    At the end, call the student's function with topics that no running node publishes.
    """
    place, last, other, grave = (f"/{context.random.word()}" for _ in range(4))
    topic = f"{place}{last}"
    names = [f"{context.random.choice(['', '/left', '/right'])}/{context.random.word()}" for _ in range(11)]
    # In the order of registration and in the order of names, a dead node comes between running nodes. A loop
    # that ends at a dead node therefore misses some running nodes. The order of registration is neither the
    # order of names nor the reverse order, so a function that does not sort the names fails.
    (first, second, third), dead = sorted(names[:5])[::2], sorted(names[:5])[1::2]
    living = context.random.choice(
        [[first, third, second], [second, first, third], [second, third, first], [third, first, second]]
    )
    nodes = [
        context.fake_node(name, topic, NUMBER, alive=number % 2 == 0, reused=number == 3)
        for number, name in enumerate([living[0], dead[0], living[1], dead[1], living[2]])
    ]
    context.fake_node(names[5], other, NUMBER)
    context.fake_node(names[6], grave, NUMBER, alive=False)
    context.fake_node(names[7], f"{topic}_2", NUMBER)
    context.fake_node(names[8], f"/left{topic}", NUMBER)
    context.fake_node(names[9], last, NUMBER)
    context.subscribe(topic, NUMBER)
    subscribers = {name for each in context.look().topics if each.name == topic for name in each.subscribers}
    for node in nodes:
        node.pings.clear()
    found = _living(context, topic)
    # If the student's code read the list before the check started its nodes, only older topics are in it.
    is_old = found == [] and bool(_living(context, "/rosout"))
    found = _living(context, topic) if is_old else found
    unpinged = [node.name for node in nodes if node.alive and not node.pings]
    context.expect(
        "the list contains the running publishers of a topic, and it is sorted",
        expected=sorted(living),
        actual=found,
        hints=[
            (None, NO_RETURN),
            (
                lambda actual: sorted(actual) == sorted(living),
                (
                    "The names are right, but your list is not sorted. The function sorted(...) "
                    "returns a sorted list."
                ),
            ),
            (
                lambda actual: sorted(actual) == sorted(dead),
                "Your list contains the nodes that did not answer the ping. Return the nodes that answered.",
            ),
            (
                lambda actual: set(actual) & set(dead),
                (
                    "Your list contains a node that was killed, but is still registered. Ping each "
                    "node, and return only the nodes that answer."
                ),
            ),
            (
                lambda actual: {names[5], *names[7:10]} & set(actual),
                (
                    "Your list contains a node that publishes on a different topic. Compare the "
                    "whole name of the topic."
                ),
            ),
            (
                lambda actual: set(actual) & subscribers,
                "One node in your list only subscribes to the topic. Use the list of publishers.",
            ),
            (
                lambda actual: actual == [] and is_old,
                "Your list is empty, because the publishers were started after your code had read the list "
                "of publishers. Call getSystemState() inside your function.",
            ),
            (
                [],
                "Your list is empty, but the topic has publishers. In the list of publishers, "
                "each element is a pair: a topic, and the names of the publishers of this "
                "topic.",
            ),
            (
                lambda actual: isinstance(actual, int),
                ("Your function returned the number of publishers. Return the names of the publishers."),
            ),
            (
                lambda actual: "object" in actual,
                "Your function did not return a list. The function sorted(...) returns a list.",
            ),
            (
                lambda actual: set(actual) < set(living),
                "Some running nodes are missing in your list. Ping every publisher of the topic.",
            ),
            (
                ANYTHING,
                "Return a list of node names. Each name has to be a string, as in the list of publishers.",
            ),
        ],
    )
    if unpinged:
        context.fail(
            "the list contains the running publishers of a topic, and it is sorted",
            expected="a ping of each publisher",
            actual=f"no ping of {', '.join(sorted(unpinged))}",
            hint=(
                "Your function did not ping every node that it returned. A node is running only if it "
                "answers a call of rosnode_ping."
            ),
        )
    context.fulfilled(RUNNING)
    context.expect(
        "the list is empty if no publisher is running",
        expected=[[], []],
        actual=[_living(context, grave), _living(context, f"/{context.random.word()}")],
        hints="Return an empty list if no running node publishes the topic.",
    )
    context.fake_node(names[10], grave, NUMBER)
    context.expect(
        "the list contains the running publishers of a topic, and it is sorted",
        expected=[names[10]],
        actual=_living(context, grave),
        hints=(
            "A new publisher of the topic was started after the previous call, and it is missing in your "
            "list. Each time your function is called, ask the master for the publishers again."
        ),
    )


def _living(context: CheckContext, topic: str) -> object:
    return context.run(
        "living_publishers",
        topic,
        within=at_this_load(8.0),  # A node that does not respond gets three pings, which takes 6 s.
        hints=[
            (
                matches("TimesUp"),
                (
                    "rosnode_ping sends pings forever, so your call of rosnode_ping does not return. "
                    "Pass max_count=1 to rosnode_ping."
                ),
            ),
            (
                matches("KeyError"),
                "A topic without a publisher is not in the list of publishers. Return an empty list "
                "in this case.",
            ),
        ],
    ).returned()
