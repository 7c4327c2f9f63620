"""A check of a dict that assigns an entry to each case, for example a cause to each symptom."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from course_pkg.checking.assertions import ANYTHING
from course_pkg.checking.context import CheckContext
from course_pkg.checking.plain_values import of_kind


@dataclass(frozen=True)
class Cases:
    """The right entry for each case, and the texts for a report.

    For each case, `right` contains the right entry, and `decisive` contains the fact that proves this entry.
    `entries` contains a sentence about each possible entry.

    Three attributes are hints: `missing` for missing keys, `keys` for unknown keys, and `spelling` for an
    unknown entry. `label` is the text for a case in titles of assertions, and `again` is the text for a case
    in hints.
    """

    right: Mapping[str, str]
    decisive: Mapping[str, str]
    entries: Mapping[str, str]
    missing: str
    keys: str
    spelling: str
    entry: str = "cause"  # A report uses this noun for an entry.
    listed: str = "the entries in the list"
    case: str = "case"  # A report uses this noun for a case.
    label: str = "case {}"
    again: str = "case {}"


def compare_cases(context: CheckContext, name: str, cases: Cases) -> None:
    """Assert that the student's dict `name` has the right entry for each case.

    The hint for a wrong entry contains the sentence about this entry, and the decisive fact of the case.
    """
    named = _entries_by_case(context, name, cases)
    odd = [entry for entry in named.values() if not isinstance(entry, str) or entry not in cases.entries]
    context.require(
        f"each {cases.entry} is one of {cases.listed}",
        holds=not odd,
        expected=f"one of {', '.join(map(repr, cases.entries))}",
        actual=odd[0] if odd else "",
        hints=[
            (
                lambda _: not isinstance(odd[0], str),
                f"One {cases.entry} is not a string. For each {cases.case}, write exactly one string from "
                f"{cases.listed}.",
            ),
            (ANYTHING, cases.spelling),
        ],
    )
    for case, right in cases.right.items():
        again = f"Look at {cases.again.format(case)} again: {cases.decisive[case]}"
        context.expect(
            cases.label.format(case),
            expected=right,
            actual=named[case],
            hints=f"{cases.entries[named[case]]} {again}",
        )


def _entries_by_case(context: CheckContext, name: str, cases: Cases) -> dict[str, str]:
    """Return the student's dict; assert that its keys are the cases."""
    given = context.read(name)
    keys = set(given) if isinstance(given, dict) else set()
    context.require(
        f"there is a {cases.entry} for each {cases.case}",
        holds=isinstance(given, dict) and keys == set(cases.right),
        expected=f"a dict with the keys {', '.join(map(repr, cases.right))}",
        actual=", ".join(map(repr, given)) if isinstance(given, dict) else given,
        hints=[
            (lambda _: isinstance(given, dict) and keys < set(cases.right), cases.missing),
            (ANYTHING, cases.keys),
        ],
    )
    return of_kind(dict, given, name)
