"""Choices: decided case by case, compared with reasons, the first time kept."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import NotAChoice, PredictionsBroken
from course_pkg.panels.choices.model import ChoicesModel
from course_pkg.panels.choices.store import ChoiceStore
from course_pkg.panels.choices.view import Choices
from course_pkg.panels.prediction.store import PredictionStore
from course_pkg.panels.prediction.view import Predictions

OPTIONS = ("a topic", "a service")
CASES = [
    ("Joint values, 100 times a second", "a topic", "A lost one is replaced at once."),
    ("One picture, on demand", "a service", "Somebody waits for it."),
    ("`/cmd_vel`", "a topic", "It is a stream."),
]


@pytest.fixture
def store(tmp_path: Path) -> ChoiceStore:
    """Keep choices in a folder that is not there yet."""
    return ChoiceStore(tmp_path / "state" / "choices.json")


@pytest.fixture
def model(store: ChoiceStore) -> ChoicesModel:
    """Ask about three cases of chapter 03."""
    return ChoicesModel("03.cases", "Which fits?", OPTIONS, CASES, store)


def decide(model: ChoicesModel, *options: str) -> None:
    """Choose for each case."""
    for number, option in enumerate(options):
        model.choose(number, option)


def test_a_choice_outlives_the_kernel(model: ChoicesModel, store: ChoiceStore) -> None:
    """What was chosen is there for a model made later, and may still be changed."""
    decide(model, "a topic", "a topic")
    again = ChoicesModel("03.cases", "Which fits?", OPTIONS, CASES, ChoiceStore(store.path))
    assert again.chosen == ["a topic", "a topic", ""]
    again.choose(1, "a service")
    assert model.chosen == ["a topic", "a service", ""]


def test_reasons_stay_hidden_until_every_case_is_decided(model: ChoicesModel) -> None:
    """Whoever has not committed to an answer sees none."""
    decide(model, "a topic", "a topic")
    model.compare()
    assert model.verdicts == []
    model.choose(2, "a topic")
    model.compare()
    assert [verdict.fits for verdict in model.verdicts] == [True, False, True]
    assert model.verdicts[1].answer == "a service"
    assert model.verdicts[1].reason == "Somebody waits for it."


def test_what_is_compared_stays_as_it_is(model: ChoicesModel) -> None:
    """While the reasons are in sight, a choice is no choice any more."""
    decide(model, *["a topic"] * 3)
    model.compare()
    model.choose(1, "a service")
    assert model.chosen == ["a topic"] * 3


def test_the_first_time_counts(model: ChoicesModel) -> None:
    """A second try is possible and shown; what is kept of the first does not change."""
    decide(model, "a topic", "a topic", "a service")
    assert model.compare().fit == 1
    assert model.again().shown is False
    assert model.chosen == ["", "", ""]
    decide(model, "a topic", "a service", "a topic")
    record = model.compare()
    assert all(verdict.fits for verdict in model.verdicts)
    assert (record.fit, list(record.first.values())) == (1, ["a topic", "a topic", "a service"])


def test_a_changed_case_is_open_again(model: ChoicesModel, store: ChoiceStore) -> None:
    """A choice belongs to the words of its case and to an option that is still there."""
    decide(model, *["a topic"] * 3)
    others = [("Another case", "a topic", "Because."), CASES[1], CASES[2]]
    assert ChoicesModel("03.cases", "?", OPTIONS, others, store).chosen == ["", "a topic", "a topic"]
    fewer = ("a service", "an action")
    assert ChoicesModel("03.cases", "?", fewer, CASES[1:2], store).chosen == [""]


@pytest.mark.parametrize(
    ("cases", "stretch"),
    [
        ([("One", "a topci", "So.")], "case 1 expects 'a topci'"),
        ([CASES[0], CASES[0]], "stands there twice"),
        ([("One", "a topic")], r"Give \(case, answer, reason\)"),
    ],
)
def test_a_slip_of_the_author_is_named(
    cases: list[tuple[str, str, str]], stretch: str, store: ChoiceStore
) -> None:
    """A question that nobody can answer right is not asked."""
    with pytest.raises(NotAChoice, match=stretch):
        ChoicesModel("03.cases", "?", OPTIONS, cases, store)


def test_a_broken_file_says_which_and_what_to_do(store: ChoiceStore) -> None:
    """A file that the course did not write is left alone and named."""
    store.path.parent.mkdir()
    store.path.write_text('{"03.cases": {"colour": 3}}')
    with pytest.raises(PredictionsBroken, match=r"choices\.json does not hold choices.*Move the file away"):
        store.read()


def test_a_page_learns_the_answers_only_when_they_are_shown(store: ChoiceStore) -> None:
    """Neither the widget's state nor its text holds an answer before the button is pressed."""
    panel = Choices("03.cases", "Which fits?", OPTIONS, CASES, store=store)
    assert "Somebody waits" not in str(panel.get_state())
    for number in range(3):
        panel.received("choose", {"case": number, "option": "a topic"})
    panel.received("compare", {})
    assert panel.verdicts[1]["reason"] == "Somebody waits for it."
    assert panel.first == {"fit": 2, "of": 3, "now": True}
    panel.received("again", {})
    assert (panel.verdicts, panel.chosen) == ([], ["", "", ""])
    assert repr(panel) == panel._repr_mimebundle_()[0]["text/plain"] == "choose('03.cases')"


def test_the_summary_of_a_chapter_lists_them(model: ChoicesModel, store: ChoiceStore, tmp_path: Path) -> None:
    """predictions("03") says how many of how many fit, and knows what is not compared yet."""
    none = PredictionStore(tmp_path / "none.json")
    decide(model, "a topic", "a topic")
    row = Predictions("03", store=none, choices=store).records[0]
    assert (row["state"], row["predicted"]) == ("open", "2 of 3 cases decided")
    model.choose(2, "a topic")
    model.compare()
    row = Predictions("03", store=none, choices=store).records[0]
    assert (row["result"], row["fit"], row["cases"]) == ("2 of 3 fit", 2, 3)
    assert Predictions("05", store=none, choices=store).records == []
