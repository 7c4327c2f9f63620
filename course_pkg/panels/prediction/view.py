"""Predictions as widgets.

What they say in text/plain is the same for every student, so that notebooks can be compared; the
personal part is in the widget alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

from traitlets import Bool, Dict, List, Unicode

from course_pkg.panels.choices.model import standing
from course_pkg.panels.choices.store import ChoiceRecord, ChoiceStore
from course_pkg.panels.panel import Panel
from course_pkg.panels.prediction.model import PredictionModel, right, summary, verdict
from course_pkg.panels.prediction.store import PredictionStore, Record

HERE = Path(__file__).parent


class _Predict(Panel):
    front_end: ClassVar[Path] = HERE / "prediction.js"
    style_sheet: ClassVar[Path] = HERE / "prediction.css"

    part = Unicode(help="question, comparison or summary").tag(sync=True)


class Prediction(_Predict):
    """A question to answer before the run: one of `choices`, or free text when there are none."""

    question = Unicode().tag(sync=True)
    choices = List(Unicode()).tag(sync=True)
    answer = Unicode().tag(sync=True)
    compared = Bool().tag(sync=True)

    def __init__(
        self, key: str, question: str, choices: Sequence[str] = (), *, store: PredictionStore | None = None
    ) -> None:
        super().__init__()
        self._model = PredictionModel(key, question, choices, store or PredictionStore())
        record = self._model.record
        self.publish(
            part="question",
            question=question,
            choices=list(choices),
            answer=record.answer,
            compared=bool(record.compared),
        )

    def compare(self, actual: object) -> Comparison:
        """Set what was predicted beside what really happened, and keep both."""
        record = self._model.compare(actual)
        self.publish(compared=True)
        return Comparison(record)

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """Keep an answer."""
        if kind == "answer":
            record = self._model.answer(str(content["answer"]))
            self.publish(answer=record.answer)

    def __repr__(self) -> str:
        return f"predict({self._model.key!r})"


class Comparison(_Predict):
    """What was predicted and what happened."""

    record = Dict().tag(sync=True)

    def __init__(self, record: Record) -> None:
        super().__init__()
        self._actual = record.actual
        self.publish(part="comparison", record=_shown(record))

    def __repr__(self) -> str:
        return f"What really happened: {self._actual}"


class Predictions(_Predict):
    """The predictions and choices of a chapter in a table."""

    chapter = Unicode().tag(sync=True)
    records: List[Any] = List().tag(sync=True)

    def __init__(
        self, chapter: str = "", *, store: PredictionStore | None = None, choices: ChoiceStore | None = None
    ) -> None:
        super().__init__()
        predicted = summary((store or PredictionStore()).read().values(), chapter)
        decided = summary((choices or ChoiceStore()).read().values(), chapter)
        records = [*map(_shown, predicted), *map(_decided, decided)]
        self.publish(part="summary", chapter=chapter, records=records)

    def __repr__(self) -> str:
        return f"predictions({self.chapter!r})" if self.chapter else "predictions()"


def predict(key: str, question: str, choices: Sequence[str] = ()) -> Prediction:
    """Ask for an answer before the run; `key` is `chapter.name`. Without choices it is free text."""
    return Prediction(key, question, choices)


def predictions(chapter: str = "") -> Predictions:
    """Return the table of what was predicted and what happened, for one chapter or for all."""
    return Predictions(chapter)


def _shown(record: Record) -> dict[str, Any]:
    state = (
        "open"
        if not record.compared
        else "late"
        if not record.first
        else "right"
        if right(record)
        else "wrong"
    )
    return {
        "question": record.question,
        "predicted": record.first if record.compared else record.answer,
        "actual": record.actual,
        "state": state,
        "verdict": verdict(record),
    }


def _decided(record: ChoiceRecord) -> dict[str, Any]:
    seen = bool(record.compared)
    return {
        "question": record.question,
        "predicted": f"{len(record.first if seen else record.chosen)} of {record.cases} cases decided",
        "actual": f"{record.fit} fit" if seen else "",
        "state": "decided" if seen else "open",
        "result": f"{record.fit} of {len(record.first)} fit" if seen else "",
        "fit": record.fit,
        "cases": len(record.first),
        "verdict": standing(record),
    }
