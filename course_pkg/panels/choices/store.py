"""What is kept of the choices for a set of cases."""

from __future__ import annotations

from dataclasses import dataclass, field

from course_pkg.panels.store import Store


@dataclass(frozen=True)
class ChoiceRecord:
    """One question with many cases; `chosen` and `first` hold an option by the case's text.

    `first` is what stood when the reasons were first shown, at `compared` (ISO 8601, UTC, "" for not yet):
    it is what counts, and `fit` of its `cases` choices were the expected ones. `shown` is whether the
    reasons are in sight now.
    """

    key: str
    question: str
    cases: int = 0
    chosen: dict[str, str] = field(default_factory=dict)
    first: dict[str, str] = field(default_factory=dict)
    fit: int = 0
    compared: str = ""
    shown: bool = False


class ChoiceStore(Store[ChoiceRecord]):
    """The records in one file, by key."""

    row = ChoiceRecord
    file = "choices.json"
    what = "choices"
