"""The widget of the choices panel; its text/plain output is the same for every student."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import ClassVar, TypedDict

from traitlets import Dict, List, Unicode

from course_pkg.panels.choices.cases import CASES, OPTIONS, QUESTION
from course_pkg.panels.choices.model import ChoicesModel, ChoiceStore
from course_pkg.panels.panel import PageMessage, Panel

HERE = Path(__file__).parent


class _First(TypedDict, total=False):
    """The first choices.

    `of` is the number of first choices, and `fit` is the number of first choices that were expected options.

    `now` is True if the current choices are the same as the first choices.
    """

    fit: int
    of: int
    now: bool


class _State(TypedDict):
    chosen: list[str]
    verdicts: list[dict[str, str | bool]]
    first: _First


class Choices(Panel):
    """A table of cases: the student chooses an option for each case, and then reads the reasons.

    The page receives the expected options only when the panel shows the reasons.
    """

    front_end: ClassVar[Path] = HERE / "choices.js"
    style_sheet: ClassVar[Path] = HERE / "choices.css"

    question = Unicode().tag(sync=True)
    options = List(Unicode()).tag(sync=True)
    cases = List(Unicode()).tag(sync=True)
    chosen = List(Unicode(), help="the chosen option for each case, or an empty string").tag(sync=True)
    verdicts = List(Dict(), help="whether the choice fits and why, for each case").tag(sync=True)
    first = Dict(
        help=(
            "the number of first choices, the number of those that fit, and whether they are still the "
            "current choices"
        )
    ).tag(sync=True)

    def __init__(
        self,
        key: str,
        question: str,
        options: Sequence[str],
        cases: Iterable[tuple[str, str, str]],
        *,
        store: ChoiceStore | None = None,
    ) -> None:
        super().__init__()
        self._model = ChoicesModel(key, question, options, cases, store or ChoiceStore())
        self.publish(
            question=question,
            options=list(self._model.options),
            cases=[case.text for case in self._model.cases],
            **self._state(),
        )

    def received(self, kind: str, content: PageMessage) -> None:
        """Handle a click on the page."""
        if kind == "choose":
            self._model.choose(int(content["case"]), str(content["option"]))
        elif kind == "compare":
            self._model.compare()
        elif kind == "again":
            self._model.again()
        self.publish(**self._state())

    def __repr__(self) -> str:
        return f"choose({self._model.key!r})"

    def _state(self) -> _State:
        record = self._model.record
        first: _First = {"fit": record.fit, "of": len(record.first), "now": record.chosen == record.first}
        verdicts = [asdict(verdict) for verdict in self._model.verdicts]
        return {"chosen": self._model.chosen, "verdicts": verdicts, "first": first if record.compared else {}}


def choose(
    key: str,
    question: str = QUESTION,
    options: Sequence[str] = OPTIONS,
    cases: Iterable[tuple[str, str, str]] = CASES,
) -> Choices:
    """Return a panel in which the student chooses one of the options for each case.

    `key` is `chapter.name`. Each case is a tuple (text, expected option, reason). The panel shows text
    between backticks as code. By default, the panel has ten cases with the options topic, service and action.
    Raises NotAChoice if an answer is not an option, or if two cases have the same text.
    """
    return Choices(key, question, options, cases)
