"""Write the lock files: every library of pyproject.toml with its version and the hashes of its files."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.setup.libraries import lock_file, uv_program
from course_pkg.setup.places import Places

UV = "uv==0.13.8"
# These libraries parse rare formats in JSON schemas, and jsonschema works without them. Importing one of
# these libraries compiles a grammar; this takes 1.3 s at each start.
LEFT_OUT = ("arrow", "fqdn", "isoduration", "lark", "rfc3987-syntax", "uri-template", "webcolors")
HEADER = "# Written by `./course lock` from pyproject.toml. Do not edit.\n"
WITHOUT = f"""\
# Left out: {", ".join(LEFT_OUT)}.
# jupyter_events asks for these parsers of rare formats as an extra of jsonschema, which works without them.
"""


def write_locks(places: Places) -> list[Path]:
    """Write the lock files of pyproject.toml for all supported versions of Python; return their paths."""
    checkout, uv = places.checkout, uv_program(places)
    _compile(uv, checkout, ["-"], lock_file("uv"), UV)
    _compile(uv, checkout, ["pyproject.toml"], lock_file("course"))
    constraint = ["--constraint", str(lock_file("course"))]
    _compile(uv, checkout, ["pyproject.toml", "--extra", "hub", *constraint], lock_file("hub"))
    constraint += ["--constraint", str(lock_file("hub"))]
    # The tests also need the libraries of the hub, because they start a hub.
    everything = ["--extra", "hub", "--extra", "test"]
    _compile(uv, checkout, ["pyproject.toml", *everything, *constraint], lock_file("test"))
    return [lock_file(name) for name in ("uv", "course", "hub", "test")]


def _compile(uv: Path, checkout: Path, what: list[str], target: Path, text: str = "") -> None:
    options = ["--universal", "--generate-hashes", "--no-header", "--no-annotate", "--python-version", "3.10"]
    env = {**os.environ, "UV_NO_CONFIG": "1"}
    left_out = [f"--no-emit-package={name}" for name in LEFT_OUT]
    command: list[str | Path] = [uv, "pip", "compile", "--quiet", *options, *left_out, *what]
    result = subprocess.run(
        command, cwd=checkout, env=env, input=text, capture_output=True, text=True, check=False
    )
    if result.returncode:
        raise SetupError(f"The libraries of pyproject.toml cannot be resolved:\n{result.stderr}")
    target.write_text(HEADER + ("" if text else WITHOUT) + result.stdout)
