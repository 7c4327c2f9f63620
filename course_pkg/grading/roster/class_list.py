"""Finds the identities of students in an instructor's lists, and in the names that platforms use."""

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
SHOWN = 10  # SHOWN is the maximum number of names in one sentence.
# For each student, Origins contains the paths of the submitted files.
Origins = Mapping[str, Sequence[str]]


@dataclass(frozen=True)
class ClassList:
    """The identities of the students with submissions.

    Without a roster and a worksheet, the class list is empty.
    """

    people: Mapping[str, Person] = field(default_factory=dict)  # The keys are the students' names.
    roster: tuple[Person, ...] | None = None
    found: int = 0  # `found` is the number of students on the roster who have a submission.
    missing: tuple[Person, ...] = ()  # These students are on the roster, but have no submission.
    strangers: tuple[str, ...] = ()  # These students have a submission, but are not on the roster.
    # `unclear` contains the students who were not found; each value is the reason.
    unclear: Mapping[str, str] = field(default_factory=dict)
    worksheet: Worksheet | None = None
    # `participants` contains the participant in the worksheet for each student.
    participants: Mapping[str, Participant] = field(default_factory=dict)
    unlisted: tuple[str, ...] = ()  # These students have a submission, but are not in the worksheet.

    @property
    def given(self) -> bool:
        """Whether the instructor provided a roster or a worksheet."""
        return self.roster is not None or self.worksheet is not None

    def summary(self) -> Iterator[str]:
        """Yield sentences for the terminal about missing students and students who are not in a list."""
        if self.roster is not None:
            yield f"Roster: {self.found} of {len(self.roster)} students handed in their work."
            yield from _counted("handed in nothing", "handed in nothing", list(labels(self.missing)))
            yield from _counted("is not on the roster", "are not on the roster", self.strangers)
        if self.worksheet is not None:
            yield from self._about_worksheet(self.worksheet)
        for student, reason in self.unclear.items():
            yield f"The student {student} cannot be identified: {reason}."
        if self.unclear:
            yield (
                "canvas.csv and moodle.csv have no row for this student. Correct the roster, or the name of "
                "the student's folder, and type the same command again."
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
                "*Feedback comments* in Moodle's settings of the assignment."
            )
        yield from _counted("has a locked grade in Moodle", "have a locked grade in Moodle", locked)
        yield from _counted("is not in Moodle's worksheet", "are not in Moodle's worksheet", self.unlisted)


@dataclass(frozen=True)
class Lists:
    """The roster and the worksheet that an instructor gave; both are read before the grading begins."""

    roster: tuple[Person, ...] | None = None
    worksheet: Worksheet | None = None

    def matched(self, origins: Origins, source: Path | None = None) -> ClassList:
        """Return the identities of the students with submissions.

        `source` is the folder or the zip of all submissions, which can contain Gradescope's metadata.
        """
        students = [student for student in origins if student]
        platform = _platform(origins, source, self.worksheet.word if self.worksheet else "")
        listed = self.worksheet.participants if self.worksheet else ()
        sheet = _Search([each.person for each in listed], WORKSHEET)
        roster = _Search(self.roster or (), ROSTER)
        for student in students:
            # If no platform is used, the name of the folder can be any field of the student, such as an id.
            text = "" if student in platform else student
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
    """Read the roster and the worksheet; raise GradingError if a file cannot be used."""
    return Lists(
        read_roster(roster) if roster else None,
        read_worksheet(worksheet) if worksheet else None,
    )


class _Search:
    """Finds each student's row in one list (the roster or the worksheet).

    `unclear` contains the students for whom several rows are possible; the values are the reasons.
    """

    def __init__(self, people: Iterable[Person], title: str) -> None:
        self._people = People(people, title)
        self._title = title
        self.found: dict[str, Person] = {}
        self.unclear: dict[str, str] = {}
        # `lines` contains the line numbers of all rows that belong, or can belong, to a student.
        self.lines: set[int] = set()

    def decided(self, student: str) -> bool:
        """Return whether the row of a student was found, or several rows are possible."""
        return student in self.found or student in self.unclear

    def search(self, student: str, known: Person | None, text: str) -> None:
        """Search for the row of a student by the data `known` and by the folder name `text`."""
        match = self._people.find(known or Person(), text)
        if match.person:
            self.found[student] = match.person
            self.lines.add(match.person.line)
        elif match.problem:
            self.unclear[student] = match.problem
            self.lines |= match.possible

    def refuse_shared(self) -> None:
        """Mark students as unclear if the same row was found for several of them.

        The instructor has to decide which of these students is the right one.
        """
        by_line: dict[int, list[str]] = {}
        for student, person in self.found.items():
            by_line.setdefault(person.line, []).append(student)
        for line, students in by_line.items():
            for student in students if len(students) > 1 else ():
                others = ", ".join(each for each in students if each != student)
                self.unclear[student] = (
                    f"the student fits the same row of {self._title} (line {line}) as {others}"
                )
                del self.found[student]

    def unknown(self, students: Iterable[str]) -> tuple[str, ...]:
        """Return the students for whom the search found no row."""
        return tuple(each for each in students if not self.decided(each))


def origins_of(handed_in: Iterable[Submission | Grade]) -> dict[str, list[str]]:
    """Return the paths of each student's files in the folder or zip of all submissions."""
    origins: dict[str, list[str]] = {}
    for each in handed_in:
        origins.setdefault(each.student, []).append(each.origin)
    return origins


def _platform(origins: Origins, source: Path | None, nameless: str) -> dict[str, Person]:
    """Return the data about each student that a platform wrote into file names, folder names and metadata.

    `nameless` is the word that Moodle writes instead of a name if submissions are anonymous.
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
        more = f" and {len(names) - SHOWN} more; class.html contains all names" if len(names) > SHOWN else ""
        told = one if len(names) == 1 else many
        yield f"{len(names)} {told}: {'; '.join(names[:SHOWN])}{more}."
