"""Finds a student's row in a list, from the data in a submission.

For each known field (a number, an email address or a name), the rows with the same value are found. A field
is ignored if no row has the same value. If exactly one row matches all remaining fields, this row belongs to
the student.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from course_pkg.grading.roster.people import IDENTITY, Person


@dataclass(frozen=True)
class Match:
    """The result of a search for a student's row. If several rows are possible, `problem` says why."""

    person: Person | None = None
    problem: str = ""
    # `possible` contains the line numbers of the possible rows if there are several.
    possible: frozenset[int] = frozenset()


class People:
    """The rows of a list; a row can be found by each of its fields."""

    def __init__(self, people: Iterable[Person], title: str) -> None:
        self._people = tuple(people)
        self._title = title
        self._rows: dict[tuple[str, str], set[int]] = {}
        for place, person in enumerate(self._people):
            for key in _keys(person):
                self._rows.setdefault(key, set()).add(place)

    def find(self, known: Person, text: str = "") -> Match:
        """Return the row that belongs to the person `known`.

        `text` is a folder name that an instructor chose. The name can be the value of any field of the
        student.
        """
        proposals = [rows for rows in self._proposals(known, text) if rows]
        if not proposals:
            return Match()
        common = set.intersection(*proposals)
        if not common:
            return self._unclear(
                "the student's number, name and email address belong to different rows", set.union(*proposals)
            )
        if len(common) > 1:
            return self._unclear("several rows fit the student", common)
        person = self._people[min(common)]
        if known.number == person.number != "" and not _agree(known.name, person.name):
            return self._unclear("the student's number is in a row with a different name", common)
        return Match(person)

    def _proposals(self, known: Person, text: str) -> Iterator[set[int]]:
        for key in IDENTITY:
            yield self._fitting(key, getattr(known, key))
        yield self._fitting("name", known.name)
        # Moodle's number identifies a participant only within one assignment. Some rosters contain this
        # number in the column `id`.
        yield self._fitting("number", known.number) or {
            place
            for place in self._fitting("id", known.number)
            if _agree(known.name, self._people[place].name)
        }
        yield set[int]().union(*(self._fitting(key, text) for key in (*IDENTITY, "name")))

    def _fitting(self, key: str, value: str) -> set[int]:
        made = folded(value) if key == "name" else value.strip().casefold()
        return self._rows.get((key, made), set()) if made else set()

    def _unclear(self, problem: str, rows: set[int]) -> Match:
        lines = sorted(self._people[place].line for place in rows)
        *others, last = map(str, lines)
        named = f"lines {', '.join(others)} and {last}" if others else f"line {last}"
        return Match(problem=f"{problem} of {self._title} ({named})", possible=frozenset(lines))


def _keys(person: Person) -> Iterator[tuple[str, str]]:
    for key in (*IDENTITY, "number"):
        if value := getattr(person, key).strip().casefold():
            yield key, value
    yield from (("name", name) for name in orders(person.name))


def orders(name: str) -> set[str]:
    """Return each text that a platform can write for a name; the texts differ in the order of the words.

    For Jane Maria Doe, Canvas writes "doejanemaria", and a spreadsheet can contain "Doe, Jane Maria".
    """
    parts = [part for word in re.split(r"[\s,_]+", name) if (part := folded(word))]
    return {"".join(parts[place:] + parts[:place]) for place in range(len(parts))}


def _agree(one: str, other: str) -> bool:
    """Return whether the names `one` and `other` can belong to one student.

    Text before the student's name in `one` is allowed, because Moodle can write the name of a group there.
    """
    return not one or not other or any(folded(one).endswith(order) for order in orders(other))


def folded(name: str) -> str:
    """Return the letters and digits of a name, in lower case and without accents."""
    letters = unicodedata.normalize("NFKD", name.casefold())
    return "".join(letter for letter in letters if letter.isalnum())
