"""A trial lets customers in, has them greeted by a cashier of one design, and says what came of it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.graph import PrivateMaster
from tests.kernel import Kernel

SHOP = """
from course_pkg import join
from course_pkg.graph import look
from course_pkg.shop import age_of_knowledge, trial, try_out

node = join("student")
camera = node.run("course_pkg", "shop_camera")
camera.wait_for_service("/let_in")
detector = node.run("course_pkg", "detector")
detector.wait_for_service("/detect_customer")
trial.DAY = (0.2, 0.5, 0.6)  # a short one
"""
TOLD = """
found = try_out(node, detector, {design!r}, rate={rate})
result = {{
    "design": found.design, "lost": found.lost, "delays": list(found.delays.values()),
    "asked": found.asked, "heard": found.heard, "cpu": found.cpu, "lasted": found.lasted,
}}
"""


@pytest.fixture(scope="module")
def student(master: PrivateMaster) -> Iterator[Kernel]:
    """A kernel with a camera and a detector."""
    with Kernel() as kernel:
        kernel.run(SHOP)
        yield kernel


@pytest.mark.parametrize(
    ("design", "rate", "title"),
    [
        ("poll", 10, "poll, 10 a second"),
        ("poll", 0.5, "poll, every 2 s"),
        ("topic", 1, "topic"),
        ("wait", 1, "question that waits"),
    ],
)
def test_a_trial_of_each_design(student: Kernel, design: str, rate: float, title: str) -> None:
    """All are greeted or lost; delays and costs are those of real processes, and the cashier has ended."""
    found = student.run(TOLD.format(design=design, rate=rate))
    assert found["design"] == title
    assert found["lost"] + len(found["delays"]) == 3
    assert all(0 <= delay < 1.0 for delay in found["delays"])
    assert (found["asked"] > 0) is (design != "topic")
    assert (found["heard"] == 3) is (design == "topic")
    assert set(found["cpu"]) == {"cashier", "detector"}
    assert all(0 < share < 100 for share in found["cpu"].values())
    assert "/cashier" not in student.run("result = [seen.name for seen in look().nodes]")


def test_knowledge_is_followed_for_several_cashiers(student: Kernel) -> None:
    """Each has an age at each time, which begins at 0 and ends with the time that was given."""
    student.run(
        "cashiers = {name: node.run('course_pkg', 'cashier', f'_design:={name}', '_rate:=20', name=name)"
        " for name in ('poll', 'topic')}"
    )
    student.run("for name, cashier in cashiers.items(): cashier.wait_for_service(f'/{name}/report')")
    ages = student.run("result = age_of_knowledge(node, cashiers, seconds=0.5)")
    assert {name: (points[0], points[-1][0]) for name, points in ages.items()} == {
        "poll": ([0.0, 0.0], 0.5),
        "topic": ([0.0, 0.0], 0.5),
    }
    assert len(ages["poll"]) > len(ages["topic"]) == 2


def test_a_design_that_is_none_is_told_with_the_cashiers_own_words(student: Kernel) -> None:
    """The cashier ends, and the error has what it said."""
    reply = student.ask("try_out(node, detector, 'hope')")
    assert reply.error == "NodeFailed"
    assert "~design is 'hope', and has to be one of poll, topic, wait" in reply.words


def test_a_detector_that_has_ended_is_named(student: Kernel) -> None:
    """There is nothing to measure, and it is said what to do."""
    student.run("ended = node.run('course_pkg', 'detector', name='ended'); ended.stop()")
    reply = student.ask("try_out(node, ended, 'topic')")
    assert (reply.error, reply.words) == (
        "NodeFailed",
        "The detector has ended, so there is nothing to measure. Run its cell again.",
    )
