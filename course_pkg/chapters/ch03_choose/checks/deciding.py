"""03.4: the right design for each task, and the reason for the design."""

from __future__ import annotations

from collections.abc import Mapping

from course_pkg.checking import ANYTHING, CheckContext, part
from course_pkg.checking.plain_values import of_kind

DESIGNS = ("topic", "service", "action")
REASONS = ("answer", "many", "newest", "seldom", "latched", "long")

# For each task, this dict maps each right design to the right reasons for this design.
JOBS: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "wheel speed": {"topic": ("newest", "many")},
    "open the gripper": {"service": ("answer",), "action": ("answer", "long")},
    "full map": {"service": ("seldom", "answer"), "topic": ("latched", "many")},
    "obstacle seen": {"topic": ("many",)},
    "tidy the room": {"action": ("long", "answer")},
    "free space on disk": {"service": ("seldom", "answer")},
}
WRONG: Mapping[tuple[str, str], str] = {
    (
        "wheel speed",
        "service",
    ): (
        "With a service, the client would make fifty calls per second and wait for each "
        "response. Choose a design without calls."
    ),
    (
        "open the gripper",
        "topic",
    ): "The gripper can be blocked, but a publisher would not get this information. Choose a "
    "design with a response.",
    (
        "obstacle seen",
        "service",
    ): (
        "With a service, the bumper's node would have to call the motors, the lamp and the log "
        "one after the other. Choose a design with many receivers."
    ),
    (
        "tidy the room",
        "service",
    ): "With a service, the client would wait for half an hour without progress messages. Choose "
    "a design that the client can cancel.",
    (
        "tidy the room",
        "topic",
    ): "With a topic, the node that publishes the task gets no progress messages and no result. "
    "Choose a design with a result and progress messages.",
    (
        "free space on disk",
        "topic",
    ): "With a topic, a node would publish the number all day, but one program needs this "
    "number only once. Choose a design with a single call.",
}
HOLLOW: Mapping[str, str] = {
    "answer": (
        "This reason does not fit: in this task, the node that sends the data does not need an answer."
    ),
    "many": "This reason does not fit: in this task, only one node needs the data.",
    "newest": "This reason does not fit: in this task, new values are not produced all the time.",
    "seldom": "This reason does not fit: in this task, the data is needed often, or the messages are small.",
    "latched": (
        "This reason does not fit: in this task, a node that starts later does not need an old value."
    ),
    "long": "This reason does not fit: in this task, the work takes only a short time.",
}


@part(
    "03.4",
    points=2,
    goal="Choose a design and a reason for each of six tasks.",
    needs=["decisions"],
)
def decide_and_defend(context: CheckContext) -> None:
    """For each task, assert that the chosen design is right, and then that the chosen reason is right."""
    decisions = context.read("decisions")
    context.require(
        "there is a decision for each task",
        holds=isinstance(decisions, dict) and set(decisions) == set(JOBS),
        expected=f"a dict with the keys {', '.join(map(repr, JOBS))}",
        actual=", ".join(map(repr, decisions)) if isinstance(decisions, dict) else decisions,
        hints=[
            (
                lambda actual: isinstance(actual, list),
                (
                    "Your answer is a list. Write a dict in braces: each key is a task, and each "
                    "value is a pair (design, reason)."
                ),
            ),
            (
                ANYTHING,
                (
                    "The keys have to be the names of the tasks in the table. Compare the names "
                    "letter by letter."
                ),
            ),
        ],
    )
    decided = of_kind(dict, decisions, "decisions")
    context.require(
        "each decision is a pair of a design and a reason",
        holds=all(_is_decision(value) for value in decided.values()),
        expected='a pair such as ("topic", "newest")',
        actual=next((value for value in decided.values() if not _is_decision(value)), ""),
        hints=[
            (
                lambda actual: isinstance(actual, str),
                "The reason is missing. Write a pair: (design, reason).",
            ),
            (
                lambda actual: tuple(actual[::-1]) and actual[0] in REASONS and actual[1] in DESIGNS,
                "The order in the pair is wrong. Write the design first, and then the reason.",
            ),
            (
                ANYTHING,
                (
                    "One value is not a valid pair (design, reason). "
                    f"The designs are {', '.join(DESIGNS)}; the reasons are {', '.join(REASONS)}."
                ),
            ),
        ],
    )
    for job, designs in JOBS.items():
        chosen, reason = decided[job]
        context.require(
            f"{job}: the design fits the task",
            holds=chosen in designs,
            expected="a different design",
            actual=chosen,
            hints=_why_not(job, chosen),
        )
        context.require(
            f"{job}: the reason fits the task",
            holds=reason in designs[chosen],
            expected="a reason that is true for this task and this design",
            actual=reason,
            hints=HOLLOW[reason],
        )


def _is_decision(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and value[0] in DESIGNS and value[1] in REASONS


def _why_not(job: str, chosen: str) -> str:
    action = "This task takes only a moment. Choose an action only for long work that can be cancelled."
    return WRONG.get((job, chosen), action)
