"""The widgets for predictions: a question, a comparison, and a table.

The text/plain output of the widgets is the same for every student. Therefore, the outputs of two notebooks
can be compared. Only the widget shows the student's answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import ClassVar, TypedDict

from traitlets import Bool, Dict, List, Unicode

from course_pkg.panels.choices.model import ChoiceRecord, ChoiceStore
from course_pkg.panels.panel import PageMessage, Panel
from course_pkg.panels.prediction.model import Prediction, PredictionModel, PredictionStore
from course_pkg.panels.store import of_chapter

HERE = Path(__file__).parent


class _Row(TypedDict):
    question: str
    predicted: str
    actual: str
    state: str
    verdict: str


class _ChoiceRow(_Row):
    result: str
    fit: int
    cases: int


class ChapterPart(TypedDict):
    """A part of a chapter: its id, its state as text, and a symbol for the state."""

    check: str
    state: str
    mark: str


class ChapterRow(TypedDict):
    """The student's progress in a chapter: totals, parts, the next step, and messages about problems."""

    text: str
    parts: list[ChapterPart]
    next: str
    problems: list[str]


class _PredictionPanel(Panel):
    front_end: ClassVar[Path] = HERE / "prediction.js"
    style_sheet: ClassVar[Path] = HERE / "prediction.css"

    part = Unicode(help="question, comparison or summary").tag(sync=True)


class Question(_PredictionPanel):
    """A panel that asks a question before the student runs a program.

    The student selects one of the choices; if `choices` is empty, the student types any text.
    """

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
        """Store `actual`, the real result, and return a panel with the prediction and the result."""
        record = self._model.compare(actual)
        self.publish(compared=True)
        return Comparison(record)

    def received(self, kind: str, content: PageMessage) -> None:
        """Store an answer."""
        if kind == "answer":
            record = self._model.answer(str(content["answer"]))
            self.publish(answer=record.answer)

    def __repr__(self) -> str:
        return f"predict({self._model.key!r})"


class Comparison(_PredictionPanel):
    """A panel that shows the prediction next to the real result."""

    record = Dict().tag(sync=True)

    def __init__(self, record: Prediction) -> None:
        super().__init__()
        self._actual = record.actual
        self.publish(part="comparison", record=_row(record))

    def __repr__(self) -> str:
        return f"What really happened: {self._actual}"


class Predictions(_PredictionPanel):
    """A table of the predictions and choices of a chapter; `row` is the student's progress in the chapter."""

    chapter = Unicode().tag(sync=True)
    records = List(Dict()).tag(sync=True)
    row = Dict(help="the progress in the chapter, if there is one").tag(sync=True)

    def __init__(
        self,
        chapter: str = "",
        *,
        store: PredictionStore | None = None,
        choices: ChoiceStore | None = None,
        row: ChapterRow | None = None,
    ) -> None:
        super().__init__()
        predicted = of_chapter((store or PredictionStore()).read().values(), chapter)
        chosen = of_chapter((choices or ChoiceStore()).read().values(), chapter)
        records = [*map(_row, predicted), *map(_choice_row, chosen)]
        self.publish(part="summary", chapter=chapter, records=records, row=dict(row or {}))

    def __repr__(self) -> str:
        return f"predictions({self.chapter!r})" if self.chapter else "predictions()"


def predict(key: str, question: str, choices: Sequence[str] = ()) -> Question:
    """Return a panel that asks `question` before a program runs.

    If `choices` is empty, the student types any text.

    `key` consists of a chapter and a name, such as "05.reply_none".
    """
    return Question(key, question, choices)


def _row(record: Prediction) -> _Row:
    if not record.compared:
        state = "open"
    elif not record.first:
        state = "late"
    else:
        state = "right" if record.right else "wrong"
    return {
        "question": record.question,
        "predicted": record.first if record.compared else record.answer,
        "actual": record.actual,
        "state": state,
        "verdict": record.verdict,
    }


def _choice_row(record: ChoiceRecord) -> _ChoiceRow:
    compared, of = bool(record.compared), len(record.first)
    return {
        "question": record.question,
        "predicted": f"{of if compared else len(record.chosen)} of {record.cases} cases have an answer",
        "actual": f"{record.fit} fit" if compared else "",
        "state": "decided" if compared else "open",
        "result": f"{record.fit} of {of} fit" if compared else "",
        "fit": record.fit,
        "cases": of,
        "verdict": record.standing,
    }
