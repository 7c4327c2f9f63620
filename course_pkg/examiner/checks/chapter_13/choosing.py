"""13.4: topic, service, action or parameter, for eight cases."""

from __future__ import annotations

from course_pkg.examiner import Exam, part

FOUR = ("topic", "service", "action", "parameter")
CASES = {
    "a": ("topic", "Fifty times a second, for whoever listens: nobody can ask so often. A topic."),
    "b": ("service", "One asks, one answers, and at once: a service. It changes, so it is no setting."),
    "c": (
        "action",
        "It takes a minute, and may be called off: while a service is called, neither can be done. And "
        "whoever sent the robot wants to hear how it ended, which a topic does not say.",
    ),
    "d": (
        "parameter",
        "It is set once, before anything starts, and does not change: nobody has to be asked.",
    ),
    "e": ("topic", "Three want to hear of it, and who sees the customer need not know who they are."),
    "f": (
        "service",
        "Who resets the till has to know that it is done, and it is done at once: a service. "
        "A topic gives no answer.",
    ),
    "g": (
        "action",
        "The caller wants to see how far it is: feedback is what an action has and a service lacks.",
    ),
    "h": ("parameter", "Several read it when they begin, and it stays. No server has to run for that."),
}


@part(
    "13.4",
    points=2,
    goal="Say for eight cases whether a topic, a service, an action or a parameter is the one to take.",
    needs=["choices"],
    deadline=10.0,
)
def the_choice(exam: Exam) -> None:
    """Hold each case against the one that fits."""
    given = exam.read("choices")
    exam.hold(
        "choices is a dict from a letter to one of the four",
        isinstance(given, dict),
        expected='{"a": "topic", …}',
        seen=given,
        hints="Write it as a dict, with a letter before each colon.",
    )
    assert isinstance(given, dict)
    for letter, (right, reason) in CASES.items():
        seen = given.get(letter)
        words = reason if seen in FOUR else f"Case {letter} has to be one of: {', '.join(FOUR)}."
        exam.expect(f"case {letter}", expected=right, seen=seen, hints=words)
