"""Decide many cases, then see the reasons: no page, no kernel."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from datetime import datetime, timezone

from course_pkg.errors import NotAChoice
from course_pkg.panels.choices.store import ChoiceRecord, ChoiceStore


@dataclass(frozen=True)
class Case:
    """A situation, the option that is expected for it, and why."""

    text: str
    answer: str
    reason: str


@dataclass(frozen=True)
class Verdict:
    """Whether the option chosen for a case is the expected one."""

    chosen: str
    fits: bool
    answer: str
    reason: str


class ChoicesModel:
    """One question about several cases, and the record of what was chosen.

    Raises NotAChoice when a case expects what is no option, or stands there twice.
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
        """What is kept now; a fresh record when nothing is."""
        fresh = ChoiceRecord(self.key, self.question)
        return replace(self._store.read().get(self.key, fresh), question=self.question, cases=len(self.cases))

    @property
    def chosen(self) -> list[str]:
        """The option chosen for each case, "" where none is."""
        kept = self.record.chosen
        return [kept[case.text] if kept.get(case.text) in self.options else "" for case in self.cases]

    @property
    def verdicts(self) -> list[Verdict]:
        """A verdict for each case once the reasons are shown; none before."""
        if not self.record.shown:
            return []
        pairs = zip(self.cases, self.chosen, strict=True)
        return [Verdict(chosen, chosen == case.answer, case.answer, case.reason) for case, chosen in pairs]

    def choose(self, number: int, option: str) -> ChoiceRecord:
        """Choose for case `number`, from 0; not while the reasons are shown."""
        record = self.record
        if record.shown or option not in self.options:
            return record
        return self._keep(replace(record, chosen={**record.chosen, self.cases[number].text: option}))

    def compare(self) -> ChoiceRecord:
        """Show the reasons, once every case is decided; the first time counts."""
        record = self.record
        if "" in self.chosen:
            return record
        if not record.compared:
            decided = dict(zip((case.text for case in self.cases), self.chosen, strict=True))
            fit = sum(decided[case.text] == case.answer for case in self.cases)
            record = replace(record, chosen=decided, first=decided, fit=fit, compared=_now())
        return self._keep(replace(record, shown=True))

    def again(self) -> ChoiceRecord:
        """Take the reasons out of sight and begin with an empty sheet; what counts stays."""
        return self._keep(replace(self.record, chosen={}, shown=False))

    def _keep(self, record: ChoiceRecord) -> ChoiceRecord:
        self._store.write(record)
        return record

    def _check(self) -> None:
        texts = [case.text for case in self.cases]
        for number, case in enumerate(self.cases, start=1):
            if case.answer not in self.options:
                raise NotAChoice(
                    f"choose({self.key!r}): case {number} expects {case.answer!r}, which is none of the "
                    f"options {', '.join(map(repr, self.options))}."
                )
            if texts.count(case.text) > 1:
                raise NotAChoice(
                    f"choose({self.key!r}): the case {case.text!r} stands there twice. Give it once."
                )


def _case(key: str, given: tuple[str, str, str]) -> Case:
    try:
        text, answer, reason = given
    except (TypeError, ValueError) as error:
        raise NotAChoice(f"choose({key!r}): {given!r} is no case. Give (case, answer, reason).") from error
    return Case(str(text), str(answer), str(reason))


def standing(record: ChoiceRecord) -> str:
    """Return how the choices stand, in one sentence."""
    if not record.compared:
        return f"{len(record.chosen)} of {record.cases} cases decided."
    return f"{record.fit} of {len(record.first)} of your first choices fit."


def _now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
