"""Tests of `course release`: the students' edition has no solutions."""

from __future__ import annotations

import json
import os
import re
import subprocess
import zipfile
from pathlib import Path

import pytest

from course_pkg.authoring.cells import Notebook, code_cells, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, read
from course_pkg.checking.parts import chapters, parts_of
from course_pkg.ros import PrivateMaster
from tests.handout.releases import ROOT, files_of, git, make_release, python_in

SHORT = 8  # A line with fewer characters is too common to identify an answer.
MOST = 0.8  # Another file may contain at most this fraction of an answer's lines.
# The goals of these parts contain the whole files.
BY_ASSIGNMENT = {"srv/geometry.srv": "07.2", "srv/ServiceExample.srv": "07.8"}
ANSWER = """
from course_pkg import check, join
import rospy
from course_pkg.srv import geometry, geometryResponse
join("student")
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)
rospy.Service("/getGeometry", geometry, handle_geometry)
print(check("05.1"))
"""


@pytest.fixture(scope="module")
def edition(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Release the whole course once."""
    return make_release(tmp_path_factory.mktemp("release") / "ros-course")


def lines_of(source: str) -> list[str]:
    """Return the lines that are long enough to identify an answer."""
    stripped = (line.strip() for line in source.splitlines())
    return [line for line in stripped if len(line) >= SHORT and not line.startswith("%%")]


def answers(edition: Path) -> dict[str, list[str]]:
    """For each part, return the lines of the solution that are not in the edition."""
    found = {}
    for path in NotebookStore().solutions():
        released = {cell["id"]: cell["source"] for cell in read(edition / "notebooks" / path.name)["cells"]}
        for cell in code_cells(read(path)):
            if part := exercise_of(cell):
                given = set(lines_of(released[cell["id"]]))
                found[part] = [line for line in lines_of(cell["source"]) if line not in given]
    return found


def test_no_file_contains_the_answer_to_an_exercise(edition: Path) -> None:
    """No released file contains a solution; only lines that the exercise's goal contains are allowed."""
    wanted = {part: lines for part, lines in answers(edition).items() if lines}
    assert len(wanted) > 95
    found = {}
    for name, content in files_of(edition).items():
        text = content.decode("utf-8", "replace")
        if name.endswith((".ipynb", ".json")):
            text = text.replace('\\"', '"').replace("\\n", "\n")
        kept = {line.strip() for line in text.splitlines()}
        found |= {
            (name, part): lines
            for part, lines in wanted.items()
            if sum(line in kept for line in lines) >= MOST * len(lines) and BY_ASSIGNMENT.get(name) != part
        }
    assert found == {}


def test_what_students_must_not_have_is_left_out(edition: Path) -> None:
    """The edition has no solutions, tests, example answers, fixtures, private checks or git history."""
    names = [*files_of(edition), *zipped(edition)]
    secret = re.compile(
        r"(solutions|tests|\.ci)/|.*/chapters/(.*(answers|fixtures)\.py|.*recordings\.json|private_)"
    )
    assert [name for name in names if secret.match(name)] == []
    assert git(edition, "rev-list", "--count", "HEAD") == "1"


def test_the_notebooks_are_those_that_students_get(edition: Path) -> None:
    """Each released notebook has the same bytes as the notebook in notebooks/."""
    for path in NotebookStore().solutions():
        assert (edition / "notebooks" / path.name).read_bytes() == (
            ROOT / "notebooks" / path.name
        ).read_bytes()


def zipped(edition: Path) -> dict[str, zipfile.ZipInfo]:
    """Return the information about each file in the edition's zip; the keys are the paths."""
    with zipfile.ZipFile(f"{edition}.zip") as archive:
        return {info.filename.removeprefix(f"{edition.name}/"): info for info in archive.infolist()}


def test_folder_repository_and_zip_have_the_same_files(edition: Path, tmp_path: Path) -> None:
    """A clone and the unpacked zip have the same files as the folder."""
    git(tmp_path, "clone", "--quiet", str(edition), "clone")
    subprocess.run(["unzip", "-q", f"{edition}.zip", "-d", tmp_path / "zip"], check=True)
    unpacked = tmp_path / "zip" / edition.name
    assert files_of(tmp_path / "clone") == files_of(unpacked) == files_of(edition)
    assert all(os.access(folder / "course", os.X_OK) for folder in (edition, tmp_path / "clone", unpacked))
    assert git(edition, "status", "--porcelain") == ""


def test_the_readme_is_for_students(edition: Path) -> None:
    """README contains the first command, no command that needs solutions, and no broken link."""
    text = (edition / "README.md").read_text("utf-8")
    assert "./course lab" in text
    assert [
        name for name in ("grade", "release", "collect", "sync", "test") if f"./course {name}" in text
    ] == []
    assert "instructors" not in text
    targets = re.findall(r"\]\(([\w./-]+)\)", text)
    assert targets
    assert [target for target in targets if not (edition / target).exists()] == []


@pytest.mark.parametrize(
    "words",
    [
        ["grade", "x"],
        ["grade-one", "x", "--out", "y"],
        ["review", "x"],
        ["release", "x"],
        ["sync"],
        ["test"],
        ["site"],
    ],
)
def test_what_needs_the_solutions_says_so_in_one_message(edition: Path, words: list[str]) -> None:
    """If a command needs solutions, its error message contains "students' edition"."""
    nowhere = {**os.environ, "XDG_CACHE_HOME": "/proc/nowhere"}
    done = subprocess.run(
        [edition / "course", *words], env=nowhere, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert "students' edition" in done.stderr
    assert "instructors' edition" in done.stderr


def test_the_first_command_is_there(edition: Path) -> None:
    """`./course --help` works in the edition with every version of Python."""
    done = subprocess.run([edition / "course", "--help"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "\n    lab" in done.stdout


def test_every_check_is_there(edition: Path) -> None:
    """Each part has the same points and the same goal as in the instructors' edition."""
    program = """
import json
import course_pkg
from course_pkg.checking.parts import every_part
print(json.dumps([course_pkg.__file__, [[part.check, part.points, part.goal] for part in every_part()]]))
"""
    place, parts = json.loads(python_in(edition, program))
    assert Path(place).is_relative_to(edition)
    assert parts == [[part.check, part.points, part.goal] for each in chapters() for part in parts_of(each)]


def test_a_check_passes_a_right_answer(edition: Path, master: PrivateMaster, tmp_path: Path) -> None:
    """In the edition, `check("05.1")` passes for a right answer."""
    printed = python_in(edition, ANSWER, COURSE_STATE=str(tmp_path), ROS_MASTER_URI=str(master.uri))
    assert printed.startswith("05.1 passed"), printed


def test_some_chapters(tmp_path: Path) -> None:
    """--chapters releases only the given chapters, and README contains no links to other notebooks."""
    edition = make_release(tmp_path / "some", chapters=("05", "06"))
    names = [path.name for path in sorted((edition / "notebooks").iterdir())]
    assert names == ["05_write_a_server.ipynb", "06_write_a_client.ipynb"]
    text = (edition / "README.md").read_text("utf-8")
    assert "This edition has chapters 05 and 06." in text
    assert re.findall(r"^\| (\d\d) \|", text, re.MULTILINE) == ["05", "06"]
    linked = {name for path in (edition / "notebooks").iterdir() for name in links(read(path))}
    assert linked <= set(names)
    shown = python_in(
        edition, "from course_pkg import progress; print(progress())", COURSE_STATE=str(tmp_path)
    )
    assert re.findall(r"^  (\d\d)  ", shown, re.MULTILINE) == ["05", "06"]


def links(notebook: Notebook) -> list[str]:
    """Return the notebooks that a notebook links to."""
    text = "\n".join(cell["source"] for cell in notebook["cells"])
    return re.findall(r"\]\((\d\d_\w+\.ipynb)", text)


@pytest.mark.slow
@pytest.mark.timeout(900)
def test_the_edition_sets_itself_up_and_passes_all_answers_of_a_chapter(
    edition: Path, tmp_path: Path
) -> None:
    """In a new clone, `./course run` works, and right answers pass all checks of a chapter."""
    git(tmp_path, "clone", "--quiet", str(edition), "clone")
    clone = tmp_path / "clone"
    notebook = clone / "notebooks" / "05_write_a_server.ipynb"
    solution = {cell["id"]: cell for cell in read(ROOT / "solutions" / notebook.name)["cells"]}
    filled = json.loads(notebook.read_text("utf-8"))
    for cell in filled["cells"]:
        if exercise_of(cell):
            cell["source"] = solution[cell["id"]]["source"]
    notebook.write_text(json.dumps(filled), "utf-8")
    variables = {name: value for name, value in os.environ.items() if not name.startswith("ROS_")}
    env = {**variables, "XDG_CACHE_HOME": str(tmp_path / "cache"), "COURSE_STATE": str(tmp_path / "state")}
    command = ["./course", "run", "jupyter", "execute", "--inplace", str(notebook)]
    done = subprocess.run(command, cwd=clone, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    passed = set(re.findall(r"(05\.\d) passed", notebook.read_text("utf-8")))
    assert passed == {part.check for part in parts_of("05")}
