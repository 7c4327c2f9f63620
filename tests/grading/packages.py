"""Makes catkin packages for submissions."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from course_pkg.authoring.cells import code_cells, exercise_of
from course_pkg.chapters.ch07_build_a_package.checks.packages import MY_GEOMETRY
from course_pkg.sandbox.job import WorkFile, work_file
from tests.grading.handing_in import folder, reference

WRITES = "%%writefile src/my_geometry/"
SERVER = "scripts/server.py"
NO_SERVER = "#!/usr/bin/env python3\nimport rospy\n\nrospy.init_node('SERVER_NODE')\nrospy.spin()\n"


def my_geometry(changes: Mapping[str, str] | None = None) -> dict[str, bytes]:
    """Return the package my_geometry of chapter 07's solution. The argument maps paths to new contents."""
    files = dict(MY_GEOMETRY.files)
    for cell in code_cells(reference("07")):
        first, _, text = cell["source"].partition("\n")
        if exercise_of(cell) and first.startswith(WRITES):
            files[first.removeprefix(WRITES)] = text + "\n"
    return {path: text.encode() for path, text in {**files, **(changes or {})}.items()}


def write_package(root: Path, place: str, files: Mapping[str, bytes]) -> Path:
    """Write a package to a path such as "s01/my_geometry", and return the package's folder."""
    folder(root, {f"{place}/{path}": content for path, content in files.items()})
    for path in filter(is_script, files):
        (root / place / path).chmod(0o755)
    return root / place


def work_files(files: Mapping[str, bytes], name: str = "my_geometry") -> tuple[WorkFile, ...]:
    """Return the files of a package in the format of a grading job."""
    return tuple(
        work_file(f"src/{name}/{path}", content, executable=is_script(path))
        for path, content in files.items()
    )


def is_script(path: str) -> bool:
    """Return whether a file of a package is a program."""
    return path.startswith("scripts/")
