"""Find request ids that are not unique because each program that runs the code creates the same ids."""

from __future__ import annotations

import re
from collections.abc import Sequence

SMALL = 100_000  # A number below SMALL comes from a counter; numbers from a clock are larger.


def from_a_counter(ids: Sequence[str]) -> bool:
    """Return whether the ids differ only in one small number, such as "p1" and "p2"."""
    numbers = [re.findall(r"\d+", each) for each in ids]
    texts = {re.sub(r"\d+", "", each) for each in ids}
    return len(texts) == 1 and all(len(each) == 1 and int(each[0]) < SMALL for each in numbers)
