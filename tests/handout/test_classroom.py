"""Tests that the workflow for GitHub Classroom is valid; the tests do not run the workflow."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import yaml

from course_pkg.cli import COMMANDS
from course_pkg.setup import Places

WORKFLOW = Path("deploy", "github-classroom", "classroom.yml")


def test_the_workflow_is_valid_and_calls_commands_that_exist() -> None:
    """The workflow is valid YAML with valid shell and Python scripts."""
    job = yaml.safe_load((Places.of().checkout / WORKFLOW).read_text("utf-8"))["jobs"]["grade"]
    scripts = [step["run"] for step in job["steps"] if "run" in step]
    for script in scripts:
        subprocess.run(["sh", "-n"], input=script, text=True, check=True)
    called = {name for script in scripts for name in re.findall(r"/course ([a-z-]+) ", script)}
    assert called
    assert called <= set(COMMANDS)
    compile(scripts[-1].partition("<<'END'\n")[2].rpartition("END")[0], "summary", "exec")
