"""The state of the panel "Break it".

The caller passes the functions `stage` and `use`, so this module needs no ROS graph.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Generic, Literal, Protocol, TypeVar

from course_pkg.faults.fault import Fault
from course_pkg.faults.probes import TOOLS
from course_pkg.faults.program import Program, Seen
from course_pkg.panels.breakit.cases import Case, CaseRecord, CaseStore, fault_with
from course_pkg.panels.breakit.state import CaseState, Listed, Overview, Score, ToolUse, Verdict
from course_pkg.panels.breakit.worker import Worker
from course_pkg.ros.explain.explanation import taught

STEP = 30.0  # play() waits up to this time in s for the fault, and for the output of each tool.
LOG = 8  # The panel stores the symptom and at most this many outputs of tools.


class Scene(Protocol):
    """A fault that the panel can cause on the ROS graph, and undo later."""

    keeper: Program | None

    def cause(self) -> None:
        """Cause the fault on the graph."""

    def undo(self) -> None:
        """Undo the fault on the graph."""


SceneType = TypeVar("SceneType", bound=Scene)


class LabModel(Generic[SceneType]):
    """Causes the fault of a case, shows its symptom, runs tools, checks the answer, and undoes the fault.

    One worker thread makes all changes to the graph, in the order of the method calls. After each change, the
    model calls the function `changed` with some of the keyword arguments `cases`, `score`, `case` and
    `trouble`. Any thread can call `changed`.

    The function `stage` returns the Scene of a fault. The function `use` runs a tool on a Scene, and returns
    the output of the tool.
    """

    def __init__(
        self,
        cases: tuple[Case, ...],
        store: CaseStore,
        changed: Callable[..., None],
        *,
        stage: Callable[[Fault], SceneType],
        use: Callable[[SceneType, str], Seen],
        turn: threading.RLock | None = None,
    ) -> None:
        self._cases = {case.number: case for case in cases}
        self._store = store
        self._changed = changed
        self._stage = stage
        self._use = use
        self._turn = turn or threading.RLock()
        self._worker = Worker(self._failed)
        self._scene: SceneType | None = None
        self._case: Case | None = None
        self._state: CaseState = {}
        self._looks = 0

    def overview(self) -> Overview:
        """Return all cases with their states, and the score."""
        records = self._store.read()
        answers = {case.number: records.get(case.fault.name) for case in self._cases.values()}
        solved = [record for record in answers.values() if record and record.solved]
        first = sum(record.first for record in solved)
        listed = [
            Listed(number=number, state=record.state if record else "new")
            for number, record in answers.items()
        ]
        return {"cases": listed, "score": {"solved": len(solved), "first": first, "of": len(listed)}}

    def open(self, number: int) -> None:
        """Undo the current fault, and cause the fault of case `number`; the panel then shows the symptom."""
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
            self._report(trouble="")
        self._worker.do(partial(self._begin, case))

    def use(self, tool: str) -> None:
        """Run the tool `tool` on the fault of the open case."""
        with self._turn:
            if self._state.get("phase") != "ready" or tool not in TOOLS:
                return
            self._state["phase"] = "looking"
            self._report()
        self._worker.do(partial(self._look, tool))

    def answer(self, diagnosis: str, remedy: str) -> None:
        """Check the student's answer, and store the result."""
        with self._turn:
            case = self._case
            if case is None or self._settled or diagnosis not in case.diagnoses:
                return
            right = diagnosis == case.fault.diagnosis
            right_remedy = remedy == case.fault.remedy
            record = self._record(case)
            solved = right and right_remedy
            first = record.first or (solved and not record.tries and not record.shown)
            tries, ever_solved = record.tries + 1, record.solved or solved
            self._store.write(replace(record, tries=tries, first=first, solved=ever_solved))
            self._state["verdict"] = _verdict(case.fault, diagnosis, right=right, right_remedy=right_remedy)
            if solved:
                self._state["verdict"]["server"] = self._server()
            self._report_all()

    def reveal(self) -> None:
        """Show the solution, and record that it was shown."""
        with self._turn:
            if self._case is None or self._settled:
                return
            record = self._record(self._case)
            self._store.write(replace(record, shown=record.shown or not record.solved))
            solution = _solution(self._case.fault, "shown", "This is the solution.")
            self._state["verdict"] = {**solution, "server": self._server()}
            self._report_all()

    def play(self, name: str, tools: Iterable[str]) -> None:
        """Cause the fault `name`, run the tools, and undo the fault.

        A saved page, which has no kernel, can show the outputs of the tools.
        """
        number = next(number for number, case in self._cases.items() if case.fault.name == name)
        self.open(number)
        self._worker.finish(STEP)
        for tool in tools:
            self.use(tool)
            self._worker.finish(STEP)
        self.close()

    def undo(self) -> None:
        """Tell the worker thread to undo the current fault when the running job has ended."""
        with self._turn:
            if self._state.get("phase") in ("over", None):
                return
            self._worker.drop()
        self._worker.do(self._undo)

    def close(self, timeout: float = 15.0) -> None:
        """Undo the current fault, and wait until it is undone, for at most `timeout` s."""
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
            self._report()

    def _undo(self) -> None:
        self._clear()
        with self._turn:
            self._state["phase"] = "over"
            self._report()

    def _clear(self) -> None:
        scene, self._scene = self._scene, None
        if scene is not None:
            scene.undo()

    def _failed(self, error: Exception) -> None:
        self._clear()
        with self._turn:
            self._state["phase"] = "over"
            self._report(trouble=f"{type(error).__name__}: {error}")

    def _report_all(self) -> None:
        overview = self.overview()
        self._report(cases=overview["cases"], score=overview["score"])

    def _server(self) -> str:
        """Return the text of the server's program, or "" if the case has no server."""
        keeper = self._scene.keeper if self._scene else None
        return keeper.shown.rstrip() if keeper else ""

    def _record(self, case: Case) -> CaseRecord:
        return self._store.read().get(case.fault.name, CaseRecord(case.fault.name))

    def _report(self, **more: list[Listed] | Score | str) -> None:
        self._changed(case=dict(self._state), **more)


def _shown(number: int, tool: str, seen: Seen) -> ToolUse:
    return {
        "number": number,
        "tool": tool,
        "shown": seen.shown.rstrip(),
        "said": seen.said.strip(),
        "verdict": seen.verdict if seen.seconds else "",
        "waiting": seen.waiting,
    }


def _verdict(fault: Fault, diagnosis: str, *, right: bool, right_remedy: bool) -> Verdict:
    if right and right_remedy:
        return _solution(fault, "right", "Right.")
    if right:
        words = "The diagnosis is right, but a different remedy is better for this fault."
        return {"state": "half", "words": words, "reason": ""}
    other = fault_with(diagnosis)
    reason = f"The fault that you chose would have different symptoms: {other.reason}" if other else ""
    return {
        "state": "wrong",
        "words": "Your diagnosis is wrong: the graph has a different fault.",
        "reason": reason,
    }


def _solution(fault: Fault, state: Literal["right", "shown"], words: str) -> Verdict:
    return {
        "state": state,
        "words": words,
        "diagnosis": fault.diagnosis,
        "remedy": fault.remedy,
        "reason": fault.reason,
        "taught": taught(fault.chapter),
    }
