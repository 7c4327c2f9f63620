"""Finds identical and nearly identical answers of different students."""

from __future__ import annotations

from collections.abc import Iterator

from course_pkg.grading.flags.fingerprints import Fingerprint, fingerprint
from course_pkg.grading.flags.similarity import Exercise, Pair, Similarity
from course_pkg.grading.flags.syntax import line_of
from course_pkg.grading.flags.work import Answer, Found, Group, Work
from course_pkg.grading.grade import Flag

TITLE = "Similar answers of different students"


def find(group: Group) -> Iterator[Found]:
    """Yield a flag for each answer that is nearly identical to another student's answer.

    A team that handed in the same file counts as one student.
    """
    teams = _teams(group)
    prints = [{answer.name: fingerprint(answer) for answer in team[0].answers} for team in teams]
    similarity = Similarity(prints, blank_fingerprints(group))
    alike: dict[tuple[int, str], list[tuple[float, int]]] = {}
    for pair in similarity.pairs():
        for one, other, name, likeness in _both(pair):
            alike.setdefault((one, name), []).append((likeness, other))
    for (one, name), found in sorted(alike.items()):
        ranked = sorted(found, key=lambda each: (-each[0], each[1]))
        likeness, other = ranked[0]
        answer = _named(teams[one][0], name)
        mine, theirs = prints[one][name], prints[other][name]
        line = _rarest_line(similarity.exercises[name], answer, mine, theirs)
        words = (
            f"{likeness:.0%} of the code is the same in both answers. This number ignores the code that many "
            "students have."
        )
        if answer.source.split() == _named(teams[other][0], name).source.split():
            words = "The answers are identical."
        elif mine.code == theirs.code:
            words = "The answers differ only in names, comments, strings or the order of the lines."
        others = tuple(work.student for _, number in ranked for work in teams[number])
        flag = Flag("copies", answer.where, words, line, line_of(answer, line), others)
        yield from ((work, flag) for work in teams[one])


def _teams(group: Group) -> list[list[Work]]:
    """Return groups of submissions; all submissions of a group come from the same file."""
    teams: dict[str, list[Work]] = {}
    for work in group.works:
        teams.setdefault(work.origin, []).append(work)
    return list(teams.values())


def blank_fingerprints(group: Group) -> dict[str, Fingerprint]:
    """Return the fingerprints of the unchanged exercise cells that students get."""
    return {
        name: fingerprint(Answer(group.solution[name].where, text)) for name, text in group.blanks.items()
    }


def _rarest_line(exercise: Exercise, answer: Answer, one: Fingerprint, other: Fingerprint) -> int:
    """Find the rarest statement that both answers contain.

    Return the statement's line number in `answer`, or 0 if the two answers have no statement in common.
    """
    theirs = {form for form, _ in other.lines}
    shared = [
        (not exercise.counts(form), exercise.having(form), -len(line_of(answer, line)), line)
        for form, line in one.lines
        if form in theirs
    ]
    return min(shared, default=(True, 0, 0, 0))[-1]


def _both(pair: Pair) -> Iterator[tuple[int, int, str, float]]:
    for name, share in pair.likeness.items():
        yield pair.first, pair.second, name, share
        yield pair.second, pair.first, name, share


def _named(work: Work, name: str) -> Answer:
    return next(answer for answer in work.answers if answer.name == name)
