"""Commands as a student types them."""

from __future__ import annotations

import os
import subprocess


def terminal(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, with what it prints as text."""
    env = {**os.environ, **environment}
    return subprocess.run(command, capture_output=True, text=True, timeout=30, env=env, check=False)


def program(name: str, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run one of the course's programs to its end."""
    return terminal("rosrun", "course_pkg", name, *arguments, **environment)
