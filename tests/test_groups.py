"""Tests of the groups of tests: one pytest-xdist worker runs all tests of a group."""

from __future__ import annotations

import pytest


def test_a_worker_knows_the_group_of_each_test(request: pytest.FixtureRequest) -> None:
    """With `--dist loadgroup`, pytest-xdist adds the group to the id of a test.

    With pytest 9.2, pytest-xdist does not add the group, so this test fails.
    """
    grouped = request.config.getoption("loadgroup", default=False)
    assert request.node.nodeid.endswith("@tests/test_groups.py") == grouped
