"""Finds the course's own solution, submitted as an answer."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import suppress

from course_pkg.grading.flags.fingerprints import Fingerprint, fingerprint
from course_pkg.grading.flags.kinds.copies import blank_fingerprints
from course_pkg.grading.flags.similarity import NOTHING, SAME, STATEMENTS, Similarity
from course_pkg.grading.flags.syntax import UNREADABLE, is_python, tree
from course_pkg.grading.flags.work import Answer, Found, Group
from course_pkg.grading.grade import Flag

TITLE = "The course's own solution"
EXACT = "The answer is the same as the course's solution."
CHANGED = (
    "The answer differs from the course's solution only in names, comments, strings or the order of "
    "the lines."
)


def find(group: Group) -> Iterator[Found]:
    """Yield a flag for each answer that is identical or nearly identical to the course's solution.

    A short answer that is equal to the solution does not prove that the student copied it, because many
    students write the same code. Therefore, statements that are also in the unchanged exercise cell are not
    counted. A student's answers that are identical to the solutions are reported only if they contain at
    least ten counted statements in total. A nearly identical answer is reported only if the solution of this
    exercise contains at least ten counted statements.
    """
    blanks = blank_fingerprints(group)
    own = {name: fingerprint(answer) for name, answer in group.solution.items()}
    written = {name: _written(each, blanks.get(name, NOTHING)) for name, each in own.items()}
    students = [{answer.name: fingerprint(answer) for answer in work.answers} for work in group.works]
    exercises = Similarity([*students, own], blanks).exercises
    plain = {name: _plain(answer) for name, answer in group.solution.items()}
    for work, answers in zip(group.works, students, strict=True):
        known = [answer for answer in work.answers if answer.name in own]
        exact = [answer for answer in known if _plain(answer) == plain[answer.name]]
        if sum(written[answer.name] for answer in exact) >= STATEMENTS:
            yield from ((work, Flag("solution", answer.where, EXACT)) for answer in exact)
        for answer in known:
            name = answer.name
            if answer in exact or written[name] < STATEMENTS:
                continue
            if exercises[name].likeness_of(answers[name], own[name]) >= SAME:
                yield work, Flag("solution", answer.where, CHANGED)


def _written(answer: Fingerprint, given: Fingerprint) -> int:
    """Return the number of statements in `answer` that are not in `given`, the unchanged exercise cell."""
    forms = {form for form, _ in given.lines}
    return sum(form not in forms for form, _ in answer.lines)


def _plain(answer: Answer) -> str:
    """Return the program in a form that does not depend on comments, spaces and line breaks.

    The comments stay in the result if the program is not valid Python.
    """
    with suppress(*UNREADABLE):
        if is_python(answer):
            return ast.dump(tree(answer))
    return " ".join(answer.source.split())
