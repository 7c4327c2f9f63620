"""Reads Moodle's offline grading worksheet, and writes a copy with new grades and feedback comments.

An instructor switches on the feedback type "Offline grading worksheet" of an assignment, and downloads the
worksheet ("Download grading worksheet"). Later, the instructor uploads the copy with the grades ("Upload
grading worksheet").

The layout of the worksheet is from the source code of Moodle. The file mod/assign/gradingtable.php writes the
columns Identifier ("Participant 12345"), Full name, further fields such as Email address or ID number,
Status, Group, Marker, Grade, Maximum grade (or Scale), Marking workflow state, Grade can be changed, Last
modified (submission), Online text, Last modified (grade), Feedback comments. Most of these columns are
optional. If submissions are anonymous, the name is missing. The names of the columns and the word
"Participant" are in the user's language. The file mod/assign/feedback/offline/importgradeslib.php finds the
columns by exactly these names, and takes the number from the end of the identifier. It refuses a file without
a required column. The file locallib.php in the same folder ignores a grade that is empty, above the maximum,
or locked.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import GradingError
from course_pkg.grading import clean
from course_pkg.grading.roster.exact_csv import Record, records, text_of
from course_pkg.grading.roster.matching import folded
from course_pkg.grading.roster.people import Person
from course_pkg.grading.tables import delimiter_of, table_bytes

WHAT = "grading worksheet"
# LARGEST is the maximum number of bytes of a worksheet; its column "Online text" can contain long texts.
LARGEST = 50_000_000
IDENTIFIER, GRADE, MAXIMUM, SCALE = "Identifier", "Grade", "Maximum grade", "Scale"
OPEN, FEEDBACK = "Grade can be changed", "Feedback comments"
NAME, EMAIL, USERNAME, ID = "Full name", "Email address", "Username", "ID number"
# NAMES contains the names of the worksheet's columns in English, German, French and Spanish, in lower case.
# The names are from Moodle's language packs (lang/*/assign.php, moodle.php and assignfeedback_comments.php).
NAMES = {
    IDENTIFIER: ("identifier", "id", "identifiant", "identificador"),
    GRADE: ("grade", "bewertung", "note", "calificación"),
    MAXIMUM: ("maximum grade", "bestwertung", "note maximale", "calificación máxima"),
    SCALE: ("scale", "skala", "barème", "escala"),
    OPEN: (
        "grade can be changed",
        "bewertung kann geändert werden",
        "la note peut être modifiée",
        "la calificación puede cambiarse",
        "la calificación puede ser cambiada",  # codespell:ignore ser
    ),
    FEEDBACK: (
        "feedback comments",
        "feedback als kommentar",  # codespell:ignore als
        "feedback par commentaires",
        "comentarios de retroalimentación",
    ),
    NAME: (
        "full name",
        "vollständiger name",
        "nom complet",  # codespell:ignore complet
        "nombre completo",
    ),
    EMAIL: (
        "email address",
        "e-mail-adresse",  # codespell:ignore adresse
        "adresse de courriel",  # codespell:ignore adresse
        "dirección de correo",
    ),
    USERNAME: ("username", "anmeldename", "nom d'utilisateur", "nombre de usuario"),
    ID: ("id number", "id-nummer", "numéro d'identification", "número de id"),
}
NO = ("no", "nein", "non")
AGAIN = "Download the grading worksheet again from Moodle, and do not open it in a spreadsheet."


@dataclass(frozen=True)
class Participant:
    """One row of the worksheet."""

    place: int  # `place` is the index of the row in the file's records.
    person: Person
    locked: bool  # `locked` is True if Moodle ignores a new grade for this participant.
    # `maximum` is the maximum number of points, or None if the worksheet contains no maximum.
    maximum: float | None


class Worksheet:
    """The content of a worksheet; the method `copy` returns a changed copy of the file."""

    def __init__(
        self, found: Sequence[Record], separator: str, columns: Mapping[str, int], file: str
    ) -> None:
        self._records = list(found)
        self._separator = separator
        self._columns = columns
        self.participants = tuple(
            self._participant(place, file)
            for place, record in enumerate(self._records)
            if place and not record.blank
        )

    @property
    def word(self) -> str:
        """The word before the number in the column Identifier, such as "participant", in lower case.

        If submissions are anonymous, the names of submitted files contain the word "Participant", in the
        user's language, in place of a student's name.
        """
        first = self._records[1:2]
        return folded(re.sub(r"\d+\s*\Z", "", self._value(first[0], IDENTIFIER))) if first else ""

    @property
    def takes_feedback(self) -> bool:
        """Whether the worksheet has a column for feedback.

        Moodle adds a column for feedback if the feedback type "Feedback comments" is on.
        """
        return FEEDBACK in self._columns

    @property
    def about_points(self) -> str:
        """The end of a sentence about whether the points are scaled to the maximum grade."""
        if MAXIMUM not in self._columns:
            return "; it contains no maximum grade, so the points are not scaled"
        maxima = sorted({f"{each.maximum:g}" for each in self.participants if each.maximum})
        return f"; the points are scaled to Moodle's maximum grade of {' or '.join(maxima)}" if maxima else ""

    def copy(self, graded: Mapping[int, tuple[str, str]]) -> bytes:
        """Return the content of the file with the grades and the feedback (HTML) from `graded`.

        The keys of `graded` are the indices of the participants' rows.

        Only the cells with grades and feedback change. A grade is a number such as "7.5". The grade gets a
        decimal comma if the maximum grade in the same row has a decimal comma.
        """
        changed = deepcopy(self._records)
        for place, (grade, feedback) in graded.items():
            record = changed[place]
            comma = MAXIMUM in self._columns and "," in record.value(self._columns[MAXIMUM])
            record.put(self._columns[GRADE], grade.replace(".", ",") if comma else grade, self._separator)
            if self.takes_feedback:
                record.put(self._columns[FEEDBACK], feedback, self._separator)
        return text_of(changed, self._separator).encode()

    def _participant(self, place: int, file: str) -> Participant:
        record = self._records[place]
        where = f"{file}, line {record.line}"
        width = len(self._records[0].cells)
        if len(record.cells) != width:
            raise GradingError(f"{where}: there are {len(record.cells)} cells, but {width} columns. {AGAIN}")
        number = re.search(r"\d+\s*\Z", self._value(record, IDENTIFIER))
        if not number:
            raise GradingError(f"{where}: the identifier does not end in a number. {AGAIN}")
        person = Person(
            name=self._value(record, NAME),
            id=self._value(record, ID),
            email=self._value(record, EMAIL),
            username=self._value(record, USERNAME),
            number=number[0].strip(),
            line=record.line,
        )
        locked = self._value(record, OPEN).casefold() in NO
        return Participant(place, person, locked, self._maximum(record, where))

    def _maximum(self, record: Record, where: str) -> float | None:
        if MAXIMUM not in self._columns:
            return None
        written = re.sub(r"\s", "", self._value(record, MAXIMUM))
        try:
            maximum = float(re.sub(r"[.,](?=.*[.,])", "", written).replace(",", "."))
        except ValueError as error:
            raise GradingError(f"{where}: the maximum grade is not a number. {AGAIN}") from error
        if maximum <= 0:
            raise GradingError(
                f"{where}: Moodle gives no points for this assignment. In Moodle's settings of the "
                "assignment, set Grade type to Point. Then download the worksheet again."
            )
        return maximum

    def _value(self, record: Record, name: str) -> str:
        return clean.line(record.value(self._columns[name]), 200) if name in self._columns else ""


def read_worksheet(path: Path) -> Worksheet:
    """Return the worksheet in the file at the path `path`.

    Raises GradingError if the file cannot be read, is not a worksheet, uses a scale instead of points, or has
    a damaged row.
    """
    try:
        text = table_bytes(path, WHAT, LARGEST).decode()
    except UnicodeDecodeError as error:
        raise GradingError(
            f"The {WHAT} {path.name} is not in UTF-8, but Moodle writes this file in UTF-8. {AGAIN}"
        ) from error
    separator = delimiter_of(text)
    # The name of the first column begins with the byte order mark, which is removed below.
    found = list(records(text, separator))
    head = [clean.line(found[0].value(place)) for place in range(len(found[0].cells))] if found else []
    if found and text.startswith("\ufeff"):
        head[0] = clean.line(Record([found[0].cells[0].lstrip("\ufeff")], "", 1).value(0))
    worksheet = Worksheet(found, separator, _columns(path.name, head), path.name)
    numbers = Counter(each.person.number for each in worksheet.participants)
    if twice := [each for each in worksheet.participants if numbers[each.person.number] > 1]:
        lines = " and ".join(str(each.person.line) for each in twice[:2])
        raise GradingError(f"{path.name}: lines {lines} have the same identifier. {AGAIN}")
    return worksheet


def _columns(file: str, head: Sequence[str]) -> dict[str, int]:
    names = [name.casefold().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'") for name in head]
    found = {
        column: place for column, known in NAMES.items() for place, name in enumerate(names) if name in known
    }
    if SCALE in found and MAXIMUM not in found:
        raise GradingError(
            f"{file} is the worksheet of an assignment that is graded with a scale, not with "
            "points. In Moodle's settings of the assignment, set Grade type to Point. Then "
            "download the worksheet again."
        )
    missing = [name for name in (IDENTIFIER, GRADE) if name not in found]
    if missing:
        raise GradingError(
            f"{file} is not a grading worksheet of Moodle: the first line does not contain "
            f"{' and '.join(missing)}. In Moodle's assignment, choose Download grading worksheet. "
            "The column names can be English, German, French or Spanish. If your Moodle uses "
            "another language, set Moodle to English. Then download the worksheet again, and leave Moodle "
            "in English until you have uploaded the grades."
        )
    return found
