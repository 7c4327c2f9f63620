"""Tests of the sandbox for machines without namespaces, which runs each submission as another user."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from course_pkg.setup import Places
from tests.sandbox import attacks_by_user
from tests.sandbox.other_users import run_installed, unpacked_autograder


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_attacks_by_another_user_reach_nothing(tmp_path: Path) -> None:
    """An attack cannot read a solution, change a file, earn points, or leave a running process."""
    source = unpacked_autograder(tmp_path, chapters=("05",))
    source.parent.chmod(0o700)
    checkout = Places.of().checkout
    solution = checkout / "solutions" / "05_write_a_server.ipynb"
    check = checkout / "course_pkg" / "chapters" / "ch05_write_a_server" / "fixtures.py"
    script = Path(attacks_by_user.__file__)
    (source / "course" / script.name).write_text(script.read_text("utf-8"), "utf-8")
    command = [str(Places.of().python), script.name, str(source), str(solution), str(check)]
    ran = run_installed(source, command, timeout=240)
    assert ran.returncode == 0, ran.stderr
    found = json.loads(ran.stdout.splitlines()[-1])
    assert not found["refusal"]
    assert found["uid"] >= 60000
    # The first probe must succeed, because this success shows that the probes have run.
    assert found["done"] == ["os.getuid() == UID"]
    assert not any(found["points"].values()), found["points"]
    assert not any(found["left"].values()), found["left"]
    assert set(found["later"].values()) == {2}, found["later"]
