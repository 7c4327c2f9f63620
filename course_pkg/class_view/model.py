"""The data on the teacher's page: the state of each part of each student, and the most frequent hints."""

from __future__ import annotations

import hashlib
import secrets
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from course_pkg.class_view.results import NOT_ATTEMPTED, PASSED, Result
from course_pkg.types.fields import Plain


@dataclass
class Cell:
    """A student's checks of one part of a chapter. Times are in s since 1970; 0 means "never"."""

    tries: int = 0  # number of checks until the first pass; a check of a blank answer does not count
    passed: float = 0.0  # the time of the first pass
    stuck: float = 0.0  # the time of the first check that did not pass
    last: float = 0.0  # the time of the last check
    version: int = 0


@dataclass
class Hint:
    """The number of times that a hint appeared, and the students who saw it."""

    count: int = 0
    students: set[str] = field(default_factory=set)
    version: int = 0


class ClassModel:
    """The state of a class.

    `version` is the number of results that were added. `epoch` is a random number; it changes when results
    are deleted.
    """

    def __init__(self, names: Mapping[str, str], results: Iterable[Result] = ()) -> None:
        self.epoch = secrets.token_hex(8)
        self.version = 0
        self._names = dict(names)
        self._cells: dict[tuple[str, str], Cell] = {}
        self._hints: dict[tuple[str, str], Hint] = {}
        self.add(results)

    def add(self, results: Iterable[Result]) -> None:
        """Add results in the order in which they arrived."""
        for result in results:
            self.version += 1
            self._names.setdefault(result.student, result.student)
            self._add_to_cell(self._cells.setdefault((result.student, result.check), Cell()), result)
            if result.hint:
                hint = self._hints.setdefault((result.check, result.hint), Hint())
                hint.count += 1
                hint.students.add(result.student)
                hint.version = self.version

    def _add_to_cell(self, cell: Cell, result: Result) -> None:
        cell.version = self.version
        cell.last = max(cell.last, result.time)
        if cell.passed:
            return
        cell.tries += result.verdict != NOT_ATTEMPTED
        if result.verdict == PASSED:
            cell.passed = result.time
        elif result.verdict != NOT_ATTEMPTED and not cell.stuck:
            cell.stuck = result.time

    def changes(self, epoch: str, since: int) -> dict[str, Plain]:
        """Return the changes since the version `since`.

        If `epoch` differs from the current epoch, return all data.

        In the result, a cell is the list [student, part, tries, passed, stuck, last], and a hint is the list
        [part, hint, count, students].
        """
        if epoch != self.epoch:
            since = -1
        return {
            "epoch": self.epoch,
            "version": self.version,
            "now": time.time(),
            "students": [[each, name, number] for number, (each, name) in enumerate(self._shuffled(), 1)],
            "cells": [
                [student, part, cell.tries, cell.passed, cell.stuck, cell.last]
                for (student, part), cell in self._cells.items()
                if cell.version > since
            ],
            "hints": [
                [part, text, hint.count, len(hint.students)]
                for (part, text), hint in self._hints.items()
                if hint.version > since
            ],
        }

    def _shuffled(self) -> list[tuple[str, str]]:
        """Return the students in an order that looks random, but is always the same.

        Therefore, the position of a student on the page does not reveal the student's name.
        """
        return sorted(self._names.items(), key=lambda each: hashlib.sha256(each[0].encode()).digest())
