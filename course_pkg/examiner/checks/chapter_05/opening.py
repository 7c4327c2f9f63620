"""Servers that come and go."""

from course_pkg.examiner import Exam, part, says
from course_pkg.graph.probe import ask_all, header_fields, service_probe
from course_pkg.graph.snapshot import ServiceSeen


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
        hints='The answer is success=True and message="open", and nothing else.',
    )
    return service


def _answers(service: ServiceSeen) -> bool:
    """Return whether somebody serves it where it was seen; a node that lives on may say that it does not."""
    probe = service_probe(service.name, service.uri)
    ask_all([probe], 1.0)
    return "type" in header_fields(probe.answer)
