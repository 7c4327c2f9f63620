"""Random inputs for a check; the same seed produces the same inputs."""

from __future__ import annotations

import random
import string
from collections.abc import Sequence
from typing import TypeVar

Item = TypeVar("Item")


class RandomInputs:
    """The random inputs of one run of a check."""

    def __init__(self, seed: str) -> None:
        self._random = random.Random(seed)  # noqa: S311 -- these numbers are not secrets
        self._words: list[str] = []

    def number(self, low: float, high: float, *, digits: int = 2) -> float:
        """Return a random number between the limits `low` and `high`, with at most `digits` decimals."""
        return round(self._random.uniform(low, high), digits)

    def numbers(self, count: int, low: float, high: float, *, digits: int = 2) -> list[float]:
        """Return a list of `count` different random numbers.

        If two numbers were equal, a program that confuses them could pass.
        """
        found: list[float] = []
        while len(found) < count:
            number = self.number(low, high, digits=digits)
            if number not in found:
                found.append(number)
        return found

    def integer(self, low: int, high: int) -> int:
        """Return a random integer between the limits `low` and `high`; the limits are possible results."""
        return self._random.randint(low, high)

    def integers(self, count: int, low: int, high: int) -> list[int]:
        """Return `count` different random integers from `low` to `high`, including both limits."""
        return self._random.sample(range(low, high + 1), count)

    def choice(self, items: Sequence[Item]) -> Item:
        """Return a random item of the sequence `items`."""
        return self._random.choice(items)

    def shuffled(self, items: Sequence[Item]) -> list[Item]:
        """Return the items in a random order."""
        return self._random.sample(items, len(items))

    def word(self, length: int = 6) -> str:
        """Return a random word; `length` is the number of its lower-case letters."""
        self._words.append("".join(self._random.choices(string.ascii_lowercase, k=length)))
        return self._words[-1]

    def made(self, text: str) -> bool:
        """Return whether `text` contains a random word.

        The title of an assertion must not contain a random word.
        """
        return any(word in text for word in self._words)
