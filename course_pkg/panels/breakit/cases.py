"""The cases of the lab: their numbers, and what there is to choose from in each."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from course_pkg.faults.catalogue import every_fault, select
from course_pkg.faults.fault import Fault

OPTIONS = 5  # diagnoses to choose from, the right one included


@dataclass(frozen=True)
class Case:
    """A fault under a number that says nothing about it."""

    number: int
    fault: Fault
    diagnoses: tuple[str, ...]
    remedies: tuple[str, ...]


def cases(*chosen: str) -> tuple[Case, ...]:
    """Return the cases for these faults and groups, all for none, by number. Raises UnknownFault.

    A fault has the same number in every selection.
    """
    everything = every_fault()
    wanted = set(select(*chosen))
    shuffled = sorted(everything, key=lambda fault: _chance("number", fault.name))
    return tuple(
        _case(number, fault, everything) for number, fault in enumerate(shuffled, start=1) if fault in wanted
    )


def meant(diagnosis: str) -> Fault | None:
    """Return the fault with this diagnosis."""
    return next((fault for fault in every_fault() if fault.diagnosis == diagnosis), None)


def _case(number: int, fault: Fault, everything: Iterable[Fault]) -> Case:
    alike = sorted(
        (other for other in everything if _could_be(fault, other)),
        key=lambda other: (other.look != fault.look, _chance(fault.name, other.name)),
    )
    offered = [fault, *alike[: OPTIONS - 1]]
    return Case(
        number,
        fault,
        _mixed(fault.name, [each.diagnosis for each in offered]),
        _mixed(fault.name, [each.remedy for each in offered]),
    )


def _could_be(fault: Fault, other: Fault) -> bool:
    """Whether another fault has a symptom of the same kind, and a diagnosis that is wrong here."""
    same = other.name == fault.name or other.name in fault.unlike or fault.name in other.unlike
    return other.look.split()[0] == fault.look.split()[0] and not same


def _mixed(salt: str, texts: Sequence[str]) -> tuple[str, ...]:
    return tuple(sorted(dict.fromkeys(texts), key=lambda text: _chance(salt, text)))


def _chance(salt: str, text: str) -> str:
    """Return a text to sort by, the same in every run and without any meaning."""
    return hashlib.sha256(f"{salt}: {text}".encode()).hexdigest()
