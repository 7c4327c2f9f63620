"""Tests of time limits that are longer when the load of the machine is higher."""

from __future__ import annotations

import os

import pytest

from course_pkg.waiting import MOST, at_this_load


@pytest.mark.parametrize(("load", "factor"), [(0.0, 1), (1.0, 1), (2.5, 2.5), (50.0, MOST)])
def test_a_limit_grows_with_the_load_of_each_core(
    monkeypatch: pytest.MonkeyPatch, load: float, factor: float
) -> None:
    """A time limit is multiplied by the load per core; the factor is at least 1 and at most `MOST`."""
    monkeypatch.setattr(os, "cpu_count", lambda: 4)
    monkeypatch.setattr(os, "getloadavg", lambda: (4 * load, 0.0, 0.0))
    assert at_this_load(3.0) == 3.0 * factor
