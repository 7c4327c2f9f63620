"""07.5: a call of whatever type a service turns out to be, from Python."""

from __future__ import annotations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.checks.chapter_07.questions import Question, questions
from course_pkg.examiner.checks.chapter_07.words import NO_RETURN

IS_MESSAGE = """
def is_message(function, *args):
    return hasattr(function(*args), "_slot_types")
"""  # to a check, a message and a dict of its values look alike
SLIPS = {
    says("already been called"): (
        "rosservice.call_service makes a node of its own, and this kernel is one already. Take the class "
        "from get_service_class_by_name, and make a proxy."
    ),
    says("'str' object has no attribute '_request_class'"): (
        "That is the name of the type, a text. get_service_class_by_name returns the class itself."
    ),
    says("must be a Message"): "The class is of the service, with two halves. Fill its _request_class().",
    says("KeyError: 0"): "fill_message_args takes a list, for there may be several values: [fields].",
    says("md5sums do not match"): "It is of another type. Ask which, each time: get_service_class_by_name.",
}
FLAT = (
    "The dict is one thing, the request has fields of its own. Fill them by name: "
    "genpy.message.fill_message_args(request, [fields])."
)
NESTED = (
    "The field camera_info is a message, and a dict is none. genpy.message.fill_message_args fills a request "
    "from a dict, however deep."
)


@part(
    "07.5",
    points=3,
    goal="Call a service of whatever type it is with the fields in a dict, and return its response.",
    needs=["call_any"],
    deadline=25.0,
)
def call_what_is_there(exam: Exam) -> None:
    """Serve several types under names that tell nothing; then give a field that the type does not have."""
    for question in questions(exam):
        _called(exam, question)
    name = f"/{exam.draw.word()}"
    server = exam.serve(name, "std_srvs/SetBool", lambda _: {"success": True})
    wrong = exam.run("call_any", name, {"dat": True})
    exam.hold(
        "a field that the type does not have is an error",
        bool(wrong.error) and not server.requests,
        expected="an error about dat",
        seen=wrong.error or "no error, and a call without it",
        hints="The service was called with False in its place. Let the error about the name come out.",
    )
    exam.prepare(IS_MESSAGE)
    whole = exam.run("is_message", Its("call_any"), name, {"data": True}, worded="call_any()", hints=SLIPS)
    exam.expect(
        "the response is returned",
        expected="a response",
        seen="a response" if whole.value else "something else with its values in it",
        hints="Return the response itself, as the proxy returns it.",
    )


def _called(exam: Exam, question: Question) -> None:
    name = f"/{exam.draw.word()}"
    server = exam.serve(name, question.kind, lambda _: question.answer)
    unfilled = NESTED if "camera_info" in question.fields else FLAT
    hints = [*SLIPS.items(), (says(""), unfilled)]
    returned = exam.run("call_any", name, question.fields, hints=hints).value
    exam.expect(
        "the service is called once",
        expected=1,
        seen=len(server.requests),
        hints={
            0: "Nobody called it. Call the service that is named, and call it with its request.",
            says(""): "Each call makes the server do its work again. Call once, and keep the response.",
        },
    )
    exam.expect(
        f"{question.what}: the fields arrive as they were given",
        expected=question.fields,
        seen=question.given(server.requests[0]),
        hints=[
            (
                question.mixed_up,
                "The values arrived in each other's fields. A dict goes by name, and not by position.",
            ),
            (says(": ''|: 0|: False"), "A field that gets no value is empty, 0 or False without a word."),
        ],
    )
    exam.expect(
        "the response is returned",
        expected=question.answer,
        seen=returned,
        hints=[
            (None, NO_RETURN),
            ((lambda seen: isinstance(seen, list)), "That is more than the response. Return it alone."),
            (says(""), "Return the response as it came."),
        ],
    )
