"""What the lab knows: no page and no kernel. How a fault is put on a stage is injected."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any, Protocol

from course_pkg.faults.fault import Fault
from course_pkg.faults.probes import TOOLS
from course_pkg.faults.program import Program, Seen
from course_pkg.graph.explanations.explanation import taught
from course_pkg.panels.breakit.cases import Case, meant
from course_pkg.panels.breakit.store import CaseRecord, CaseStore
from course_pkg.panels.breakit.worker import Worker

REHEARSAL = 30.0  # s for each step of one
LOG = 8  # looks that are kept on the page, besides the symptom

State = dict[str, Any]


class Scene(Protocol):
    """A fault on a stage."""

    keeper: Program | None

    def cause(self) -> None:
        """Cause it."""

    def undo(self) -> None:
        """Undo it."""


class LabModel:
    """Causes the fault of a case, shows its symptom, lends tools, checks the answer, and undoes it.

    All that touches the graph happens on a thread of its own, one thing after the other. `changed` hears by
    keyword, from any thread: `cases`, `score`, `case`, `trouble`. `stage` puts a fault on a stage, `use` uses
    a tool there.
    """

    def __init__(
        self,
        cases: tuple[Case, ...],
        store: CaseStore,
        changed: Callable[..., None],
        *,
        stage: Callable[[Fault], Scene],
        use: Callable[[Any, str], Seen],
        turn: threading.RLock | None = None,
    ) -> None:
        self._cases = {case.number: case for case in cases}
        self._store = store
        self._changed = changed
        self._stage = stage
        self._use = use
        self._turn = turn or threading.RLock()
        self._worker = Worker(self._failed)
        self._scene: Scene | None = None
        self._case: Case | None = None
        self._state: State = {}
        self._looks = 0

    def overview(self) -> State:
        """Return all cases with how they stand, and the score."""
        records = self._store.read()
        stands = {case.number: records.get(case.fault.name) for case in self._cases.values()}
        solved = [record for record in stands.values() if record and record.solved]
        first = sum(record.first for record in solved)
        listed = [
            {"number": number, "state": record.state if record else "new"}
            for number, record in stands.items()
        ]
        return {"cases": listed, "score": {"solved": len(solved), "first": first, "of": len(listed)}}

    def open(self, number: int) -> None:
        """Undo what is there and cause case `number`; the symptom comes by `changed`."""
        case = self._cases[number]
        with self._turn:
            if self._state.get("phase") in ("causing", "looking"):
                return
            self._case = case
            self._state = {
                "number": number,
                "story": case.fault.story,
                "phase": "causing",
                "looks": [],
                "tools": [{"name": name, "label": label} for name, label in TOOLS.items()],
                "diagnoses": list(case.diagnoses),
                "remedies": list(case.remedies),
                "verdict": {},
            }
            self._tell(trouble="")
        self._worker.do(partial(self._begin, case))

    def use(self, tool: str) -> None:
        """Use a tool on the case that is open."""
        with self._turn:
            if self._state.get("phase") != "ready" or tool not in TOOLS:
                return
            self._state["phase"] = "looking"
            self._tell()
        self._worker.do(partial(self._look, tool))

    def answer(self, diagnosis: str, remedy: str) -> None:
        """Check an answer, and keep how it was."""
        with self._turn:
            case = self._case
            if case is None or self._settled or diagnosis not in case.diagnoses:
                return
            right = diagnosis == case.fault.diagnosis
            helps = remedy == case.fault.remedy
            record = self._record(case)
            solved = right and helps
            first = record.first or (solved and not record.tries and not record.shown)
            self._keep(replace(record, tries=record.tries + 1, first=first, solved=record.solved or solved))
            self._state["verdict"] = _verdict(case.fault, diagnosis, right=right, helps=helps)
            if solved:
                self._state["verdict"]["server"] = self._server()
            self._tell(**self.overview())

    def reveal(self) -> None:
        """Show the answer; the case then counts as looked at."""
        with self._turn:
            if self._case is None or self._settled:
                return
            record = self._record(self._case)
            self._keep(replace(record, shown=record.shown or not record.solved))
            told = _told(self._case.fault, "shown", "This is it.")
            self._state["verdict"] = {**told, "server": self._server()}
            self._tell(**self.overview())

    def perform(self, name: str, tools: Iterable[str]) -> None:
        """Go through a case on this thread, by the name of its fault: cause, look, undo; for a saved page."""
        number = next(number for number, case in self._cases.items() if case.fault.name == name)
        self.open(number)
        self._worker.finish(REHEARSAL)
        for tool in tools:
            self.use(tool)
            self._worker.finish(REHEARSAL)
        self.close()

    def undo(self) -> None:
        """Undo the fault that is there, after what is under way."""
        with self._turn:
            if self._state.get("phase") in ("over", None):
                return
            self._worker.drop()
        self._worker.do(self._undo)

    def close(self, timeout: float = 15.0) -> None:
        """Undo what is there, and return when it is, at most after `timeout` s."""
        self.undo()
        self._worker.finish(timeout)

    @property
    def _settled(self) -> bool:
        return self._state.get("verdict", {}).get("state") in ("right", "shown")

    def _begin(self, case: Case) -> None:
        self._clear()
        scene = self._stage(case.fault)
        self._scene = scene
        scene.cause()
        self._look("again")

    def _look(self, tool: str) -> None:
        scene = self._scene
        if scene is None:
            return
        seen = self._use(scene, tool)
        with self._turn:
            self._looks += 1
            looks = [*self._state["looks"], _shown(self._looks, tool, seen)]
            self._state["looks"] = [looks[0], *looks[1:][-LOG:]]
            self._state["phase"] = "ready"
            self._tell()

    def _undo(self) -> None:
        self._clear()
        with self._turn:
            self._state["phase"] = "over"
            self._tell()

    def _clear(self) -> None:
        scene, self._scene = self._scene, None
        if scene is not None:
            scene.undo()

    def _failed(self, error: Exception) -> None:
        self._clear()
        with self._turn:
            self._state["phase"] = "over"
            self._tell(trouble=f"{type(error).__name__}: {error}")

    def _server(self) -> str:
        """Return the text of the program that serves in this case, "" where none does."""
        keeper = self._scene.keeper if self._scene else None
        return keeper.shown.rstrip() if keeper else ""

    def _record(self, case: Case) -> CaseRecord:
        return self._store.read().get(case.fault.name, CaseRecord(case.fault.name))

    def _keep(self, record: CaseRecord) -> None:
        self._store.write(record)

    def _tell(self, **more: Any) -> None:  # noqa: ANN401 -- plain data for the page
        self._changed(case=dict(self._state), **more)


def _shown(number: int, tool: str, seen: Seen) -> State:
    return {
        "number": number,
        "tool": tool,
        "shown": seen.shown.rstrip(),
        "said": seen.said.strip(),
        "verdict": seen.verdict if seen.seconds else "",
        "waiting": seen.waiting,
    }


def _verdict(fault: Fault, diagnosis: str, *, right: bool, helps: bool) -> State:
    """Return what there is to say to an answer; for a wrong one, how what it names would look."""
    if right and helps:
        return _told(fault, "right", "Right.")
    if right:
        words = "The diagnosis is right. Another remedy fits it better."
        return {"state": "half", "words": words, "reason": ""}
    other = meant(diagnosis)
    reason = f"If it were that, this would hold: {other.reason}" if other else ""
    return {"state": "wrong", "words": "Not this.", "reason": reason}


def _told(fault: Fault, state: str, words: str) -> State:
    return {
        "state": state,
        "words": words,
        "diagnosis": fault.diagnosis,
        "remedy": fault.remedy,
        "reason": fault.reason,
        "taught": taught(fault.chapter),
    }
