"""Tests of `course sync`, which creates the students' notebooks from the solutions."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Cell, Notebook
from course_pkg.authoring.notebook_store import sync
from course_pkg.checking.parts import parts_of
from course_pkg.errors import AuthoringError
from tests.authoring.books import book, check, code, exercise, text


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Create a checkout with one chapter."""
    cells = [text("# Write a server")]
    for part in parts_of("05"):
        answer = [f"{part.start}\nanswered = True"] if part.start else []
        cells += [exercise(part.check, part.points, *answer), check(part.check)]
    write(tmp_path, book(*cells))
    return tmp_path


def write(root: Path, notebook: Notebook, name: str = "05_write_a_server") -> None:
    """Write a solution notebook as JSON, as a notebook editor does."""
    (root / "solutions").mkdir(exist_ok=True)
    (root / "solutions" / f"{name}.ipynb").write_text(json.dumps(notebook))


def test_sync_updates_the_notebooks(root: Path) -> None:
    """`course sync --check` fails if a notebook is missing, and succeeds after `course sync`."""
    with pytest.raises(AuthoringError, match=r"course sync[\s\S]*notebooks/05_write_a_server.ipynb"):
        sync(check=True, root=root)
    assert sync(root=root) == 0
    assert sync(check=True, root=root) == 0
    stamps = {path: path.stat().st_mtime_ns for path in root.rglob("*.ipynb")}
    assert len(stamps) == 2
    sync(root=root)
    assert {path: path.stat().st_mtime_ns for path in root.rglob("*.ipynb")} == stamps


def test_a_students_notebook_has_no_answer(root: Path) -> None:
    """In a student's notebook, an exercise cell contains only the signature of the function."""
    sync(root=root)
    derived = json.loads((root / "notebooks" / "05_write_a_server.ipynb").read_text())
    cell = derived["cells"][1]
    assert "".join(cell["source"]) == "def handle_geometry(request):\n    ..."
    assert cell["id"] == "exercise-05-1"
    assert cell["metadata"]["course"] == {"exercise": "05.1", "points": 2}


def repair(source: str) -> list[Cell]:
    """Return an exercise cell and a check cell for each part of chapter 04; all have the same source."""
    cells = []
    for part in parts_of("04"):
        cells += [exercise(part.check, part.points, source), check(part.check)]
    return cells


def test_an_exercise_that_repairs_a_file_begins_with_the_broken_file(tmp_path: Path) -> None:
    """If an exercise repairs a file, the student's cell contains the broken file."""
    path = "src/lamp_services/CMakeLists.txt"
    write(tmp_path, book(*repair(f"%%writefile {path}\nproject(lamp_services)")), "04_define_a_service")
    with pytest.raises(AuthoringError):
        sync(root=tmp_path)
    derived = json.loads((tmp_path / "notebooks" / "04_define_a_service.ipynb").read_text())
    cell = next(cell for cell in derived["cells"] if cell["id"] == "exercise-04-4")
    source = "".join(cell["source"])
    assert source.startswith(f"%%writefile {path}\n")
    assert "# generate_messages()" in source


def test_an_exercise_writes_the_file_that_its_check_hands_out(tmp_path: Path) -> None:
    """If an exercise cell and its check name different files, `course sync` fails."""
    write(tmp_path, book(*repair("%%writefile elsewhere.txt\nproject(lamp_services)")), "04_define_a_service")
    with pytest.raises(AuthoringError, match=r"exercise-04-4: the check gives students a cell that begins"):
        sync(root=tmp_path)


def test_an_edit_by_hand_is_found_and_undone(root: Path) -> None:
    """`course sync --check` reports an edited notebook, and `course sync` restores the notebook."""
    sync(root=root)
    path = root / "notebooks" / "05_write_a_server.ipynb"
    path.write_text(path.read_text() + "\n")
    with pytest.raises(AuthoringError, match="out of date"):
        sync(check=True, root=root)
    sync(root=root)
    sync(check=True, root=root)


def test_a_notebook_without_a_solution_is_deleted(root: Path) -> None:
    """After a chapter is renamed, `course sync` deletes the notebook with the old name."""
    sync(root=root)
    (root / "notebooks" / "05_old_name.ipynb").write_text("{}")
    with pytest.raises(AuthoringError, match="05_old_name"):
        sync(check=True, root=root)
    sync(root=root)
    assert not (root / "notebooks" / "05_old_name.ipynb").exists()


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        (
            [exercise(), exercise(), check()],
            r"cell exercise-05-1.*: an earlier cell already has the id 05.1",
        ),
        ([check()], "check 05.1 has no exercise cell above it"),
        ([exercise()], "exercise 05.1 has no check cell"),
        ([exercise(points=None), check()], "cell exercise-05-1: exercise 05.1 has no points"),
        ([exercise(points=9), check()], "the cell has 9 points and its check has 2"),
        ([exercise("05.99"), check("05.99")], "no check is declared for 05.99"),
        ([exercise(source="print(1)"), check()], "this exercise contains no answer"),
        ([exercise(), code("1", course={"check": "05.1"})], r'does not call check\("05.1"\)'),
        ([text("x")], "part 05.1 is declared in the checks, but it has no exercise cell"),
        (
            [
                code(
                    "1/0",
                    id="boom",
                    outputs=[{"output_type": "error", "ename": "E", "evalue": "v", "traceback": []}],
                    execution_count=1,
                )
            ],
            (
                "cell boom: the cell raises E: v; if the cell should raise this error, "
                "add the tag raises-exception"
            ),
        ),
    ],
)
def test_each_problem_of_a_solution_is_reported(tmp_path: Path, cells: list[Cell], words: str) -> None:
    """If a solution notebook has a mistake, the error message contains the notebook and the mistake."""
    write(tmp_path, book(*cells))
    with pytest.raises(AuthoringError, match=rf"05_write_a_server[^\n]*{words}"):
        sync(root=tmp_path)


def test_a_file_that_is_not_a_notebook_is_refused(tmp_path: Path) -> None:
    """The error message for a truncated file contains the name of the file."""
    (tmp_path / "solutions").mkdir()
    (tmp_path / "solutions" / "05_x.ipynb").write_text('{"cells": [')
    with pytest.raises(AuthoringError, match=r"05_x\.ipynb is not a notebook"):
        sync(root=tmp_path)
