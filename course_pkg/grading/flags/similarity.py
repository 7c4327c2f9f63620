"""Which students handed in identical or nearly identical code, beyond what a class has in common.

Handed-out code does not count, nor does code that more than a tenth of the class shares, nor an answer of
fewer than ten statements. A feature that remains counts the more, the fewer students have it: if s of n
students have it, it counts log2(n / s) bits. The likeness of two answers is the share of their bits that both
have.

Short answers to the same exercise can be alike by chance. So there are two reasons for a flag:

- One answer is enough if the two share much code that hardly any other student has, or rare comments, texts
  or names.
- Else, several answers of the same two students have to be alike. For each of them, the share of all pairs
  of students whose answers are at least as much alike is an estimate of its probability p. The sum of
  log2(1 / p) has to exceed log2 of the number of pairs: then chance explains less than one such pair in the
  whole class.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from course_pkg.grading.flags.fingerprints import Fingerprint

STATEMENTS = 10  # an answer needs at least so many
COMMON = 0.1  # of the class: what more students share does not count
FEW = 3  # students who may share code, even in a small class
SMALL = 30  # students: in a smaller class, a feature counts as much as in a class of this size
ALIKE = 0.9  # the likeness of two answers that are nearly the same
SAME = 0.95  # the likeness of two answers if one answer is the only reason
OWN_CODE = 15  # features that these two share with at most one more student, if so
OWN_WORDS = 3  # comments, texts or names, in place of such features
MARGIN = 1.0  # bits
NOTHING = Fingerprint(0)
Couple = tuple[int, int]


@dataclass(frozen=True)
class Pair:
    """Two students, and the likeness of their answers, by the name of the answer."""

    first: int
    second: int
    likeness: Mapping[str, float]


class Similarity:
    """Compares the answers of a class: for each student, the fingerprints of the answers by their names."""

    def __init__(
        self, students: Sequence[Mapping[str, Fingerprint]], handed_out: Mapping[str, Fingerprint]
    ) -> None:
        names = sorted({name for answers in students for name in answers})
        self.exercises = {
            name: Exercise(
                {
                    number: answers[name]
                    for number, answers in enumerate(students)
                    if name in answers and answers[name].statements >= STATEMENTS
                },
                handed_out.get(name, NOTHING),
                len(students),
            )
            for name in names
        }
        self._size = len(students)

    def pairs(self) -> Iterator[Pair]:
        """Yield the pairs of students with nearly identical answers."""
        alike: dict[Couple, dict[str, float]] = {}
        for name, exercise in self.exercises.items():
            for couple, likeness in exercise.likeness.items():
                if likeness >= ALIKE:
                    alike.setdefault(couple, {})[name] = likeness
        threshold = math.log2(max(1, self._size * (self._size - 1) / 2)) + MARGIN
        for (first, second), found in sorted(alike.items()):
            bits = sum(self.exercises[name].surprise(likeness) for name, likeness in found.items())
            if bits > threshold or any(self.exercises[name].is_enough((first, second)) for name in found):
                yield Pair(first, second, found)


class Exercise:
    """The answers of a class to one exercise, by the number of the student."""

    def __init__(self, answers: Mapping[int, Fingerprint], given: Fingerprint, size: int) -> None:
        self._answers = answers
        self._having = Counter(feature for each in answers.values() for feature in (each.code | each.words))
        self._given = given.code | given.words
        self._size = max(size, SMALL)
        self._most = max(FEW, COMMON * size)

    def having(self, feature: str) -> int:
        """Return how many students have a feature."""
        return self._having[feature]

    def counts(self, feature: str) -> bool:
        """Return whether a feature counts: it was not handed out, and few students have it."""
        return feature not in self._given and self._having[feature] <= self._most

    @cached_property
    def likeness(self) -> dict[Couple, float]:
        """The likeness of each two answers that have anything in common."""
        return {
            (first, second): 2 * bits / (self._totals[first] + self._totals[second])
            for (first, second), bits in self._shared.items()
        }

    def likeness_of(self, one: Fingerprint, other: Fingerprint) -> float:
        """Return the similarity of two answers; they may also be answers that no student wrote."""
        total = self._bits(one.code) + self._bits(other.code)
        return 2 * self._bits(one.code & other.code) / total if total else 0.0

    def surprise(self, likeness: float) -> float:
        """Return log2(1 / p), where p is the fraction of all pairs whose similarity is at least this high."""
        as_much = len(self._ranked) - bisect_left(self._ranked, likeness - 1e-9)
        everybody = len(self._answers) * (len(self._answers) - 1) / 2
        return math.log2(everybody / max(1, as_much))

    def is_enough(self, couple: Couple) -> bool:
        """Return whether these two nearly identical answers need no other evidence."""
        first, second = (self._answers[number] for number in couple)
        words = self._rare(first.words & second.words)
        return words >= OWN_WORDS or (
            self.likeness[couple] >= SAME and self._rare(first.code & second.code) >= OWN_CODE
        )

    def _rare(self, features: frozenset[str]) -> int:
        """Return how many of these features hardly any student has."""
        return sum(self.counts(feature) and self.having(feature) <= FEW for feature in features)

    @cached_property
    def _code(self) -> dict[int, list[str]]:
        return {
            number: [feature for feature in each.code if self.counts(feature)]
            for number, each in self._answers.items()
        }

    @cached_property
    def _totals(self) -> dict[int, float]:
        return {number: self._bits(frozenset(features)) for number, features in self._code.items()}

    @cached_property
    def _shared(self) -> dict[Couple, float]:
        """The bits of each two answers that have anything in common."""
        holders: dict[str, list[int]] = {}
        for number, features in self._code.items():
            for feature in features:
                holders.setdefault(feature, []).append(number)
        shared: dict[Couple, float] = {}
        for feature, numbers in sorted(holders.items()):
            bits = self._weight(feature)
            for couple in combinations(numbers, 2):
                shared[couple] = shared.get(couple, 0.0) + bits
        return shared

    @cached_property
    def _ranked(self) -> list[float]:
        return sorted(self.likeness.values())

    def _weight(self, feature: str) -> float:
        return math.log2(self._size / max(self._having[feature], 2))

    def _bits(self, features: frozenset[str]) -> float:
        return sum(self._weight(feature) for feature in sorted(features) if self.counts(feature))
