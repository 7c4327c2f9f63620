"""An attack in a cell earns no points, and does not change the result of the next submission."""

from __future__ import annotations

import textwrap
import time
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from course_pkg.checking.fixtures import around
from course_pkg.checking.parts import find
from course_pkg.sandbox.job import PartJob, PartResult
from course_pkg.sandbox.worker_client import SandboxWorker
from tests.sandbox.attacks import FORGED, GRAPH, HOST, SLOW

pytestmark = pytest.mark.usefixtures("sandbox")
CHECK = "05.1"
BEFORE, AFTER = around(CHECK)
RIGHT = """
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)


geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)
"""
WRONG = """
def handle_geometry(request):
    return geometryResponse(area=1.0, volume=2.0)


geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)
"""
QUICK = {"forged": FORGED, "graph": GRAPH, "host": HOST}
KINDS = [(kind, attack) for kind, attacks in QUICK.items() for attack in attacks]
each_attack = pytest.mark.parametrize(("batch", "attack"), KINDS, indirect=["batch"], scope="module")


@pytest.fixture(scope="module")
def worker() -> Iterator[SandboxWorker]:
    """Run one sandbox worker, which all tests of this module use."""
    with SandboxWorker() as started:
        yield started


@pytest.fixture(scope="module")
def batch(worker: SandboxWorker, request: pytest.FixtureRequest) -> Iterator[str]:
    """Yield the name of one kind of attack.

    After the tests of these attacks, assert that a right answer still passes.
    """
    yield request.param
    assert points(worker.run(job(RIGHT))) == 2, f"the attacks of the kind {request.param!r} left something"


def job(source: str) -> PartJob:
    """Return a job that checks the given source as the answer to exercise 05.1."""
    return PartJob(CHECK, BEFORE, (source,), AFTER, 1, find(CHECK).deadline)


def points(result: PartResult) -> int:
    """Return the points in the result's record, or 0 if the result has no record."""
    return int((result.record or {}).get("points", 0))


def attack_wrong(worker: SandboxWorker, attack: str) -> None:
    """Run an attack with a wrong answer, and assert that the answer earns no points."""
    result = worker.run(job(textwrap.dedent(attack) + WRONG))
    assert points(result) == 0
    assert result.record or result.ending
    assert "ImportError" not in str(result.messages), "the attack itself is out of date"


def attack_right(worker: SandboxWorker, attack: str) -> None:
    """Run an attack with a right answer, and assert that the run ends in time."""
    limited = replace(job(textwrap.dedent(attack) + RIGHT), setup_timeout=10.0, answer_timeout=8.0)
    began = time.monotonic()
    result = worker.run(limited)
    assert time.monotonic() - began < limited.limit + 15.0
    assert points(result) in (0, 2)


def attack_endlessly(worker: SandboxWorker, attack: str) -> None:
    """Run an endless answer. Assert that the worker kills the answer in time and gives no points."""
    answer = job(textwrap.dedent(attack) + WRONG)
    limited = replace(answer, deadline=2.0, setup_timeout=3.0, answer_timeout=2.0)
    began = time.monotonic()
    result = worker.run(limited)
    assert time.monotonic() - began < limited.limit + 15.0
    assert points(result) == 0
    assert result.record or result.ending


@each_attack
def test_a_wrong_answer_with_an_attack_earns_no_points(
    worker: SandboxWorker, batch: str, attack: str
) -> None:
    """A wrong answer with an attack earns no points."""
    attack_wrong(worker, QUICK[batch][attack])


@pytest.mark.parametrize("batch", ["endless"], indirect=True, scope="module")
@pytest.mark.parametrize("attack", SLOW)
def test_an_endless_answer_is_ended(worker: SandboxWorker, batch: str, attack: str) -> None:
    """An endless answer is killed after its time limit."""
    attack_endlessly(worker, SLOW[attack])


CAMPAIGN = [
    *((attack_wrong, attack) for _, attack in KINDS),
    *((attack_right, attack) for _, attack in KINDS),
    *((attack_endlessly, attack) for attack in SLOW),
]


@pytest.mark.slow
@pytest.mark.parametrize(("run", "attack"), CAMPAIGN)
def test_no_attack_harms_the_next_answer(
    worker: SandboxWorker, run: Callable[[SandboxWorker, str], None], attack: str
) -> None:
    """After each attack, the next student's right answer passes."""
    run(worker, {**FORGED, **GRAPH, **HOST, **SLOW}[attack])
    assert points(worker.run(job(RIGHT))) == 2
