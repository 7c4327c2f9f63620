"""The model of the choices panel: the student chooses an option for each case, and then reads the reasons."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from course_pkg.errors import NotAChoice
from course_pkg.panels.store import Store
from course_pkg.state import now


@dataclass(frozen=True)
class Case:
    """A situation, the expected option for this situation, and the reason."""

    text: str
    answer: str
    reason: str


@dataclass(frozen=True)
class Verdict:
    """The result for one case: whether the student chose the expected option."""

    chosen: str
    fits: bool
    answer: str
    reason: str


@dataclass(frozen=True)
class ChoiceRecord:
    """The student's choices in one table of cases.

    In `chosen` and `first`, the keys are the texts of the cases, and the values are the chosen options.

    `compared` is the time (ISO 8601 in UTC) when the reasons were first shown; it is "" before that time.
    `first` contains the choices at the time `compared`; later choices do not change `first`. `fit` is the
    number of expected options in `first`. `shown` is True while the panel shows the reasons.
    """

    key: str
    question: str
    cases: int = 0
    chosen: dict[str, str] = field(default_factory=dict)
    first: dict[str, str] = field(default_factory=dict)
    fit: int = 0
    compared: str = ""
    shown: bool = False

    @property
    def standing(self) -> str:
        """A sentence that states how many cases have a choice.

        After compare(), it states how many of the first choices were expected options.
        """
        if not self.compared:
            return f"{len(self.chosen)} of {self.cases} cases have an answer."
        return f"{self.fit} of {len(self.first)} of your first choices fit."


class ChoiceStore(Store[ChoiceRecord]):
    """A file with the student's choices: one ChoiceRecord for each table of cases.

    The file `choices.json` belongs to the first edition of the course.
    """

    record = ChoiceRecord
    file = "choices-2.json"
    what = "choices"


class ChoicesModel:
    """The cases with their options, and the record of the student's choices.

    Raises NotAChoice if the answer of a case is not among the options, or if two cases have the same text.
    """

    def __init__(
        self,
        key: str,
        question: str,
        options: Iterable[str],
        cases: Iterable[tuple[str, str, str]],
        store: ChoiceStore,
    ) -> None:
        self.key = key
        self.question = question
        self.options = tuple(options)
        self.cases = tuple(_case(key, each) for each in cases)
        self._store = store
        self._check()

    @property
    def record(self) -> ChoiceRecord:
        """The stored record, or an empty record if nothing is stored."""
        fresh = ChoiceRecord(self.key, self.question)
        return replace(self._store.read().get(self.key, fresh), question=self.question, cases=len(self.cases))

    @property
    def chosen(self) -> list[str]:
        """The chosen option of each case, or "" for a case without a choice."""
        kept = self.record.chosen
        return [kept[case.text] if kept.get(case.text) in self.options else "" for case in self.cases]

    @property
    def verdicts(self) -> list[Verdict]:
        """A verdict for each case if the reasons are shown; otherwise an empty list."""
        if not self.record.shown:
            return []
        pairs = zip(self.cases, self.chosen, strict=True)
        return [Verdict(chosen, chosen == case.answer, case.answer, case.reason) for case, chosen in pairs]

    def choose(self, number: int, option: str) -> ChoiceRecord:
        """Store the choice for case `number` (from 0); do nothing if the panel shows the reasons."""
        record = self.record
        if record.shown or option not in self.options:
            return record
        return self._store.write(replace(record, chosen={**record.chosen, self.cases[number].text: option}))

    def compare(self) -> ChoiceRecord:
        """Show the reasons if the student has chosen an option for every case.

        The first call also stores the choices in the field `first` of the record.
        """
        record = self.record
        if "" in self.chosen:
            return record
        if not record.compared:
            decided = dict(zip((case.text for case in self.cases), self.chosen, strict=True))
            fit = sum(decided[case.text] == case.answer for case in self.cases)
            record = replace(record, chosen=decided, first=decided, fit=fit, compared=now())
        return self._store.write(replace(record, shown=True))

    def again(self) -> ChoiceRecord:
        """Hide the reasons, and delete the current choices; the record's field `first` does not change."""
        return self._store.write(replace(self.record, chosen={}, shown=False))

    def _check(self) -> None:
        texts = [case.text for case in self.cases]
        for number, case in enumerate(self.cases, start=1):
            if case.answer not in self.options:
                raise NotAChoice(
                    f"choose({self.key!r}): the answer {case.answer!r} of case {number} is not "
                    f"one of the options {', '.join(map(repr, self.options))}."
                )
            if texts.count(case.text) > 1:
                raise NotAChoice(
                    f"choose({self.key!r}): the case {case.text!r} is given twice. Remove one "
                    "of the two cases."
                )


def _case(key: str, given: tuple[str, str, str]) -> Case:
    try:
        text, answer, reason = given
    except (TypeError, ValueError) as error:
        raise NotAChoice(
            f"choose({key!r}): {given!r} is not a case. Write each case as (case, answer, reason)."
        ) from error
    return Case(str(text), str(answer), str(reason))
