"""A fixture for tests with a running `course lab`."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator

import pytest

from course_pkg.setup.network import network_problem
from tests.lab.commands import ROOT, lab
from tests.lab.test_jupyterlab import Service
from tests.support import eventually


@pytest.fixture
def served() -> Iterator[Service]:
    """Start `course lab` with an empty notebook, or skip the test if there are no private networks."""
    problem, _ = network_problem()
    if problem:
        pytest.skip(problem)
    with tempfile.NamedTemporaryFile("w", suffix=".ipynb", dir=ROOT / "tests" / "lab") as file:
        file.write(json.dumps({"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}))
        file.flush()
        with lab(file.name) as (process, address):
            service = Service(process, address)
            eventually(service.kernels)
            yield service
