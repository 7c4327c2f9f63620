"""Makes a small package that can be built, or a package with a mistake that makes the build fail."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path

from course_pkg.setup import Places, environment

MANIFEST = """<?xml version="1.0"?>
<package format="2">
  <name>my_services</name>
  <version>0.1.0</version>
  <description>My own service types.</description>
  <maintainer email="me@example.com">Me</maintainer>
  <license>MIT</license>

  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <exec_depend>message_runtime</exec_depend>
</package>
"""
LISTS = """cmake_minimum_required(VERSION 3.10)
project(my_services)

find_package(catkin REQUIRED COMPONENTS message_generation)

add_service_files(FILES Box.srv)
generate_messages()

catkin_package(CATKIN_DEPENDS message_runtime)
"""
BOX = "float32 length\nfloat32 width\n---\nfloat32 area\n"
GOOD = {"package.xml": MANIFEST, "CMakeLists.txt": LISTS, "srv/Box.srv": BOX}


def spoilt(file: str, *changes: tuple[str, str]) -> dict[str, str]:
    """Return the files of a good package, after text replacements in one file."""
    text = GOOD[file]
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return {**GOOD, file: text}


def write(workspace: Path, files: Mapping[str, str]) -> None:
    """Write a package into a workspace."""
    for name, text in files.items():
        path = workspace / "src" / "my_services" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode())


def surroundings(workspace: Path) -> dict[str, str]:
    """Return the course's environment variables, with PWD set to the workspace."""
    return {**environment.merged(Places.of(), os.environ), "PWD": str(workspace)}


def build(workspace: Path, *arguments: str, path: str = "") -> tuple[int, str]:
    """Run catkin_make; return its exit status and output. `path` is the first folder in PATH."""
    known = surroundings(workspace)
    known["PATH"] = f"{path}:{known['PATH']}" if path else known["PATH"]
    done = subprocess.run(
        ["catkin_make", *arguments],
        cwd=workspace,
        env=known,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


def shell(workspace: Path, line: str, *, sourced: bool = True) -> str:
    """Run a bash command in the workspace, and return the output.

    If `sourced` is true, source setup.bash first.
    """
    line = f"source devel/setup.bash && {line}" if sourced else line
    done = subprocess.run(
        ["bash", "-c", line],
        cwd=workspace,
        env=surroundings(workspace),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return done.stdout
