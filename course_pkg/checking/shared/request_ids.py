"""Find request ids that are not unique because each program that runs the code creates the same ids."""

from __future__ import annotations

import re
from collections.abc import Sequence

SMALL = 100_000  # A number below SMALL comes from a counter; numbers from a clock are larger.
NUMBERED = 100  # A constant number below NUMBERED is a part of a name, such as "shop1".


def from_a_counter(ids: Sequence[str]) -> bool:
    """Return whether the ids differ only in one small number, such as "shop1-7" and "shop1-8"."""
    texts = {re.sub(r"\d+", "0", each) for each in ids}
    if len(texts) != 1:
        return False
    columns = [
        set(map(int, column)) for column in zip(*(re.findall(r"\d+", each) for each in ids), strict=True)
    ]
    counted = columns if len(columns) == 1 else [column for column in columns if len(column) > 1]
    names = [column for column in columns if column not in counted]
    return len(counted) == 1 and max(counted[0]) < SMALL and all(max(name) < NUMBERED for name in names)
