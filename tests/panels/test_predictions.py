"""Tests of the stored predictions and choices."""

from __future__ import annotations

import json
import threading
from pathlib import Path

import pytest

from course_pkg.errors import InvalidPredictions, NotAChoice
from course_pkg.panels.choices.model import ChoicesModel, ChoiceStore
from course_pkg.panels.choices.view import Choices
from course_pkg.panels.prediction.model import PredictionModel, PredictionStore
from course_pkg.panels.prediction.view import Predictions, Question
from course_pkg.panels.store import of_chapter

OPTIONS = ("a topic", "a service")
CASES = [
    ("Joint values, 100 times a second", "a topic", "A lost one is replaced at once."),
    ("One picture, on demand", "a service", "Somebody waits for it."),
    ("`/cmd_vel`", "a topic", "It is a stream."),
]
CHOICES = ("an empty reply", "an error", "it waits for ever")


@pytest.fixture
def store(tmp_path: Path) -> PredictionStore:
    """Return an empty store of predictions; its folder does not exist yet."""
    return PredictionStore(tmp_path / "state" / "predictions.json")


@pytest.fixture
def model(store: PredictionStore) -> PredictionModel:
    """Return the model of a prediction in chapter 05."""
    return PredictionModel("05.reply_none", "What does the client see?", CHOICES, store)


def test_an_answer_outlives_the_kernel(model: PredictionModel, store: PredictionStore) -> None:
    """A new model of the same prediction reads the stored answer."""
    model.answer("an error")
    again = PredictionModel(model.key, model.question, CHOICES, PredictionStore(store.path))
    assert again.record.answer == "an error"
    assert again.record.answered


def test_comparing_keeps_the_prediction(model: PredictionModel) -> None:
    """A comparison stores the student's answer as the prediction."""
    model.answer("an empty reply")
    record = model.compare("an error")
    assert record.first == "an empty reply"
    assert "the result is different" in record.verdict
    late = model.answer("an error")
    assert late.changed_after
    assert late.first == "an empty reply"
    assert "changed your answer to 'an error' after" in late.verdict


def test_comparing_again_changes_nothing(model: PredictionModel) -> None:
    """After a comparison, a new answer does not replace the prediction."""
    model.compare("an error")
    model.answer("an error")
    record = model.compare("an error")
    assert record.first == ""
    assert "no prediction" in record.verdict
    assert "came after the result" in record.verdict


@pytest.mark.parametrize(
    ("predicted", "actual", "stretch"),
    [("2.50", 2.5, "this happened"), ("Two", "two", "this happened"), ("3", 2, "the result is different")],
)
def test_numbers_and_texts_are_compared_by_value(
    model: PredictionModel, predicted: str, actual: object, stretch: str
) -> None:
    """In the comparison, 2.50 is equal to 2.5, and upper and lower case are equal."""
    model.answer(predicted)
    assert stretch in model.compare(actual).verdict


def test_the_summary_is_of_one_chapter_in_order(store: PredictionStore) -> None:
    """of_chapter() returns the predictions of one chapter, sorted by key."""
    for key in ("05.b", "06.a", "05.a"):
        PredictionModel(key, "?", (), store).answer("yes")
    assert [record.key for record in of_chapter(store.read().values(), "05")] == ["05.a", "05.b"]
    assert len(of_chapter(store.read().values(), "")) == 3


def test_a_broken_file_raises_an_error_with_its_path(store: PredictionStore) -> None:
    """If the stored file is damaged, the error message contains its path, and the file does not change."""
    store.path.parent.mkdir()
    store.path.write_text("{")
    with pytest.raises(InvalidPredictions, match=r"predictions\.json.*Move this file to"):
        store.read()
    assert store.path.read_text() == "{"


def test_the_file_is_whole_at_every_moment(store: PredictionStore) -> None:
    """While another thread writes the file, a reader always gets a complete file."""
    stop = threading.Event()
    store.write(PredictionModel("05.x", "?" * 5000, (), store).record)

    def write() -> None:
        model = PredictionModel("05.x", "?" * 5000, (), store)
        while not stop.is_set():
            model.answer("yes")

    writer = threading.Thread(target=write)
    writer.start()
    try:
        for _ in range(200):
            assert json.loads(store.path.read_text())
    finally:
        stop.set()
        writer.join()
    assert sorted(path.name for path in store.path.parent.iterdir()) == [".lock", "predictions.json"]


def test_predictions_are_in_the_state_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """By default, predictions are stored in the course's state folder."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path))
    assert PredictionStore().path == tmp_path / "predictions-2.json"


def test_answers_of_the_first_edition_belong_to_other_questions(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Predictions and choices from the first edition are not used and not changed."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path))
    prediction = {"key": "08.once", "question": "Where is the turtle?", "answer": "one metre"}
    choice = {"key": "08.cases", "question": "Which fits?", "cases": 1, "chosen": {CASES[0][0]: "a service"}}
    kept = {"predictions.json": {"08.once": prediction}, "choices.json": {"08.cases": choice}}
    for name, records in kept.items():
        (tmp_path / name).write_text(json.dumps(records))
    question = Question("08.once", "What does the client see?", CHOICES)
    assert question.answer == ""
    assert Choices("08.cases", "Which fits?", OPTIONS, CASES).chosen == ["", "", ""]
    assert Predictions("08").records == []
    question.received("answer", {"answer": "an error"})
    assert [row["predicted"] for row in Predictions("08").records] == ["an error"]
    assert {name: json.loads((tmp_path / name).read_text()) for name in kept} == kept


def test_the_text_is_the_same_for_every_student(store: PredictionStore) -> None:
    """The plain text does not depend on the student's answer."""
    texts = []
    for answer in ("", "an error", "an empty reply"):
        prediction = Question("05.reply_none", "What?", CHOICES, store=store)
        if answer:
            prediction.received("answer", {"answer": answer})
        comparison = prediction.compare("an error")
        texts.append([repr(prediction), repr(comparison), comparison._repr_mimebundle_()[0]["text/plain"]])
    assert texts == [["predict('05.reply_none')", *["What really happened: an error"] * 2]] * 3
    assert repr(Predictions("05", store=store)) == "predictions('05')"


def test_the_widgets_show_what_is_stored(store: PredictionStore) -> None:
    """The widgets show the stored prediction and the result."""
    Question("05.x", "What?", CHOICES, store=store).received("answer", {"answer": "an error"})
    prediction = Question("05.x", "What?", CHOICES, store=store)
    assert prediction.answer == "an error"
    comparison = prediction.compare("an error")
    assert (comparison.record["predicted"], comparison.record["state"]) == ("an error", "right")
    assert [row["state"] for row in Predictions("05", store=store).records] == ["right"]


@pytest.fixture
def choice_store(tmp_path: Path) -> ChoiceStore:
    """Return an empty store of choices; its folder does not exist yet."""
    return ChoiceStore(tmp_path / "state" / "choices.json")


@pytest.fixture
def choices_model(choice_store: ChoiceStore) -> ChoicesModel:
    """Return a model of three cases in chapter 03."""
    return ChoicesModel("03.cases", "Which fits?", OPTIONS, CASES, choice_store)


def decide(choices_model: ChoicesModel, *options: str) -> None:
    """Choose `options[0]` for the first case, `options[1]` for the second case, and so on."""
    for number, option in enumerate(options):
        choices_model.choose(number, option)


def test_a_choice_outlives_the_kernel(choices_model: ChoicesModel, choice_store: ChoiceStore) -> None:
    """A new model reads the stored choice, and the student can change the choice."""
    decide(choices_model, "a topic", "a topic")
    again = ChoicesModel("03.cases", "Which fits?", OPTIONS, CASES, ChoiceStore(choice_store.path))
    assert again.chosen == ["a topic", "a topic", ""]
    again.choose(1, "a service")
    assert choices_model.chosen == ["a topic", "a service", ""]


def test_reasons_stay_hidden_until_every_case_is_decided(choices_model: ChoicesModel) -> None:
    """The reasons are hidden until every case has a choice."""
    decide(choices_model, "a topic", "a topic")
    choices_model.compare()
    assert choices_model.verdicts == []
    choices_model.choose(2, "a topic")
    choices_model.compare()
    assert [verdict.fits for verdict in choices_model.verdicts] == [True, False, True]
    assert choices_model.verdicts[1].answer == "a service"
    assert choices_model.verdicts[1].reason == "Somebody waits for it."


def test_choices_cannot_change_while_the_reasons_are_shown(choices_model: ChoicesModel) -> None:
    """While the page shows the reasons, a new choice is not stored."""
    decide(choices_model, *["a topic"] * 3)
    choices_model.compare()
    choices_model.choose(1, "a service")
    assert choices_model.chosen == ["a topic"] * 3


def test_the_first_time_counts(choices_model: ChoicesModel) -> None:
    """If the student makes new choices after again(), the stored first choices do not change."""
    decide(choices_model, "a topic", "a topic", "a service")
    assert choices_model.compare().fit == 1
    assert choices_model.again().shown is False
    assert choices_model.chosen == ["", "", ""]
    decide(choices_model, "a topic", "a service", "a topic")
    record = choices_model.compare()
    assert all(verdict.fits for verdict in choices_model.verdicts)
    assert (record.fit, list(record.first.values())) == (1, ["a topic", "a topic", "a service"])


def test_a_changed_case_is_open_again(choices_model: ChoicesModel, choice_store: ChoiceStore) -> None:
    """If the text or the options of a case have changed, its stored choice is not used."""
    decide(choices_model, *["a topic"] * 3)
    others = [("Another case", "a topic", "Because."), CASES[1], CASES[2]]
    assert ChoicesModel("03.cases", "?", OPTIONS, others, choice_store).chosen == ["", "a topic", "a topic"]
    fewer = ("a service", "an action")
    assert ChoicesModel("03.cases", "?", fewer, CASES[1:2], choice_store).chosen == [""]


@pytest.mark.parametrize(
    ("cases", "stretch"),
    [
        ([("One", "a topci", "So.")], "the answer 'a topci' of case 1"),
        ([CASES[0], CASES[0]], "is given twice"),
        ([("One", "a topic")], r"Write each case as \(case, answer, reason\)"),
    ],
)
def test_a_mistake_of_the_author_raises_an_error(
    cases: list[tuple[str, str, str]], stretch: str, choice_store: ChoiceStore
) -> None:
    """ChoicesModel raises NotAChoice if a case has an unknown answer or no reason, or occurs twice."""
    with pytest.raises(NotAChoice, match=stretch):
        ChoicesModel("03.cases", "?", OPTIONS, cases, choice_store)


def test_a_broken_file_of_choices_raises_an_error_with_its_path(choice_store: ChoiceStore) -> None:
    """If the stored file is damaged, the error message contains its path, and the file does not change."""
    choice_store.path.parent.mkdir()
    choice_store.path.write_text('{"03.cases": {"colour": 3}}')
    with pytest.raises(InvalidPredictions, match=r"choices\.json does not contain valid.*Move this file"):
        choice_store.read()


def test_a_page_learns_the_answers_only_when_they_are_shown(choice_store: ChoiceStore) -> None:
    """Before the student clicks the button, the widget's state contains no answers."""
    panel = Choices("03.cases", "Which fits?", OPTIONS, CASES, store=choice_store)
    assert "Somebody waits" not in str(panel.get_state())
    for number in range(3):
        panel.received("choose", {"case": number, "option": "a topic"})
    panel.received("compare", {})
    assert panel.verdicts[1]["reason"] == "Somebody waits for it."
    assert panel.first == {"fit": 2, "of": 3, "now": True}
    panel.received("again", {})
    assert (panel.verdicts, panel.chosen) == ([], ["", "", ""])
    assert repr(panel) == panel._repr_mimebundle_()[0]["text/plain"] == "choose('03.cases')"


def test_the_summary_of_a_chapter_lists_them(
    choices_model: ChoicesModel, choice_store: ChoiceStore, tmp_path: Path
) -> None:
    """predictions("03") shows how many choices were right."""
    none = PredictionStore(tmp_path / "none.json")
    decide(choices_model, "a topic", "a topic")
    row = Predictions("03", store=none, choices=choice_store).records[0]
    assert (row["state"], row["predicted"]) == ("open", "2 of 3 cases have an answer")
    choices_model.choose(2, "a topic")
    choices_model.compare()
    row = Predictions("03", store=none, choices=choice_store).records[0]
    assert (row["result"], row["fit"], row["cases"]) == ("2 of 3 fit", 2, 3)
    assert Predictions("05", store=none, choices=choice_store).records == []
