"""A wrong answer earns no additional points if its code replaces the replies of the kernel agent."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import pytest

from course_pkg.checking.parts import find
from course_pkg.sandbox.job import PartJob
from course_pkg.sandbox.worker_client import SandboxWorker
from tests.checking.answers.example_answers import Answer, every_answer
from tests.sandbox.attacks import EVIDENCE
from tests.support import usual

pytestmark = pytest.mark.usefixtures("sandbox")
# Each example answer is wrong in a property that only the kernel can see, such as the type of a value.
WRONG = {
    "06.5 returns a tuple": 1.0,
    "11.1 returns a list of ints": 0.0,
    "11.3 uses a ServiceProxy in another function": 0.0,
    "05.2 starts the count at 1": 0.0,
    "05.2 uses one count for all objects": 0.0,
    "05.4 is on at the start": 1.6,
    "05.4 uses one value for all switches": 1.6,
    "08.5 returns a dict": 2.0,
    "08.5 stores the type of each name": 2.0,
    "11.1 returns a list class with the name bytes": 0.0,
    "10.2 checks twice per second": 0.0,
    "10.2 uses a loop without a pause": 0.0,
    "12.1 polls the thread without a pause": 0.0,
    "12.1 polls without a pause, and hides its CPU time": 0.0,
}


@pytest.fixture(scope="module")
def worker() -> Iterator[SandboxWorker]:
    """Run one sandbox worker, which all tests of this module use."""
    with SandboxWorker() as started:
        yield started


@cache
def answers() -> dict[str, Answer]:
    """Return all example answers; the keys are the part and the title."""
    return {f"{answer.check} {answer.title}": answer for answer in every_answer()}


@pytest.mark.parametrize(("name", "most"), usual(2, {name: (name, most) for name, most in WRONG.items()}))
def test_a_forged_reply_of_the_kernel_earns_no_points(worker: SandboxWorker, name: str, most: float) -> None:
    """A wrong answer that replaces the kernel's replies earns only the points for its right goals."""
    answer = answers()[name]
    source, deadline = EVIDENCE + answer.source, find(answer.check).deadline
    result = worker.run(PartJob(answer.check, answer.before, (source,), answer.after, 1, deadline))
    assert result.record or result.ending
    assert not result.messages
    points = float(str((result.record or {}).get("points", 0)))
    assert points <= most
