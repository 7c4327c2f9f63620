"""10.6: from what is seen to what is wrong."""

from __future__ import annotations

from collections.abc import Mapping

from course_pkg.examiner import Exam, part, says

# What is seen in each case stands in the notebook's table; here what it comes from.
CASES: Mapping[str, str] = {
    "A": "killed",
    "B": "new master",
    "C": "frozen",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}
DECISIVE: Mapping[str, str] = {
    "A": "The name is on the master's books, and at the address that they give nobody takes a connection.",
    "B": "The server runs, and answers who is connected already. Only who has to look the name up is turned "
    "away.",
    "C": "The connection is taken, and nothing of that node says a word, not even what rospy serves by "
    "itself.",
    "D": "The node is alive: what rospy serves by itself answers. What is silent has one thing in common.",
    "E": "Nobody waits, and nobody fails. Two saw the same number at the same time.",
    "F": "The first try had done its work, and only its answer was lost.",
    "G": "Both servers are well, and the master knows one provider for each name: the last.",
}
EXCUSED: Mapping[str, str] = {
    "killed": "A killed server leaves nobody to take a connection.",
    "new master": "A new master knows no provider: who looks the name up reads that it is unavailable.",
    "frozen": "A frozen process says nothing at all, whichever of its services is asked.",
    "lock": "A lock that is held lets callers wait. Here is no waiting of one for the other.",
    "race": "A race spoils what is kept, and nobody waits for it.",
    "repeated": "A repeat does work twice that was wanted once.",
    "two providers": "Of two providers one answers, and it answers well.",
}


@part(
    "10.6",
    points=2,
    goal="Say for seven cases what is wrong.",
    needs=["diagnosis"],
)
def diagnose(exam: Exam) -> None:
    """Hold the cases to their causes, one by one."""
    diagnosis = exam.read("diagnosis")
    exam.hold(
        "there is a diagnosis for each case",
        isinstance(diagnosis, dict) and set(diagnosis) == set(CASES),
        expected=f"a dict with the keys {', '.join(map(repr, CASES))}",
        seen=", ".join(map(repr, diagnosis)) if isinstance(diagnosis, dict) else diagnosis,
        hints={
            (
                lambda seen: len(seen.split(", ")) < len(CASES)
            ): "A case is missing: each letter of the table is a key.",
            says(""): "The keys are the letters of the table, A to G.",
        },
    )
    odd = [cause for cause in diagnosis.values() if not isinstance(cause, str) or cause not in EXCUSED]
    exam.hold(
        "each diagnosis is one of the causes",
        not odd,
        expected=f"one of {', '.join(map(repr, EXCUSED))}",
        seen=odd[0] if odd else "",
        hints="Take the words of the list of causes, letter by letter.",
    )
    for case, cause in CASES.items():
        exam.expect(
            f"case {case}",
            expected=cause,
            seen=diagnosis[case],
            hints=f"{EXCUSED[diagnosis[case]]} Look at {case} again: {DECISIVE[case]}",
        )
