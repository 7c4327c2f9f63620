"""The suite runs on several workers, and some tests share what takes long to start."""

from __future__ import annotations

import pytest


def test_a_worker_knows_the_group_of_each_test(request: pytest.FixtureRequest) -> None:
    """Under `--dist loadgroup`, xdist adds its group to a test's id; not with pytest 9.2."""
    grouped = request.config.getoption("loadgroup", default=False)
    assert request.node.nodeid.endswith("@tests/test_groups.py") == grouped
