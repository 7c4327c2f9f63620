"""The cases of the panel "Break it": the number and the options of each case, and the student's answers."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from course_pkg.faults.catalogue import every_fault, select
from course_pkg.faults.fault import Fault
from course_pkg.panels.store import Store

OPTIONS = 5  # The student chooses from at most this many diagnoses; one of them is right.


@dataclass(frozen=True)
class Case:
    """A fault with its number in the list of cases; the number does not reveal the fault."""

    number: int
    fault: Fault
    diagnoses: tuple[str, ...]
    remedies: tuple[str, ...]


@dataclass(frozen=True)
class CaseRecord:
    """The student's answers to one case.

    `key` is the name of the fault, and `tries` is the number of answers.

    `first` is True if the first answer was right, and `solved` is True if any answer was right. `shown` is
    True if the student opened the solution before the first right answer.
    """

    key: str
    tries: int = 0
    first: bool = False
    solved: bool = False
    shown: bool = False

    @property
    def state(self) -> str:
        """The state of the case, which is "new", "wrong", "shown" or "solved"."""
        if self.solved:
            return "solved"
        return "shown" if self.shown else "wrong" if self.tries else "new"


class CaseStore(Store[CaseRecord]):
    """A file with the student's answers: one CaseRecord for each fault."""

    record = CaseRecord
    file = "cases.json"
    what = "answers to cases"


def cases(*chosen: str) -> tuple[Case, ...]:
    """Return the cases of the chosen faults and groups, sorted by number; by default, return all cases.

    The number of a fault does not depend on the arguments. Raises UnknownFault for a name that does not
    exist.
    """
    everything = every_fault()
    wanted = set(select(*chosen))
    numbered = sorted(everything, key=lambda fault: _sort_key("number", fault.name))
    return tuple(
        _case(number, fault, everything) for number, fault in enumerate(numbered, start=1) if fault in wanted
    )


def fault_with(diagnosis: str) -> Fault | None:
    """Return the fault with this diagnosis, or None if no fault has this diagnosis."""
    return next((fault for fault in every_fault() if fault.diagnosis == diagnosis), None)


def _case(number: int, fault: Fault, everything: Iterable[Fault]) -> Case:
    alike = sorted(
        (other for other in everything if _could_be(fault, other)),
        key=lambda other: (other.look != fault.look, _sort_key(fault.name, other.name)),
    )
    offered = [fault, *alike[: OPTIONS - 1]]
    return Case(
        number,
        fault,
        _shuffled(fault.name, [each.diagnosis for each in offered]),
        _shuffled(fault.name, [each.remedy for each in offered]),
    )


def _could_be(fault: Fault, other: Fault) -> bool:
    """Return whether the diagnosis of `other` is a useful wrong choice for `fault`.

    Such a diagnosis is wrong for `fault`, but the symptoms of both faults are similar.
    """
    same = other.name == fault.name or other.name in fault.unlike or fault.name in other.unlike
    return other.look.split()[0] == fault.look.split()[0] and not same


def _shuffled(salt: str, texts: Sequence[str]) -> tuple[str, ...]:
    return tuple(sorted(dict.fromkeys(texts), key=lambda text: _sort_key(salt, text)))


def _sort_key(salt: str, text: str) -> str:
    """Return a sort key; the order looks random but is the same in every run."""
    return hashlib.sha256(f"{salt}: {text}".encode()).hexdigest()
