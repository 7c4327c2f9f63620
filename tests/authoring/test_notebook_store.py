"""Solutions and notebooks match, or a message names the difference."""

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
    """Create a checkout with one chapter that has all parts that the checks declare."""
    cells = [text("# Write a server")]
    for part in parts_of("05"):
        answer = [f"{part.start}\nanswered = True"] if part.start else []
        cells += [exercise(part.check, part.points, *answer), check(part.check)]
    write(tmp_path, book(*cells))
    return tmp_path


def write(root: Path, notebook: Notebook, name: str = "05_write_a_server") -> None:
    """Write a solution as a front end would."""
    (root / "solutions").mkdir(exist_ok=True)
    (root / "solutions" / f"{name}.ipynb").write_text(json.dumps(notebook))


def test_sync_brings_into_step_and_check_sees_it(root: Path) -> None:
    """After a sync everything matches, and a second sync writes nothing."""
    with pytest.raises(AuthoringError, match=r"course sync[\s\S]*notebooks/05_write_a_server.ipynb"):
        sync(check=True, root=root)
    assert sync(root=root) == 0
    assert sync(check=True, root=root) == 0
    stamps = {path: path.stat().st_mtime_ns for path in root.rglob("*.ipynb")}
    assert len(stamps) == 2
    sync(root=root)
    assert {path: path.stat().st_mtime_ns for path in root.rglob("*.ipynb")} == stamps


def test_the_answer_is_in_the_solution_alone(root: Path) -> None:
    """A student's exercise has the signature, and the metadata and id of the cell."""
    sync(root=root)
    derived = json.loads((root / "notebooks" / "05_write_a_server.ipynb").read_text())
    cell = derived["cells"][1]
    assert "".join(cell["source"]) == "def handle_geometry(request):\n    ..."
    assert cell["id"] == "exercise-05-1"
    assert cell["metadata"]["course"] == {"exercise": "05.1", "points": 2}


def repair(source: str) -> list[Cell]:
    """Return the cells of a chapter 04 in which only the part with its own start is complete."""
    cells = []
    for part in parts_of("04"):
        cells += [exercise(part.check, part.points, source), check(part.check)]
    return cells


def test_something_to_repair_is_handed_out_as_its_check_says(tmp_path: Path) -> None:
    """In an exercise that repairs a file, the file is not left blank."""
    path = "src/lamp_services/CMakeLists.txt"
    write(tmp_path, book(*repair(f"%%writefile {path}\nproject(lamp_services)")), "04_define_a_service")
    with pytest.raises(AuthoringError):  # the other parts of the chapter write other files
        sync(root=tmp_path)
    derived = json.loads((tmp_path / "notebooks" / "04_define_a_service.ipynb").read_text())
    cell = next(cell for cell in derived["cells"] if cell["id"] == "exercise-04-4")
    source = "".join(cell["source"])
    assert source.startswith(f"%%writefile {path}\n")
    assert "# generate_messages()" in source


def test_an_exercise_writes_the_file_that_its_check_hands_out(tmp_path: Path) -> None:
    """The cell and the check name the same file."""
    write(tmp_path, book(*repair("%%writefile elsewhere.txt\nproject(lamp_services)")), "04_define_a_service")
    with pytest.raises(AuthoringError, match=r"exercise-04-4: the check hands out a cell that begins with"):
        sync(root=tmp_path)


def test_an_edit_by_hand_is_found_and_undone(root: Path) -> None:
    """A change of one byte in a derived notebook is found."""
    sync(root=root)
    path = root / "notebooks" / "05_write_a_server.ipynb"
    path.write_text(path.read_text() + "\n")
    with pytest.raises(AuthoringError, match="out of step"):
        sync(check=True, root=root)
    sync(root=root)
    sync(check=True, root=root)


def test_a_notebook_without_a_solution_goes(root: Path) -> None:
    """After a chapter is renamed, its old notebook is deleted."""
    sync(root=root)
    (root / "notebooks" / "05_old_name.ipynb").write_text("{}")
    with pytest.raises(AuthoringError, match="05_old_name"):
        sync(check=True, root=root)
    sync(root=root)
    assert not (root / "notebooks" / "05_old_name.ipynb").exists()


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ([exercise(), exercise(), check()], r"cell exercise-05-1.*: part 05.1 already stands"),
        ([check()], "check 05.1 has no exercise cell above it"),
        ([exercise()], "exercise 05.1 has no check cell"),
        ([exercise(points=None), check()], "cell exercise-05-1: exercise 05.1 has no points"),
        ([exercise(points=9), check()], "9 points here, 2 in the check"),
        ([exercise("05.99"), check("05.99")], "no check is declared for 05.99"),
        ([exercise(source="print(1)"), check()], "nothing in this exercise to take out"),
        ([exercise(), code("1", course={"check": "05.1"})], r'does not say check\("05.1"\)'),
        ([text("x")], "part 05.1 is declared in the checks and has no exercise cell"),
        (
            [
                code(
                    "1/0",
                    id="boom",
                    outputs=[{"output_type": "error", "ename": "E", "evalue": "v", "traceback": []}],
                    execution_count=1,
                )
            ],
            "cell boom: ends with E: v; tag it raises-exception",
        ),
    ],
)
def test_what_is_wrong_with_a_solution_is_told(tmp_path: Path, cells: list[Cell], words: str) -> None:
    """The message has the notebook's name and the cell's id."""
    write(tmp_path, book(*cells))
    with pytest.raises(AuthoringError, match=rf"05_write_a_server[^\n]*{words}"):
        sync(root=tmp_path)


def test_what_is_no_notebook_is_named(tmp_path: Path) -> None:
    """A truncated file is refused, and not read as an empty notebook."""
    (tmp_path / "solutions").mkdir()
    (tmp_path / "solutions" / "05_x.ipynb").write_text('{"cells": [')
    with pytest.raises(AuthoringError, match=r"05_x\.ipynb is not a notebook"):
        sync(root=tmp_path)
