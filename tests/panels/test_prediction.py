"""Predictions: kept on disk, compared, the same text for every student."""

from __future__ import annotations

import json
import threading
from pathlib import Path

import pytest

from course_pkg.errors import PredictionsBroken
from course_pkg.panels.prediction.model import PredictionModel, summary, verdict
from course_pkg.panels.prediction.store import PredictionStore
from course_pkg.panels.prediction.view import Prediction, Predictions

CHOICES = ("an empty reply", "an error", "it waits for ever")


@pytest.fixture
def store(tmp_path: Path) -> PredictionStore:
    """Keep predictions in a folder that is not there yet."""
    return PredictionStore(tmp_path / "state" / "predictions.json")


@pytest.fixture
def model(store: PredictionStore) -> PredictionModel:
    """Ask one question of chapter 05."""
    return PredictionModel("05.reply_none", "What does the client see?", CHOICES, store)


def test_an_answer_outlives_the_kernel(model: PredictionModel, store: PredictionStore) -> None:
    """What was answered is there for a model made later."""
    model.answer("an error")
    again = PredictionModel(model.key, model.question, CHOICES, PredictionStore(store.path))
    assert again.record.answer == "an error"
    assert again.record.answered


def test_comparing_keeps_the_prediction(model: PredictionModel) -> None:
    """The answer that stands at the comparison is the prediction; a change afterwards is told as one."""
    model.answer("an empty reply")
    record = model.compare("an error")
    assert record.first == "an empty reply"
    assert "otherwise" in verdict(record)
    late = model.answer("an error")
    assert late.changed_after
    assert late.first == "an empty reply"
    assert "changed it to 'an error' after" in verdict(late)


def test_comparing_again_changes_nothing(model: PredictionModel) -> None:
    """A cell that is run again does not take a later answer for a prediction."""
    model.compare("an error")
    model.answer("an error")
    record = model.compare("an error")
    assert record.first == ""
    assert "no prediction" in verdict(record)
    assert "came after the result" in verdict(record)


@pytest.mark.parametrize(
    ("predicted", "actual", "stretch"),
    [("2.50", 2.5, "so it was"), ("Two", "two", "so it was"), ("3", 2, "otherwise")],
)
def test_numbers_and_texts_are_compared_by_what_they_say(
    model: PredictionModel, predicted: str, actual: object, stretch: str
) -> None:
    """2.50 is 2.5, and upper case does not matter."""
    model.answer(predicted)
    assert stretch in verdict(model.compare(actual))


def test_the_summary_is_of_one_chapter_in_order(store: PredictionStore) -> None:
    """Chapter 05 shows its own questions by key, whatever the order in which they were answered."""
    for key in ("05.b", "06.a", "05.a"):
        PredictionModel(key, "?", (), store).answer("yes")
    assert [record.key for record in summary(store.read().values(), "05")] == ["05.a", "05.b"]
    assert len(summary(store.read().values(), "")) == 3


def test_a_broken_file_says_which_and_what_to_do(store: PredictionStore) -> None:
    """A file that the course did not write is left alone and named."""
    store.path.parent.mkdir()
    store.path.write_text("{")
    with pytest.raises(PredictionsBroken, match=r"predictions\.json.*Move the file away"):
        store.read()
    assert store.path.read_text() == "{"


def test_the_file_is_whole_at_every_moment(store: PredictionStore) -> None:
    """A reader never meets half a file while another thread writes."""
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
    assert [path.name for path in store.path.parent.iterdir()] == ["predictions.json"]


def test_predictions_lie_with_the_state_of_the_course(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Nobody has to say where: the course keeps its state in one folder."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path))
    assert PredictionStore().path == tmp_path / "predictions.json"


def test_the_text_is_the_same_for_every_student(store: PredictionStore) -> None:
    """text/plain holds the result only: it does not depend on what was answered."""
    texts = []
    for answer in ("", "an error", "an empty reply"):
        prediction = Prediction("05.reply_none", "What?", CHOICES, store=store)
        if answer:
            prediction.received("answer", {"answer": answer})
        comparison = prediction.compare("an error")
        texts.append([repr(prediction), repr(comparison), comparison._repr_mimebundle_()[0]["text/plain"]])
    assert texts == [["predict('05.reply_none')", *["What really happened: an error"] * 2]] * 3
    assert repr(Predictions("05", store=store)) == "predictions('05')"


def test_the_widgets_show_what_is_kept(store: PredictionStore) -> None:
    """The question shows the kept answer, the comparison both halves, the summary one row."""
    Prediction("05.x", "What?", CHOICES, store=store).received("answer", {"answer": "an error"})
    prediction = Prediction("05.x", "What?", CHOICES, store=store)
    assert prediction.answer == "an error"
    comparison = prediction.compare("an error")
    assert (comparison.record["predicted"], comparison.record["state"]) == ("an error", "right")
    assert [row["state"] for row in Predictions("05", store=store).records] == ["right"]
