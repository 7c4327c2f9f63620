"""The model of a prediction: the student's answer before a program runs, and the real result."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from course_pkg.panels.store import Store
from course_pkg.state import now


@dataclass(frozen=True)
class Prediction:
    """A prediction: the student's answer and, after the comparison, the real result.

    `answered` and `compared` are times (ISO 8601 in UTC), or "" before the answer and the comparison.
    `answer` is the latest answer. `first` is the answer at the time of the comparison. If `answer` differs
    from `first`, the student changed the answer after the comparison.
    """

    key: str
    question: str
    answer: str = ""
    answered: str = ""
    actual: str = ""
    compared: str = ""
    first: str = ""

    @property
    def changed_after(self) -> bool:
        """Whether the student gave or changed the answer after the result was known."""
        return bool(self.compared and self.answer != self.first)

    @property
    def right(self) -> bool:
        """Whether the prediction equals the result, either as a string or as a number."""
        predicted, actual = self.first.strip().casefold(), self.actual.strip().casefold()
        try:
            return float(predicted) == float(actual)
        except ValueError:
            return predicted == actual

    @property
    def verdict(self) -> str:
        """The result of the comparison in one sentence."""
        if not self.compared:
            return "Not compared yet." if self.answer else "No prediction yet."
        if not self.first:
            late = f" Your answer {self.answer!r} came after the result." if self.answer else ""
            return f"You made no prediction.{late}"
        changed = (
            f" You changed your answer to {self.answer!r} after the result." if self.changed_after else ""
        )
        different = "but the result is different. Find out why before you continue"
        return f"You predicted {self.first!r}, {'and this happened' if self.right else different}.{changed}"


class PredictionStore(Store[Prediction]):
    """A file with the student's predictions: one Prediction for each key.

    The file `predictions.json` belongs to the first edition of the course, which had other chapter numbers.
    """

    record = Prediction
    file = "predictions-2.json"
    what = "predictions"


class PredictionModel:
    """A question with its choices, and the student's stored prediction."""

    def __init__(self, key: str, question: str, choices: Iterable[str], store: PredictionStore) -> None:
        self.key = key
        self.question = question
        self.choices = tuple(choices)
        self._store = store

    @property
    def record(self) -> Prediction:
        """The stored prediction, or an empty prediction if nothing is stored."""
        return self._store.read().get(self.key, Prediction(self.key, self.question))

    def answer(self, answer: str) -> Prediction:
        """Store an answer; an empty answer deletes the previous answer."""
        answer = answer.strip()
        answered = now() if answer else ""
        return self._store.write(
            replace(self.record, question=self.question, answer=answer, answered=answered)
        )

    def compare(self, actual: object) -> Prediction:
        """Store `actual`, the real result; the current answer is stored as `first`."""
        record = self.record
        if record.compared and record.actual == str(actual):
            return record
        return self._store.write(
            replace(record, question=self.question, actual=str(actual), compared=now(), first=record.answer)
        )
