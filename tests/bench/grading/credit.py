"""Measures partial credit: the points of wrong answers, and of answers that do nothing.

Arguments: `[few] [PART …]`.

PART is the beginning of a part's id, such as 05 or 05.3. The first right answer of each part must earn full
points, and each wrong example answer must earn fewer points. The benchmark also changes the first right
answer into answers that do nothing. In some of these answers, each function only returns a fixed value or
raises an exception. In the other answers, the first line is an error. An answer that does nothing must earn
no points. The exit status is the number of answers with wrong points. If the argument `few` is given, only
two wrong answers of each part run. The benchmark omits parts without goals, because these parts have no
partial credit.
"""

from __future__ import annotations

import ast
import os
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from course_pkg.checking.parts import every_part
from course_pkg.sandbox.job import PartJob
from tests.checking.answers.example_answers import Answer, every_answer
from tests.checking.answers.workers import WorkerPool

NOTHING = {
    "returns None": "return None",
    "returns True": "return True",
    "returns False": "return False",
    "returns 0": "return 0",
    "returns an empty list": "return []",
    "raises": "raise RuntimeError('nothing')",
}  # Each key describes a function; the value is the only statement of this function.
IDLE = "does nothing: "
UNABLE = {"is not Python": "this is not Python\n", "raises at its start": "raise RuntimeError('nothing')\n"}


def credit_main() -> int:
    """Print the answers with partial or wrong points; return the number of answers with wrong points."""
    words = sys.argv[1:]
    few = "few" in words
    asked = tuple(word for word in words if word != "few") or ("",)
    parts = {part.check: part for part in every_part() if part.goals and part.check.startswith(asked)}
    examples = [answer for answer in every_answer() if answer.check in parts]
    answers: list[Answer] = []
    for check in parts:
        wrong = [each for each in examples if each.check == check and not each.right]
        right = next(each for each in examples if each.check == check and each.right)
        answers += [right, *wrong[: 2 if few else None], *_doing_nothing(right)]
    earned: Counter[str] = Counter()
    unfair = 0
    with WorkerPool(2 * (os.cpu_count() or 1)) as pool:
        jobs = [
            PartJob(each.check, each.before, (each.source,), each.after, 1, parts[each.check].deadline)
            for each in answers
        ]
        pool.submit(jobs)
        for answer, job in zip(answers, jobs, strict=True):
            report = pool.result(job).report
            points = report.points if report else 0
            full = parts[answer.check].points
            idle = answer.title.startswith(IDLE)
            fair = points == full if answer.right else points == 0 if idle else points < full
            unfair += not fair
            earned["nothing" if not points else "some points" if points < full else "full points"] += 1
            if not fair or 0 < points < full:
                sign = "  " if fair else "!!"
                print(f"{sign} {answer.check} {points:g} of {full}: {answer.title}", flush=True)
    counts = ", ".join(f"{count} {name}" for name, count in earned.items())
    print(f"{len(parts)} parts, {len(answers)} answers: {counts}; {unfair} with wrong points")
    return min(unfair, 100)


def _doing_nothing(right: Answer) -> Iterator[Answer]:
    """Yield answers that define the same names as the right answer, but do nothing."""
    magic = right.source.startswith("%%")
    first, _, text = right.source.partition("\n") if magic else ("", "", right.source)
    head = f"{first}\n" if magic else ""
    for title, statement in UNABLE.items():
        yield replace(right, right=False, title=f"{IDLE}{title}", source=f"{head}{statement}{text}")
    try:
        functions = any(isinstance(node, ast.FunctionDef) for node in ast.walk(ast.parse(text)))
    except SyntaxError:
        functions = False
    if not functions:
        return
    for title, statement in NOTHING.items():
        tree = ast.parse(text)
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and node.name != "__init__":
                node.body = ast.parse(statement).body
        yield replace(right, right=False, title=f"{IDLE}{title}", source=f"{head}{ast.unparse(tree)}\n")
