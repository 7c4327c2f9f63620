"""One result of a check, and the validation of results that a student's server has sent."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from course_pkg.grading import clean
from course_pkg.types.fields import Plain

ID = re.compile(r"[0-9A-Za-z-]{1,64}")
CHECK = re.compile(r"\d\d(?:\.\d{1,2}){1,2}")
VERDICTS = ("passed", "not yet", "not attempted", "not examined")
PASSED, NOT_ATTEMPTED = VERDICTS[0], VERDICTS[2]
LONGEST_HINT = 500  # The length is in characters.
MOST = 100  # A request contains at most this number of results.


@dataclass(frozen=True)
class Result:
    """The result of one check of one student. `time` is in s since 1970."""

    student: str
    id: str  # unique among the results of this student
    check: str
    verdict: str
    time: float
    hint: str


def received(student: str, data: object, now: float, oldest: float) -> tuple[list[Result], list[str]]:
    """Return the valid results in a student's request, and the ids of all items in the request.

    `data` is the JSON data of the request.

    The ids of invalid items are included; the student's server then does not send these items again. A time
    in the future becomes the time `now`, and a time before `oldest` becomes `oldest`. Raises ValueError if
    `data` is not a list of at most `MOST` results.
    """
    sent = data.get("results") if isinstance(data, dict) else None
    if not isinstance(sent, list) or not 0 < len(sent) <= MOST:
        raise ValueError(f"A request has to contain a list of 1 to {MOST} results.")
    items = [each for each in sent if isinstance(each, dict)]
    found = [_result(student, each, now, oldest) for each in items]
    return [each for each in found if each], [str(each.get("id")) for each in items]


def _result(student: str, data: dict[str, Plain], now: float, oldest: float) -> Result | None:
    name, check, verdict = (str(data.get(key)) for key in ("id", "check", "verdict"))
    time = data.get("time")
    known = ID.fullmatch(name) and CHECK.fullmatch(check) and verdict in VERDICTS
    if not known or not isinstance(time, (int, float)) or not math.isfinite(time):
        return None
    hint = "" if verdict == PASSED else clean.line(data.get("hint") or "", LONGEST_HINT)
    return Result(student, name, check, verdict, min(max(float(time), oldest), now), hint)
