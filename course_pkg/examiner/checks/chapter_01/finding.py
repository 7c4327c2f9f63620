"""Services and publishers are found, and those that are only listed are told from those that live."""

from course_pkg.examiner import Exam, part, says
from course_pkg.examiner.checks.chapter_01.names import GEOMETRY, NO_RETURN

NUMBER = "std_msgs/UInt32"
LOOKS_LIKE_IT = (
    "Another service answered, whose name only looks like it. Compare all that stands behind the last slash."
)


@part(
    "01.3",
    points=3,
    goal="Find the service whose name ends in a given part, ask it, and return the volume, or None.",
    needs=["ask_wherever"],
    deadline=25.0,
)
def ask_it_wherever_it_lives(exam: Exam) -> None:
    """Serve at three depths, each beside names that are nearly right; then ask for one that nobody serves."""
    for depth in exam.draw.shuffled([0, 1, 3]):
        last = exam.draw.word()
        place = "".join(f"/{exam.draw.word()}" for _ in range(depth))
        volume, *others = (whole + 0.375 for whole in exam.draw.integers(4, 1000, 9000))
        named = {f"{place}/x{last}": others[0], f"/{last}/x": others[1], f"{place}/{last}x": others[2]}
        for name, wrong in named.items():
            exam.serve(name, GEOMETRY, lambda _, v=wrong: {"volume": v})
        answer = {"volume": volume, "area": volume + 1}
        server = exam.serve(f"{place}/{last}", GEOMETRY, lambda _, a=answer: a)
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        exam.expect(
            "the volume comes from the service that was meant",
            expected=volume,
            seen=exam.run("ask_wherever", last, length, width, height, hints=_LOST).value,
            near=1e-6,
            hints=[
                (None, "It is there, and None was returned. Look through all names; return what it answers."),
                *((other, LOOKS_LIKE_IT) for other in others),
                (length * width * height, "You multiplied. This server measures in its own way: ask it."),
                (volume + 1, "That is the area. Return the volume."),
                (says("volume"), "That is the whole response. Return its volume."),
                (says(f"/{last}$"), "That is its name. Ask it, and return the volume."),
            ],
        )
        exam.expect(
            "it is sent length, width and height",
            expected={"length": length, "width": width, "height": height},
            seen=server.requests[0],
            near=1e-4,
            hints=[
                (lambda seen: not any(seen.values()), "It was sent zeros, as for fields that are left out."),
                (says(""), "Compare the order of your arguments with rossrv show course_pkg/geometry."),
            ],
        )
    exam.expect(
        "None when nobody serves it",
        expected=None,
        seen=exam.run("ask_wherever", exam.draw.word(), 1.0, 2.0, 3.0, hints=_LOST | _NOBODY).value,
        hints="No service is called so. Return None after the search.",
    )


_LOST = {
    says(
        "unavailable"
    ): "The name that was called is not the full one. Call the service by the name that you found.",
    says(
        "IndexError|StopIteration"
    ): "The search found nothing, and its first find was used. Return None then.",
    says("TypeError.*NoneType"): "The search found nothing, and None was used as a name. Return None then.",
}


_NOBODY = {
    says(
        "^(ServiceException|ROS|LookupError|ValueError|RuntimeError|Exception)"
    ): "Nobody serves it, and that is no error here: return None."
}


@part(
    "01.4",
    points=2,
    goal="Return the nodes that publish a topic and answer a ping, sorted.",
    needs=["living_publishers"],
    deadline=25.0,
)
def who_really_publishes(exam: Exam) -> None:
    """List living and killed publishers of two topics; then ask for a topic of the killed, and for none."""
    topic, other, grave = (f"/{exam.draw.word()}" for _ in range(3))
    names = [f"{exam.draw.choice(['', '/left', '/right'])}/{exam.draw.word()}" for _ in range(7)]
    living, dead = names[:3], names[3:5]
    for number, name in enumerate([living[0], dead[0], living[1], dead[1], living[2]]):
        exam.puppet(name, topic, NUMBER, alive=number % 2 == 0)
    exam.puppet(names[5], other, NUMBER)
    exam.puppet(names[6], grave, NUMBER, alive=False)
    exam.expect(
        "the living publishers of a topic, sorted",
        expected=sorted(living),
        seen=_living(exam, topic),
        hints=[
            (None, NO_RETURN),
            (
                lambda seen: sorted(seen) == sorted(living),
                "They are the right ones. Return them sorted: sorted(...) makes a list in order.",
            ),
            (lambda seen: sorted(seen) == sorted(dead), "Those are the dead ones: they did not answer."),
            (
                lambda seen: set(seen) & set(dead),
                "One of those was killed, and is listed still. Ping each, and leave out who does not answer.",
            ),
            (
                lambda seen: names[5] in seen,
                "One of those publishes another topic. Look up the one that is given.",
            ),
            (lambda seen: isinstance(seen, str), "That is one text. Return a list of names."),
            (lambda seen: topic in seen, "That is a topic. Behind its name in the list stand the nodes."),
            (
                [],
                "Somebody publishes it. The lists hold pairs: a topic, and the names of its nodes.",
            ),
            (lambda seen: isinstance(seen, int), "That is how many there are. Return their names."),
            (lambda seen: "object" in seen, "That is no list. sorted(...) makes one."),
            (
                lambda seen: set(seen) < set(living),
                "Some who live are missing. Ping each, and go through all.",
            ),
            (says(""), "Return the names of the nodes, as the list of publishers has them behind the topic."),
        ],
    )
    exam.expect(
        "nobody is an empty list",
        expected=[[], []],
        seen=[_living(exam, grave), _living(exam, f"/{exam.draw.word()}")],
        hints={
            (lambda seen: None in seen): "None is no list. Return [] when there is nobody.",
            says(""): "Nobody living publishes these two. The answer is an empty list.",
        },
    )


def _living(exam: Exam, topic: str) -> object:
    return exam.run(
        "living_publishers",
        topic,
        within=10.0,  # three pings of each who is dead take 6
        hints={
            says("TimesUp"): "Without max_count=1, rosnode_ping goes on pinging for ever.",
            says("KeyError"): "No node has ever published that topic, so it is in no list. That is nobody.",
        },
    ).value
