"""What the lab knows and does, with no page; the stage is one of paper but in the last tests."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from course_pkg.errors import UnknownFault
from course_pkg.faults.catalogue import every_fault, named
from course_pkg.faults.fault import Fault
from course_pkg.faults.program import Seen
from course_pkg.graph import MasterClient, PrivateMaster
from course_pkg.graph.explanations import explain
from course_pkg.panels import BreakIt
from course_pkg.panels.breakit.cases import OPTIONS, cases
from course_pkg.panels.breakit.model import LabModel
from course_pkg.panels.breakit.store import CaseStore
from tests.support import eventually


@dataclass
class Paper:
    """A stage on which nothing happens, and all is written down."""

    done: list[str] = field(default_factory=list)
    fails: bool = False
    holds: threading.Event | None = None

    def stage(self, fault: Fault) -> Sheet:
        """Put a fault on it."""
        return Sheet(self, fault.name)

    def use(self, sheet: Sheet, tool: str) -> Seen:
        """Use a tool."""
        if self.holds:
            self.holds.wait(10)
        self.done.append(f"{tool} {sheet.name}")
        return Seen(f"$ {tool}", f"what {tool} printed", 0.5, 0)


@dataclass
class Sheet:
    """One fault on paper."""

    paper: Paper
    name: str
    keeper: Any = field(default_factory=lambda: Seen("the server's program\n", "", 0.0, 0))

    def cause(self) -> None:
        """Note it, or fail."""
        if self.paper.fails:
            raise ConnectionRefusedError(111, "Connection refused")
        self.paper.done.append(f"cause {self.name}")

    def undo(self) -> None:
        """Note it."""
        self.paper.done.append(f"undo {self.name}")


class Lab:
    """A model with its latest state."""

    def __init__(self, path: Path, *chosen: str) -> None:
        self.paper = Paper()
        self.state: dict[str, Any] = {}
        self.store = CaseStore(path / "cases.json")
        stage: Any = self.paper.stage
        use: Any = self.paper.use
        self.model = LabModel(cases(*chosen), self.store, self.state.update, stage=stage, use=use)
        self.state.update(self.model.overview())

    def begin(self, name: str) -> dict[str, Any]:
        """Open the case with this fault, wait for its symptom, and return its state."""
        number = next(case.number for case in cases() if case.fault.name == name)
        self.model.open(number)
        self.settle()
        return self.case

    def settle(self) -> None:
        """Wait until nothing is under way."""
        eventually(lambda: self.case["phase"] in ("ready", "over"))

    @property
    def case(self) -> dict[str, Any]:
        """What the page knows of the case."""
        return dict(self.state["case"])


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    """All cases, on paper."""
    lab = Lab(tmp_path)
    yield lab
    lab.model.close()


def test_numbers_say_nothing() -> None:
    """The order is another than the catalogue's, each fault has one number, the same in every selection."""
    everything = cases()
    assert [case.number for case in everything] == list(range(1, len(everything) + 1))
    assert [case.fault for case in everything] != list(every_fault())
    assert {case.fault for case in everything} == set(every_fault())
    some = cases("stale", "stopped")
    assert set(some) <= set(everything)
    assert len(some) == 2


@pytest.mark.parametrize("case", cases(), ids=lambda case: case.fault.name)
def test_each_case_has_plausible_options(case: Any) -> None:  # noqa: ANN401 -- a Case, or pytest's marker
    """Five diagnoses that differ, the right one among them, and none that would be true here as well."""
    assert len(set(case.diagnoses)) == OPTIONS
    assert case.fault.diagnosis in case.diagnoses
    assert case.fault.remedy in case.remedies
    assert len(set(case.remedies)) >= 4
    by_diagnosis = {each.diagnosis: each for each in every_fault()}
    offered = [by_diagnosis[text] for text in case.diagnoses]
    assert not {each.name for each in offered} & set(case.fault.unlike)
    assert not any(case.fault.name in each.unlike for each in offered)


def test_right_answers_are_not_always_in_one_place() -> None:
    """Whoever always picks the same line learns nothing by it."""
    places = {case.diagnoses.index(case.fault.diagnosis) for case in cases()}
    assert places == set(range(OPTIONS))


def test_a_case_shows_its_symptom_and_nothing_else(lab: Lab) -> None:
    """Neither the name, nor the reason, nor which option is right reaches the page before an answer."""
    case = lab.begin("stale")
    assert lab.paper.done == ["cause stale", "again stale"]
    assert case["looks"][0]["said"] == "what again printed"
    assert case["phase"] == "ready"
    text = repr(lab.state)
    assert "stale'" not in text
    assert named("stale").reason not in text
    assert case["verdict"] == {}


def test_tools_are_used_one_at_a_time_and_few_are_kept(lab: Lab) -> None:
    """A click while another look is under way is left out; the symptom stays, with the latest eight."""
    lab.begin("stale")
    lab.paper.holds = threading.Event()
    lab.model.use("services")
    lab.model.use("ping")
    assert lab.case["phase"] == "looking"
    lab.paper.holds.set()
    lab.settle()
    assert "ping stale" not in lab.paper.done
    for _ in range(10):
        lab.model.use("nodes")
        lab.settle()
    assert len(lab.case["looks"]) == 9
    assert lab.case["looks"][0]["tool"] == "again"
    lab.model.use("rm -rf")
    assert lab.case["phase"] == "ready"


def test_a_wrong_answer_says_what_would_hold_then(lab: Lab) -> None:
    """It gets the reason of what it named; the right one gets its own, and counts, but not as the first."""
    case = lab.begin("stale")
    wrong = next(
        each for each in every_fault() if each.diagnosis in case["diagnoses"] and each.name != "stale"
    )
    lab.model.answer(wrong.diagnosis, named("stale").remedy)
    assert lab.case["verdict"]["state"] == "wrong"
    assert wrong.reason in lab.case["verdict"]["reason"]
    assert "diagnosis" not in lab.case["verdict"]
    lab.model.answer(named("stale").diagnosis, wrong.remedy)
    assert lab.case["verdict"]["state"] == "half"
    lab.model.answer(named("stale").diagnosis, named("stale").remedy)
    assert lab.case["verdict"]["state"] == "right"
    assert lab.case["verdict"]["reason"] == named("stale").reason
    assert lab.case["verdict"]["taught"] == "chapter 10, Survive trouble"
    assert lab.case["verdict"]["server"] == "the server's program"
    assert lab.state["score"] == {"solved": 1, "first": 0, "of": len(every_fault())}
    assert lab.store.read()["stale"].tries == 3


def test_a_right_first_answer_counts_as_such(lab: Lab, tmp_path: Path) -> None:
    """It is kept on disk, and another lab knows of it."""
    lab.begin("md5")
    lab.model.answer(named("md5").diagnosis, named("md5").remedy)
    assert lab.state["score"]["first"] == 1
    again = Lab(tmp_path, "md5", "stale")
    assert again.state["score"] == {"solved": 1, "first": 1, "of": 2}
    assert sorted(each["state"] for each in again.state["cases"]) == ["new", "solved"]


def test_who_looks_at_the_answer_has_not_found_it(lab: Lab) -> None:
    """The answer is told; a right one given later is no first one."""
    lab.begin("died")
    lab.model.reveal()
    assert lab.case["verdict"]["diagnosis"] == named("died").diagnosis
    assert lab.store.read()["died"].state == "shown"
    lab.begin("died")
    lab.model.answer(named("died").diagnosis, named("died").remedy)
    assert lab.state["score"]["solved"] == 1
    assert lab.state["score"]["first"] == 0


def test_another_case_undoes_the_one_before(lab: Lab) -> None:
    """At no time are two faults there."""
    lab.begin("stale")
    lab.begin("md5")
    lab.model.close()
    assert [each for each in lab.paper.done if "again" not in each] == [
        "cause stale",
        "undo stale",
        "cause md5",
        "undo md5",
    ]
    assert lab.case["phase"] == "over"


def test_undo_waits_for_what_is_under_way(lab: Lab) -> None:
    """A page that is closed in the middle of a look leaves no fault behind."""
    lab.begin("stale")
    lab.paper.holds = threading.Event()
    lab.model.use("services")
    lab.model.undo()
    lab.paper.holds.set()
    eventually(lambda: lab.case["phase"] == "over")
    assert lab.paper.done[-1] == "undo stale"


def test_a_case_is_gone_through_for_a_page_without_a_kernel(lab: Lab) -> None:
    """The symptom and what the tools showed stay; the fault is undone; no answer is given away."""
    lab.model.perform("stale", ["services", "ping"])
    assert lab.paper.done == ["cause stale", "again stale", "services stale", "ping stale", "undo stale"]
    assert [each["tool"] for each in lab.case["looks"]] == ["again", "services", "ping"]
    assert lab.case["phase"] == "over"
    assert lab.case["verdict"] == {}


def test_a_case_that_cannot_be_set_up_is_explained(lab: Lab) -> None:
    """The error comes in words that `explain` knows, and what was begun is undone."""
    lab.paper.fails = True
    lab.begin("stale")
    assert "Connection refused" in lab.state["trouble"]
    assert explain(lab.state["trouble"]).cause.startswith("No master answers")
    assert lab.paper.done == ["undo stale"]
    lab.paper.fails = False
    lab.begin("stale")
    assert lab.state["trouble"] == ""


def test_what_there_is_not_is_refused() -> None:
    """A name that no fault has is an error in the cell, that says which there are."""
    with pytest.raises(UnknownFault, match="groups serving, calling, masters"):
        BreakIt("rust")


def test_its_text_is_the_same_for_everybody(tmp_path: Path) -> None:
    """A notebook that shows it can be compared."""
    store = CaseStore(tmp_path / "cases.json")
    assert repr(BreakIt(store=store)) == "BreakIt()"
    assert repr(BreakIt("stale", "serving", store=store)) == "BreakIt('stale', 'serving')"


def test_nothing_is_broken_before_a_case_is_pressed(master: PrivateMaster, tmp_path: Path) -> None:
    """Showing the lab touches nothing; a case does; hiding it undoes the case; so does closing."""
    client = MasterClient(master.uri)
    panel = BreakIt("stale", store=CaseStore(tmp_path / "cases.json"))
    number = panel.cases[0]["number"]
    panel._dispatch(panel, {"kind": "hello", "view": "one"}, None)
    assert client.system_state().nodes == ()
    panel._dispatch(panel, {"kind": "open", "case": number}, None)
    eventually(lambda: panel.case["phase"] == "ready")
    assert "/lab/keeper" in client.system_state().nodes
    assert "Connection refused" in panel.case["looks"][0]["said"]
    panel._dispatch(panel, {"kind": "bye", "view": "one"}, None)
    eventually(lambda: panel.case["phase"] == "over")
    assert client.system_state().nodes == ()
    panel._dispatch(panel, {"kind": "hello", "view": "two"}, None)
    panel._dispatch(panel, {"kind": "open", "case": number}, None)
    eventually(lambda: panel.case["phase"] == "ready")
    panel.close()
    assert client.system_state().nodes == ()
