"""Writes submissions for grading. A submission is a chapter's solution with a student's answers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from course_pkg.authoring.blank import handed_out
from course_pkg.authoring.cells import code_cells, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore
from tests.grading.handing_in import folder as write_files
from tests.grading.handing_in import raw, reference

WRONG = """
def handle_geometry(request):
    return geometryResponse(area=1.0, volume=2.0)


geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)
"""


def hand_in(
    folder: Path, student: str, chapter: str = "05", answers: Mapping[str, str] | None = None
) -> Path:
    """Write a student's notebook that contains the solution of a chapter.

    `answers` maps parts to other answers; if an answer is empty, the exercise is blank.
    """
    notebook = reference(chapter)
    for cell in code_cells(notebook):
        part = exercise_of(cell)
        if answers and part in answers:
            cell["source"] = answers[part] or handed_out(part, cell["source"])
    name = f"{student}/{NotebookStore().solutions([chapter])[0].name}"
    return write_files(folder, {name: raw(notebook)}) / name
