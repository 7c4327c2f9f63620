"""No attack earns a point, and none harms whoever comes next."""

from __future__ import annotations

import textwrap
import time
from collections.abc import Iterator

import pytest

from course_pkg.examiner.answers import around
from course_pkg.examiner.parts import find
from course_pkg.grading.ward.job import PartJob, PartOutcome
from course_pkg.grading.wards import Ward
from tests.grading.attacks import FORGED, GRAPH, HOST, SLOW

pytestmark = pytest.mark.usefixtures("walls")
CHECK = "05.1"
BEFORE, AFTER = around(CHECK)
RIGHT = """
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)
"""
WRONG = """
def handle_geometry(request):
    return geometryResponse(area=1.0, volume=2.0)
"""
QUICK = {**FORGED, **GRAPH, **HOST}


@pytest.fixture(scope="module")
def ward() -> Iterator[Ward]:
    """One ward for all: what an attack leaves behind, the next part meets."""
    with Ward() as behind_walls:
        yield behind_walls


def job(source: str, *, settling: float = 25.0, patience: float = 20.0) -> PartJob:
    """Return the job for a cell of exercise 05.1."""
    return PartJob(CHECK, BEFORE, (source,), AFTER, 1, find(CHECK).deadline, settling, patience)


def points(outcome: PartOutcome) -> int:
    """Return what the judge's record gives; nothing where there is none."""
    return int((outcome.record or {}).get("points", 0))


@pytest.mark.parametrize("attack", QUICK)
def test_an_attack_earns_a_wrong_answer_nothing(ward: Ward, attack: str) -> None:
    """Whatever runs beside a wrong answer, it stays wrong; and the next one's right answer passes."""
    outcome = ward.run(job(textwrap.dedent(QUICK[attack]) + WRONG))
    assert points(outcome) == 0
    assert outcome.record or outcome.ending
    assert points(ward.run(job(RIGHT))) == 2


@pytest.mark.parametrize("attack", QUICK)
def test_an_attack_on_a_right_answer_stays_within_its_walls(ward: Ward, attack: str) -> None:
    """A right answer with an attack beside it ends in good time, and the next one is not harmed."""
    limited = job(textwrap.dedent(QUICK[attack]) + RIGHT, settling=10.0, patience=8.0)
    began = time.monotonic()
    outcome = ward.run(limited)
    assert time.monotonic() - began < limited.limit + 15.0
    assert points(outcome) in (0, 2)
    assert points(ward.run(job(RIGHT))) == 2


@pytest.mark.parametrize("attack", SLOW)
def test_what_never_ends_is_ended(ward: Ward, attack: str) -> None:
    """An answer that hangs is given up after its time, with a reason, and the next one is not harmed."""
    limited = job(textwrap.dedent(SLOW[attack]) + WRONG, settling=3.0, patience=2.0)
    began = time.monotonic()
    outcome = ward.run(limited)
    assert time.monotonic() - began < limited.limit + 15.0
    assert points(outcome) == 0
    assert outcome.record or outcome.ending
    assert points(ward.run(job(RIGHT))) == 2
