"""One design of a cashier, tried on the customers of one day in a process of its own, and measured."""

from __future__ import annotations

import time
from collections.abc import Iterable
from typing import Any

from course_pkg.errors import NodeFailed
from course_pkg.graph.node import Node
from course_pkg.graph.processes import NodeProcess
from course_pkg.shop.counter import Visit
from course_pkg.shop.effort import processor_time
from course_pkg.shop.findings import Findings, Points, age_points
from course_pkg.srv import CashierReport, LetIn

# When the customers come, in s. Whatever the moment of the first question, the customers come at each tenth
# of two seconds once, so that chance has little say in what a few of them show; two come nearly together.
DAY = (0.6, 1.8, 2.0, 3.2, 4.4, 4.8, 5.6, 6.2, 7.0, 7.4)
STAY = 1.0  # s that each waits for a greeting
AFTERWARDS = 0.3  # s for the last greeting


def try_out(
    node: Node, detector: NodeProcess, design: str, *, rate: float = 2.0, patience: float = 2.0
) -> Findings:
    """Let the customers of a DAY in, have a cashier of this `design` greet them, and return what came of it.

    `design` is "poll", with `rate` questions a second, "topic", or "wait", with questions that stand for
    `patience` s. `detector` is the process that the cashier asks or hears; a shop_camera has to run, too.
    It takes 10 s. Raises NodeFailed when a process has ended, and what a call raises.
    """
    settings = (f"_design:={design}", f"_rate:={rate}", f"_patience:={patience}")
    with node.run("course_pkg", "cashier", *settings, name="cashier") as cashier:
        cashier.wait_for_service("/cashier/report")
        processes = {"cashier": cashier, "detector": detector}
        before, began = _efforts(processes), time.time()
        visits = _let_in(node, began)
        time.sleep(max(visits[-1].goes + AFTERWARDS + began - time.time(), 0.0))
        after, lasted = _efforts(processes), time.time() - began
        report = node.call("/cashier/report", CashierReport)
    effort = {name: after[name] - before[name] for name in processes}
    return Findings(_title(design, rate), visits, **_told(report, began), lasted=lasted, effort=effort)


def age_of_knowledge(node: Node, cashiers: Iterable[str], seconds: float) -> dict[str, Points]:
    """Wait for `seconds`, and return for each cashier, by its node's name, how old its knowledge was then.

    For a plot: at each time (s), how long ago it last heard from the detector (s).
    """
    began = time.time()
    time.sleep(seconds)
    reports = {name: node.call(f"/{name}/report", CashierReport) for name in cashiers}
    return {
        name: age_points([when.to_sec() - began for when in report.learnt_at], seconds)
        for name, report in reports.items()
    }


def _let_in(node: Node, began: float) -> tuple[Visit, ...]:
    """Let the customers of a DAY in; return their visits, in s from `began`."""
    response = node.call("/let_in", LetIn, after=DAY, stay=STAY)
    starts = [comes.to_sec() - began for comes in response.comes]
    return tuple(Visit(number, start, start + STAY) for number, start in enumerate(starts, response.first))


def _efforts(processes: dict[str, NodeProcess]) -> dict[str, float]:
    """Return the processor time of each process so far, in s."""
    for name, process in processes.items():
        if not process.running:
            raise NodeFailed(f"The {name} has ended, so there is nothing to measure. Run its cell again.")
    return {name: processor_time(process.pid) for name, process in processes.items()}


def _told(report: Any, began: float) -> dict[str, Any]:  # noqa: ANN401 -- a class that catkin generates
    """Return what the cashier reported, in s from `began`."""
    times = [when.to_sec() - began for when in report.greeted_at]
    return {
        "greeted": dict(zip(report.greeted, times, strict=True)),
        "asked": report.asked,
        "heard": report.heard,
    }


def _title(design: str, rate: float) -> str:
    """Return how a plot calls the design."""
    if design == "poll":
        return f"poll, {rate:g} a second" if rate >= 1 else f"poll, every {1 / rate:g} s"
    return {"topic": "topic", "wait": "question that waits"}.get(design, design)
