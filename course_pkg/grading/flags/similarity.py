"""Finds students with identical or nearly identical code. Code that many students have is ignored.

Three kinds of code are ignored: code that students get with the exercise, code that more than a tenth of the
class has, and answers with fewer than ten statements. The rest of the code is divided into features (see
fingerprints.py), and each feature has a weight. If s of n students have a feature, its weight is log2(n / s)
bits. The similarity of two answers is twice the weight of their common features, divided by the sum of the
weights of both answers.

Two short answers to the same exercise can be similar by chance. Therefore, a pair of students is flagged only
in one of two cases. In the first case, the pair has one nearly identical answer with enough rare features, or
with enough rare comments, strings and names. Here, something is rare if at most one other student has it. In
the second case, the pair has several nearly identical answers. For each of these answers, p is the fraction
of all pairs of students with answers that are at least as similar. This fraction is an estimate of the
probability that the similarity is a coincidence. A pair is flagged if the sum of log2(1 / p) is more than
log2(number of pairs) + MARGIN. On average, the course then flags fewer than one pair of a class by
coincidence.
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

STATEMENTS = 10  # An answer with fewer statements than this is not compared.
COMMON = 0.1  # Code is ignored if more than this fraction of the class has it.
FEW = 3  # Even in a small class, code is compared if at most this many students have it.
SMALL = 30  # For a smaller class, the weights are computed as for a class of this size.
ALIKE = 0.9  # Nearly identical answers have at least this similarity.
SAME = 0.95  # If only one answer causes a flag, its similarity must be at least this high.
# A rare feature of the code occurs in the answers of the pair, and in the answer of at most one other
# student. One answer is enough to flag a pair if the two answers share at least `OWN_CODE` rare features.
OWN_CODE = 15
# One answer is also enough to flag a pair if the two answers share at least `OWN_WORDS` comments, strings or
# names, and at most one other student has them.
OWN_WORDS = 3
MARGIN = 1.0  # The margin is in bits.
NOTHING = Fingerprint(0)
Couple = tuple[int, int]


@dataclass(frozen=True)
class Pair:
    """Two students with nearly identical answers; `likeness` is a mapping from answer to similarity."""

    first: int
    second: int
    likeness: Mapping[str, float]


class Similarity:
    """Compares the answers of a class.

    For each student, `students` contains a dictionary: the keys are the names of the answers, and the values
    are the fingerprints of the answers.
    """

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
    """The answers of a class to one exercise; the keys of `answers` are the numbers of the students."""

    def __init__(self, answers: Mapping[int, Fingerprint], given: Fingerprint, size: int) -> None:
        self._answers = answers
        self._having = Counter(feature for each in answers.values() for feature in (each.code | each.words))
        self._given = given.code | given.words
        self._size = max(size, SMALL)
        self._most = max(FEW, COMMON * size)

    def having(self, feature: str) -> int:
        """Return the number of students who have a feature."""
        return self._having[feature]

    def counts(self, feature: str) -> bool:
        """Return whether a feature is compared: few students have it, and the exercise cell does not."""
        return feature not in self._given and self._having[feature] <= self._most

    @cached_property
    def likeness(self) -> dict[Couple, float]:
        """The similarity of each pair of answers that have a feature in common."""
        return {
            (first, second): 2 * bits / (self._totals[first] + self._totals[second])
            for (first, second), bits in self._shared.items()
        }

    def likeness_of(self, one: Fingerprint, other: Fingerprint) -> float:
        """Return the similarity of two answers."""
        total = self._bits(one.code) + self._bits(other.code)
        return 2 * self._bits(one.code & other.code) / total if total else 0.0

    def surprise(self, likeness: float) -> float:
        """Return log2(1 / p), where p is the fraction of all pairs with at least this similarity."""
        as_much = len(self._ranked) - bisect_left(self._ranked, likeness - 1e-9)
        everybody = len(self._answers) * (len(self._answers) - 1) / 2
        return math.log2(everybody / max(1, as_much))

    def is_enough(self, couple: Couple) -> bool:
        """Return whether one nearly identical answer is enough to flag a pair of students."""
        first, second = (self._answers[number] for number in couple)
        words = self._rare(first.words & second.words)
        return words >= OWN_WORDS or (
            self.likeness[couple] >= SAME and self._rare(first.code & second.code) >= OWN_CODE
        )

    def _rare(self, features: frozenset[str]) -> int:
        """Return the number of features in `features` that at most `FEW` students have."""
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
        """The total weight in bits of the common features of each pair of answers."""
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
