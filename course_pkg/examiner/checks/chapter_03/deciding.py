"""03.4 and 03.5: what polling costs, by arithmetic, and which design fits which job."""

from __future__ import annotations

from collections.abc import Mapping

from course_pkg.examiner import Exam, part, says

ORDER = "The three are there, in another order: the mean first, then the longest, then the share."
ROUNDED = 0.006  # what a share may be off that was rounded to two digits
DESIGNS = ("topic", "service", "action")
REASONS = ("answer", "many", "newest", "seldom", "long")

# For each job the design, and the reasons that hold for it; more than one may.
JOBS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "wheel speed": ("topic", ("newest", "many")),
    "open the gripper": ("service", ("answer",)),
    "full map": ("service", ("seldom", "answer")),
    "obstacle seen": ("topic", ("many", "newest")),
    "tidy the room": ("action", ("long",)),
    "free space on disk": ("service", ("seldom", "answer")),
}
WRONG: Mapping[tuple[str, str], str] = {
    (
        "wheel speed",
        "service",
    ): "Fifty times a second somebody would have to ask, and to wait, for a number that is "
    "always there. You have measured what fifty questions a second cost.",
    ("open the gripper", "topic"): "The gripper may be stuck, and who sent it there would never hear of it.",
    ("full map", "topic"): "Ten megabytes a second would travel, for one program that wants them once a day.",
    (
        "obstacle seen",
        "service",
    ): "Who sees it would have to call the motors, the lamp and the log, one after the "
    "other, and to wait for each. And it would have to know them all.",
    (
        "tidy the room",
        "service",
    ): "The caller would stand still for half an hour, with no word of how far it is, and "
    "no way to break it off.",
    ("tidy the room", "topic"): "Nobody could say how far it is, whether it worked, or that it should stop.",
    (
        "free space on disk",
        "topic",
    ): "It would be said all day long, to one who wants to know it before a recording.",
}
HOLLOW: Mapping[str, str] = {
    "answer": "Here nobody who asks or sends needs an answer of their own.",
    "many": "Here one program wants it, and not many.",
    "newest": "It is not the case here that a newer value comes of itself, all the time.",
    "seldom": "It is wanted often, or it is small: that is no reason here.",
    "long": "It takes no time to speak of. That is the reason for an action.",
}


@part(
    "03.4",
    points=2,
    goal="Say in advance how late polling is, and how many customers it misses.",
    needs=["expect_of_polling"],
)
def what_polling_costs(exam: Exam) -> None:
    """Questions that come often enough for everybody, and questions that come too seldom for some."""
    often = [(rate, exam.draw.number(1.2, 3.0, digits=5) / rate) for rate in exam.draw.numbers(3, 0.2, 40.0)]
    seldom = [(rate, exam.draw.number(0.1, 0.8, digits=5) / rate) for rate in exam.draw.numbers(3, 0.2, 40.0)]
    for rate, stay in [*often, *seldom]:
        pause, share = 1 / rate, max(0.0, 1 - rate * stay)
        found = exam.run("expect_of_polling", rate, stay).value
        exam.hold(
            "three numbers are returned",
            isinstance(found, list) and len(found) == 3 and all(type(item) in (int, float) for item in found),
            expected="(mean delay, longest delay, share of customers who are missed)",
            seen=found,
            hints={
                None: "None was returned, as by a function that comes to its end without a return line.",
                (
                    lambda seen: len(seen) == 3
                ): "One of them is no number. A share is a number from 0 to 1, too.",
                says(""): "Return the three with commas between them: return mean, longest, missed.",
            },
        )
        mean, longest, missed = found
        exam.expect(
            "the longest delay is the whole pause",
            expected=pause,
            seen=longest,
            near=1e-6,
            hints=ORDER
            if pause in (mean, missed)
            else {
                rate: "That is the rate. The pause between two questions is 1 / rate.",
                pause / 2: "That is the mean. Who comes just after a question waits for the whole pause.",
                1000 * pause: "That is in milliseconds. Return seconds.",
                stay: "That is how long a customer stays. Think of one who stays long enough to be found.",
                says(""): "It depends on the rate, and on nothing else: the pause between two questions.",
            },
        )
        exam.expect(
            "the mean delay is half the pause",
            expected=pause / 2,
            seen=mean,
            near=1e-6,
            hints={
                pause: "That is the longest delay. Customers come at any moment of the pause: on "
                "average in the middle of it.",
                rate / 2: "That is half the rate. The pause is 1 / rate, and the mean half of that.",
            },
        )
        exam.expect(
            "the share of those who are missed" if share else "nobody is missed who stays for a whole pause",
            expected=share,
            seen=missed,
            near=1e-6,
            hints=_missed(rate * stay),
        )


def _missed(share_seen: float) -> list[tuple[object, str]]:
    """Return hints for a share of missed customers where `share_seen` is stay / pause."""
    return [
        (1 - share_seen, "Less than none is missed: a share below 0 has to be 0. max(0, ...) does it."),
        (min(1.0, share_seen), "That is the share of those who are found. The others are missed: 1 - it."),
        (100 * (1 - share_seen), "That is in percent. Return a share, from 0 to 1."),
        (share_seen - 1, "Less than none is missed: a share below 0 has to be 0. max(0, ...) does it."),
        (lambda seen: seen and abs(seen - (1 - share_seen)) < ROUNDED, "It is rounded. Return it as it is."),
        (1.0, "All of them? Who comes less than `stay` before a question is there when it is asked."),
        (0, "Some are missed: who comes just after a question, and goes before the next one."),
        (
            says(""),
            "A customer is found if a question falls into their stay: that happens for stay / pause of them.",
        ),
    ]


@part(
    "03.5",
    points=2,
    goal="Decide for six jobs, and give the reason for each.",
    needs=["decisions"],
)
def decide_and_defend(exam: Exam) -> None:
    """Look at the design first, then at the reason: a right one for a wrong reason is luck."""
    decisions = exam.read("decisions")
    exam.hold(
        "there is a decision for each job",
        isinstance(decisions, dict) and set(decisions) == set(JOBS),
        expected=f"a dict with the keys {', '.join(map(repr, JOBS))}",
        seen=", ".join(map(repr, decisions)) if isinstance(decisions, dict) else decisions,
        hints={
            (
                lambda seen: isinstance(seen, list)
            ): "A dict is written in braces: {job: (design, reason), ...}.",
            says(""): "The keys are the jobs as the table names them. Compare letter by letter.",
        },
    )
    exam.hold(
        "each decision is a design and a reason",
        all(_is_decision(value) for value in decisions.values()),
        expected='such as ("topic", "newest")',
        seen=next((value for value in decisions.values() if not _is_decision(value)), ""),
        hints={
            (lambda seen: isinstance(seen, str)): "The design alone is half of it: give the reason, too.",
            (
                lambda seen: tuple(seen[::-1]) and seen[0] in REASONS and seen[1] in DESIGNS
            ): "The design stands first, then the reason.",
            says(""): f"The designs are {', '.join(DESIGNS)}; the reasons are {', '.join(REASONS)}.",
        },
    )
    for job, (design, reasons) in JOBS.items():
        chosen, reason = decisions[job]
        exam.expect(f"{job}: the design", expected=design, seen=chosen, hints=_why_not(job, chosen))
        exam.hold(
            f"{job}: the reason",
            reason in reasons,
            expected="a reason that holds for this job",
            seen=reason,
            hints=HOLLOW[reason],
        )


def _is_decision(value: object) -> bool:
    return isinstance(value, list) and len(value) == 2 and value[0] in DESIGNS and value[1] in REASONS


def _why_not(job: str, chosen: str) -> str:
    action = "It is done in a moment. An action is for what takes long, and can be watched and broken off."
    return WRONG.get((job, chosen), action)
