"""Commit to an answer, compare it with what happened: no page, no kernel."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from datetime import datetime, timezone

from course_pkg.panels.prediction.store import PredictionStore, Record
from course_pkg.panels.store import Row


class PredictionModel:
    """One question and the record of its answer."""

    def __init__(self, key: str, question: str, choices: Iterable[str], store: PredictionStore) -> None:
        self.key = key
        self.question = question
        self.choices = tuple(choices)
        self._store = store

    @property
    def record(self) -> Record:
        """What is kept now; a fresh record when nothing is."""
        return self._store.read().get(self.key, Record(self.key, self.question))

    def answer(self, answer: str) -> Record:
        """Keep an answer; an empty one takes it back."""
        answer = answer.strip()
        return self._keep(
            replace(self.record, question=self.question, answer=answer, answered=_now() if answer else "")
        )

    def compare(self, actual: object) -> Record:
        """Keep what really happened; the answer that stands now is the prediction for good."""
        record = self.record
        if record.compared and record.actual == str(actual):
            return record
        return self._keep(
            replace(record, question=self.question, actual=str(actual), compared=_now(), first=record.answer)
        )

    def _keep(self, record: Record) -> Record:
        self._store.write(record)
        return record


def right(record: Record) -> bool:
    """Whether the prediction came true: equal texts, or equal numbers."""
    predicted, actual = record.first.strip().casefold(), record.actual.strip().casefold()
    try:
        return float(predicted) == float(actual)
    except ValueError:
        return predicted == actual


def verdict(record: Record) -> str:
    """Return the comparison in one sentence."""
    if not record.compared:
        return "Not compared yet." if record.answer else "No prediction yet."
    if not record.first:
        late = f" Your answer {record.answer!r} came after the result." if record.answer else ""
        return f"You had made no prediction.{late}"
    changed = f" You changed it to {record.answer!r} after the result." if record.changed_after else ""
    said = "and so it was" if right(record) else "and it was otherwise: find out why before you go on"
    return f"You predicted {record.first!r}, {said}.{changed}"


def summary(records: Iterable[Row], chapter: str) -> list[Row]:
    """Return the records of a chapter (`05` has `05.reply_none`), or all for "", by their keys."""
    chosen = (each for each in records if not chapter or each.key.startswith(f"{chapter}."))
    return sorted(chosen, key=lambda each: each.key)


def _now() -> str:
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
