"""Tests of the model of the panel "Break it", without a page.

Only the last tests cause a real fault on the graph.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from course_pkg.errors import UnknownFault
from course_pkg.faults.catalogue import every_fault, named
from course_pkg.faults.fault import Fault
from course_pkg.faults.program import Seen
from course_pkg.panels import BreakIt
from course_pkg.panels.breakit.cases import OPTIONS, Case, CaseStore, cases
from course_pkg.panels.breakit.model import LabModel
from course_pkg.ros import MasterClient, PrivateMaster
from course_pkg.ros.explain import explain
from course_pkg.types import Plain
from tests.support import eventually


@dataclass
class Paper:
    """Fake functions that only record each call; the real functions cause faults and run tools."""

    done: list[str] = field(default_factory=list)
    fails: bool = False
    holds: threading.Event | None = None

    def stage(self, fault: Fault) -> Sheet:
        """Return a fake Stage object for the fault."""
        return Sheet(self, fault.name)

    def use(self, sheet: Sheet, tool: str) -> Seen:
        """Record that a tool was used."""
        if self.holds:
            self.holds.wait(10)
        self.done.append(f"{tool} {sheet.name}")
        return Seen(f"$ {tool}", f"what {tool} printed", 0.5, 0)


@dataclass
class Sheet:
    """A fake Stage object, which records the calls of cause() and undo()."""

    paper: Paper
    name: str
    keeper: Seen = field(default_factory=lambda: Seen("the server's program\n", "", 0.0, 0))

    def cause(self) -> None:
        """Record that the fault was caused, or raise an error."""
        if self.paper.fails:
            raise ConnectionRefusedError(111, "Connection refused")
        self.paper.done.append(f"cause {self.name}")

    def undo(self) -> None:
        """Record that the fault was undone."""
        self.paper.done.append(f"undo {self.name}")


class Lab:
    """The model of a panel that causes no real faults, and the latest state that the model has sent."""

    def __init__(self, path: Path, *chosen: str) -> None:
        self.paper = Paper()
        self.state: dict[str, Plain] = {}
        self.store = CaseStore(path / "cases.json")
        paper = self.paper
        self.model = LabModel(cases(*chosen), self.store, self.state.update, stage=paper.stage, use=paper.use)
        self.state.update(self.model.overview())

    def begin(self, name: str) -> dict[str, Plain]:
        """Open the case that has the given fault, wait for the symptom, and return the state."""
        number = next(case.number for case in cases() if case.fault.name == name)
        self.model.open(number)
        self.settle()
        return self.case

    def settle(self) -> None:
        """Wait until no tool runs."""
        eventually(lambda: self.case["phase"] in ("ready", "over"))

    @property
    def case(self) -> dict[str, Plain]:
        """Return the state of the open case."""
        return dict(self.state["case"])


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    """Return a model of all cases; the model causes no real faults."""
    lab = Lab(tmp_path)
    yield lab
    lab.model.close()


def test_numbers_of_cases_do_not_reveal_the_fault() -> None:
    """The order of the case numbers is different from the order of the faults in the catalogue."""
    everything = cases()
    assert [case.number for case in everything] == list(range(1, len(everything) + 1))
    assert [case.fault for case in everything] != list(every_fault())
    assert {case.fault for case in everything} == set(every_fault())
    some = cases("stale", "stopped")
    assert set(some) <= set(everything)
    assert len(some) == 2


@pytest.mark.parametrize("case", cases(), ids=lambda case: case.fault.name)
def test_each_case_has_plausible_options(case: Case) -> None:
    """A case has five different diagnoses, and exactly one diagnosis is right."""
    assert len(set(case.diagnoses)) == OPTIONS
    assert case.fault.diagnosis in case.diagnoses
    assert case.fault.remedy in case.remedies
    assert len(set(case.remedies)) >= 4
    by_diagnosis = {each.diagnosis: each for each in every_fault()}
    offered = [by_diagnosis[text] for text in case.diagnoses]
    assert not {each.name for each in offered} & set(case.fault.unlike)
    assert not any(case.fault.name in each.unlike for each in offered)


def test_right_answers_are_not_always_in_one_place() -> None:
    """Among all cases, the right diagnosis occurs at every position."""
    places = {case.diagnoses.index(case.fault.diagnosis) for case in cases()}
    assert places == set(range(OPTIONS))


def test_a_case_shows_its_symptom_and_nothing_else(lab: Lab) -> None:
    """Before the answer, the page does not receive the fault's name or the right diagnosis."""
    case = lab.begin("stale")
    assert lab.paper.done == ["cause stale", "again stale"]
    assert case["looks"][0]["said"] == "what again printed"
    assert case["phase"] == "ready"
    text = repr(lab.state)
    assert "stale'" not in text
    assert named("stale").reason not in text
    assert case["verdict"] == {}


def test_tools_are_used_one_at_a_time_and_few_are_kept(lab: Lab) -> None:
    """While a tool runs, a click has no effect. The page shows only the output of the latest eight tools."""
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


def test_a_wrong_answer_shows_the_reason_of_the_chosen_fault(lab: Lab) -> None:
    """After a wrong answer, the page explains the chosen fault.

    If the first answer was wrong, a later right answer does not count as a first answer.
    """
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
    assert lab.case["verdict"]["taught"] == "chapter 12, Survive trouble"
    assert lab.case["verdict"]["server"] == "the server's program"
    assert lab.state["score"] == {"solved": 1, "first": 0, "of": len(every_fault())}
    assert lab.store.read()["stale"].tries == 3


def test_a_right_first_answer_is_counted(lab: Lab, tmp_path: Path) -> None:
    """A right first answer is stored on disk."""
    lab.begin("md5")
    lab.model.answer(named("md5").diagnosis, named("md5").remedy)
    assert lab.state["score"]["first"] == 1
    again = Lab(tmp_path, "md5", "stale")
    assert again.state["score"] == {"solved": 1, "first": 1, "of": 2}
    assert sorted(each["state"] for each in again.state["cases"]) == ["new", "solved"]


def test_an_answer_after_the_solution_is_no_first_answer(lab: Lab) -> None:
    """A right answer after the solution was shown does not count as a first answer."""
    lab.begin("died")
    lab.model.reveal()
    assert lab.case["verdict"]["diagnosis"] == named("died").diagnosis
    assert lab.store.read()["died"].state == "shown"
    lab.begin("died")
    lab.model.answer(named("died").diagnosis, named("died").remedy)
    assert lab.state["score"]["solved"] == 1
    assert lab.state["score"]["first"] == 0


def test_opening_a_case_undoes_the_previous_fault(lab: Lab) -> None:
    """When the student opens another case, the panel undoes the previous fault."""
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


def test_undo_waits_for_the_running_tool(lab: Lab) -> None:
    """If the page is closed while a tool runs, the fault is undone after the tool has finished."""
    lab.begin("stale")
    lab.paper.holds = threading.Event()
    lab.model.use("services")
    lab.model.undo()
    lab.paper.holds.set()
    eventually(lambda: lab.case["phase"] == "over")
    assert lab.paper.done[-1] == "undo stale"


def test_play_prepares_a_case_for_a_page_without_a_kernel(lab: Lab) -> None:
    """play() shows the symptom of a case and the outputs of the given tools, but no answer."""
    lab.model.play("stale", ["services", "ping"])
    assert lab.paper.done == ["cause stale", "again stale", "services stale", "ping stale", "undo stale"]
    assert [each["tool"] for each in lab.case["looks"]] == ["again", "services", "ping"]
    assert lab.case["phase"] == "over"
    assert lab.case["verdict"] == {}


def test_a_case_that_cannot_be_set_up_is_explained(lab: Lab) -> None:
    """If a case cannot start, the page shows an explanation, and the nodes of the case are stopped."""
    lab.paper.fails = True
    lab.begin("stale")
    assert "Connection refused" in lab.state["trouble"]
    assert explain(lab.state["trouble"]).cause.startswith("No master answers")
    assert lab.paper.done == ["undo stale"]
    lab.paper.fails = False
    lab.begin("stale")
    assert lab.state["trouble"] == ""


def test_an_unknown_fault_is_refused() -> None:
    """The error message for an unknown fault lists the known names."""
    with pytest.raises(UnknownFault, match="groups serving, calling, masters"):
        BreakIt("rust")


def test_the_repr_of_the_lab_is_the_same_in_every_run(tmp_path: Path) -> None:
    """The plain text of the panel is the same in every run."""
    store = CaseStore(tmp_path / "cases.json")
    assert repr(BreakIt(store=store)) == "BreakIt()"
    assert repr(BreakIt("stale", "serving", store=store)) == "BreakIt('stale', 'serving')"


def test_nothing_is_broken_before_a_case_is_pressed(master: PrivateMaster, tmp_path: Path) -> None:
    """The panel causes a fault when a case is opened, and undoes the fault when the panel is closed."""
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
