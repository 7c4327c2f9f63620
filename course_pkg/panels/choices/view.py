"""Choices as a widget; text/plain is the same for every student."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, ClassVar

from traitlets import Dict, List, Unicode

from course_pkg.panels.choices.model import ChoicesModel
from course_pkg.panels.choices.store import ChoiceStore
from course_pkg.panels.panel import Panel

HERE = Path(__file__).parent


class Choices(Panel):
    """A question about several cases: one of the same options for each, then the reasons.

    What is expected, and why, goes to the page only when it is to be shown.
    """

    front_end: ClassVar[Path] = HERE / "choices.js"
    style_sheet: ClassVar[Path] = HERE / "choices.css"

    question = Unicode().tag(sync=True)
    options = List(Unicode()).tag(sync=True)
    cases = List(Unicode()).tag(sync=True)
    chosen = List(Unicode(), help="an option for each case, or an empty text").tag(sync=True)
    verdicts: List[Any] = List(help="for each case whether it fits, and why").tag(sync=True)
    first = Dict(
        help="how the first choices stood: how many fit, of how many, and whether they are in sight now"
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

    def received(self, kind: str, content: dict[str, Any]) -> None:
        """Answer a click."""
        if kind == "choose":
            self._model.choose(int(content["case"]), str(content["option"]))
        elif kind == "compare":
            self._model.compare()
        elif kind == "again":
            self._model.again()
        self.publish(**self._state())

    def __repr__(self) -> str:
        return f"choose({self._model.key!r})"

    def _state(self) -> dict[str, Any]:
        record = self._model.record
        first = {"fit": record.fit, "of": len(record.first), "now": record.chosen == record.first}
        verdicts = [asdict(verdict) for verdict in self._model.verdicts]
        return {"chosen": self._model.chosen, "verdicts": verdicts, "first": first if record.compared else {}}


def choose(key: str, question: str, options: Sequence[str], cases: Iterable[tuple[str, str, str]]) -> Choices:
    """Ask for one of `options` in each of the cases; a case is (case, answer, reason).

    `key` is `chapter.name`. Words between backticks are shown as code. Raises NotAChoice.
    """
    return Choices(key, question, options, cases)
