"""The identities of the students, from an instructor's lists and from the names that platforms give."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from course_pkg.grading.grade import Grade, Submission
from course_pkg.grading.intake.naming import CANVAS, GRADESCOPE, MOODLE, number_of
from course_pkg.grading.roster.gradescope import gradescope_people
from course_pkg.grading.roster.matching import People, folded
from course_pkg.grading.roster.people import Person, labels, read_roster
from course_pkg.grading.roster.worksheet import Participant, Worksheet, read_worksheet

ROSTER, WORKSHEET = "the roster", "Moodle's worksheet"
SHOWN = 10  # maximum number of names in one sentence
Origins = Mapping[str, Sequence[str]]  # the paths of the files that each student handed in


@dataclass(frozen=True)
class ClassList:
    """The identities of the students of the submissions; empty without a roster and a worksheet."""

    people: Mapping[str, Person] = field(default_factory=dict)  # by student
    roster: tuple[Person, ...] | None = None
    found: int = 0  # number of students of the roster who have handed in a submission
    missing: tuple[Person, ...] = ()  # students of the roster who have handed in nothing
    strangers: tuple[str, ...] = ()  # students who are not on the roster
    unclear: Mapping[str, str] = field(default_factory=dict)  # for each student who was not found, the reason
    worksheet: Worksheet | None = None
    participants: Mapping[str, Participant] = field(default_factory=dict)  # of the worksheet, by student
    unlisted: tuple[str, ...] = ()  # students who are not in the worksheet

    @property
    def given(self) -> bool:
        """Whether an instructor gave a list."""
        return self.roster is not None or self.worksheet is not None

    def summary(self) -> Iterator[str]:
        """Yield sentences for the terminal about students who are missing, not on a list, or unclear."""
        if self.roster is not None:
            yield f"Roster: {self.found} of {len(self.roster)} students handed in."
            yield from _counted("handed in nothing", "handed in nothing", list(labels(self.missing)))
            yield from _counted("is not on the roster", "are not on the roster", self.strangers)
        if self.worksheet is not None:
            yield from self._about_worksheet(self.worksheet)
        for student, reason in self.unclear.items():
            yield f"It is unclear which student {student} is: {reason}."
        if self.unclear:
            yield (
                "canvas.csv and moodle.csv have no row for such a student. Correct the list, or the name of "
                "the folder, and type the same command again."
            )

    def _about_worksheet(self, worksheet: Worksheet) -> Iterator[str]:
        locked = [student for student, each in self.participants.items() if each.locked]
        yield (
            f"Moodle's worksheet: {len(self.participants) - len(locked)} of {len(worksheet.participants)} "
            f"participants have a grade in moodle_worksheet.csv{worksheet.about_points}."
        )
        if not worksheet.takes_feedback:
            yield (
                "The worksheet has no column for feedback. To upload feedback, switch on the feedback type "
                "Feedback comments in Moodle's settings of the assignment."
            )
        yield from _counted("has a locked grade in Moodle", "have a locked grade in Moodle", locked)
        yield from _counted("is not in Moodle's worksheet", "are not in Moodle's worksheet", self.unlisted)


@dataclass(frozen=True)
class Lists:
    """The lists that an instructor gave, read before anything is graded."""

    roster: tuple[Person, ...] | None = None
    worksheet: Worksheet | None = None

    def matched(self, origins: Origins, source: Path | None = None) -> ClassList:
        """Return the identities of the students of the submissions.

        `source` is the folder or the zip of all submissions, in which Gradescope's metadata may be.
        """
        students = [student for student in origins if student]
        platform = _platform(origins, source, self.worksheet.word if self.worksheet else "")
        listed = self.worksheet.participants if self.worksheet else ()
        sheet = _Search([each.person for each in listed], WORKSHEET)
        roster = _Search(self.roster or (), ROSTER)
        for student in students:
            text = "" if student in platform else student  # a name that an instructor or a script gave
            sheet.search(student, platform.get(student), text)
            roster.search(student, _joined(sheet.found.get(student), platform.get(student)), text)
            if student in roster.found and not sheet.decided(student):
                sheet.search(student, roster.found[student], "")
        sheet.refuse_shared()
        roster.refuse_shared()
        people = {
            each: _joined(roster.found.get(each), sheet.found.get(each), platform.get(each))
            for each in students
        }
        rows = {each.person.line: each for each in listed}
        return ClassList(
            people={student: person for student, person in people.items() if person},
            roster=self.roster,
            found=len(roster.found),
            missing=tuple(each for each in self.roster or () if each.line not in roster.lines),
            strangers=roster.unknown(students) if self.roster is not None else (),
            unclear=sheet.unclear | roster.unclear,
            worksheet=self.worksheet,
            participants={each: rows[person.line] for each, person in sheet.found.items()},
            unlisted=sheet.unknown(students) if self.worksheet else (),
        )


def read_lists(roster: Path | None, worksheet: Path | None) -> Lists:
    """Read the lists in two files; raises GradingError if a file cannot be used."""
    return Lists(
        read_roster(roster) if roster else None,
        read_worksheet(worksheet) if worksheet else None,
    )


class _Search:
    """The rows of one list that were found, and the students for whom it is unclear."""

    def __init__(self, people: Iterable[Person], title: str) -> None:
        self._people = People(people, title)
        self._title = title
        self.found: dict[str, Person] = {}
        self.unclear: dict[str, str] = {}
        self.lines: set[int] = set()  # the lines that belong, or may belong, to a student

    def decided(self, student: str) -> bool:
        """Return whether the search for a student has ended: the row was found, or it is unclear."""
        return student in self.found or student in self.unclear

    def search(self, student: str, known: Person | None, text: str) -> None:
        """Search the row of a student with the known fields, and with the name of the folder."""
        match = self._people.find(known or Person(), text)
        if match.person:
            self.found[student] = match.person
            self.lines.add(match.person.line)
        elif match.problem:
            self.unclear[student] = match.problem
            self.lines |= match.possible

    def refuse_shared(self) -> None:
        """Remove a row that fits several students, because only the instructor can decide whose row it is."""
        by_line: dict[int, list[str]] = {}
        for student, person in self.found.items():
            by_line.setdefault(person.line, []).append(student)
        for line, students in by_line.items():
            for student in students if len(students) > 1 else ():
                others = ", ".join(each for each in students if each != student)
                self.unclear[student] = f"it fits the same row of {self._title} (line {line}) as {others}"
                del self.found[student]

    def unknown(self, students: Iterable[str]) -> tuple[str, ...]:
        """Return the students without a row."""
        return tuple(each for each in students if not self.decided(each))


def origins_of(handed_in: Iterable[Submission | Grade]) -> dict[str, list[str]]:
    """Return the paths of each student's files inside the folder or the zip of all submissions."""
    origins: dict[str, list[str]] = {}
    for each in handed_in:
        origins.setdefault(each.student, []).append(each.origin)
    return origins


def _platform(origins: Origins, source: Path | None, nameless: str) -> dict[str, Person]:
    """Return the data about students in the names of files and folders that platforms choose.

    `nameless` is the word that Moodle writes in place of a name if submissions are anonymous.
    """
    exported = any(GRADESCOPE.fullmatch(part) for paths in origins.values() for part in _parts(paths))
    found = gradescope_people(source) if exported and source else {}
    for student, paths in origins.items():
        name, number = number_of(student, paths, MOODLE)
        if number:
            anonymous = nameless and folded(name).endswith(nameless)
            found[student] = Person(name="" if anonymous else name, number=number)
        name, number = number_of(student, paths, CANVAS)
        if number:
            found[student] = Person(name=name, id=number)
    return {student: person for student, person in found.items() if student in origins}


def _parts(paths: Iterable[str]) -> Iterator[str]:
    return (part for path in paths for part in path.split("/"))


def _joined(*people: Person | None) -> Person | None:
    known = [person for person in people if person]
    if not known:
        return None
    first, *others = known
    for other in others:
        first = first.completed(other)
    return first


def _counted(one: str, many: str, names: Sequence[str]) -> Iterator[str]:
    if names:
        more = f" and {len(names) - SHOWN} more; class.html lists all" if len(names) > SHOWN else ""
        told = one if len(names) == 1 else many
        yield f"{len(names)} {told}: {'; '.join(names[:SHOWN])}{more}."
