"""Tests of the run of a student's notebook with nbval in a sandbox."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import nbformat
import pytest

from course_pkg.authoring.cells import Notebook
from course_pkg.checking.parts import parts_of
from course_pkg.grading.nbval.validation import outcomes_of
from course_pkg.setup import Places


def notebook(*cells: tuple[str, str], check: str = "") -> Notebook:
    """Return a notebook; each element of `cells` is a pair of a source and its expected output.

    If the id of a part is given, the last cell is the check of this part.
    """
    made = nbformat.v4.new_notebook()
    for number, (source, shown) in enumerate(cells):
        cell = nbformat.v4.new_code_cell(source, id=f"cell-{number}", execution_count=number + 1)
        if shown:
            output = nbformat.v4.new_output(
                "execute_result", {"text/plain": shown}, execution_count=number + 1
            )
            cell["outputs"] = [output]
        made["cells"].append(cell)
    if check:
        made["cells"][-1]["metadata"]["course"] = {"check": check}
    return dict(made)


@pytest.mark.usefixtures("sandbox")
def test_each_cell_is_compared_with_its_stored_output() -> None:
    """A cell passes if its output is equal to the stored output."""
    seen = outcomes_of(notebook(("1 + 1", "2"), ("1 + 1", "3"), ("'over'", "'over'")))
    assert [(each.cell, each.outcome) for each in seen] == [
        ("cell-0", "passed"),
        ("cell-1", "failed"),
        ("cell-2", "passed"),
    ]
    assert seen[1].finding


@pytest.mark.usefixtures("sandbox")
def test_the_kernel_sees_neither_what_is_expected_nor_a_check() -> None:
    """The kernel cannot read the notebook's file or the checks, and lo is its only network interface."""
    probe = """
import glob, os, pathlib, socket
import course_pkg.chapters as chapters
folders = ("/tmp", "/student", "/run")
found = [path for folder in folders for path in glob.glob(f"{folder}/**/*.ipynb", recursive=True)]
files = [path for folder in chapters.__path__ for path in glob.glob(f"{folder}/ch*/**/*.*", recursive=True)]
secret = [path for path in files if "checks" in path or path.endswith(("answers.py", "fixtures.py"))]
names = [path for path in secret if os.path.getsize(path)]
lines = [pathlib.Path(path).read_text() for path in glob.glob("/proc/[0-9]*/cmdline")]
(found, names, [line for line in lines if "pytest" in line], [name for _, name in socket.if_nameindex()])
"""
    (seen,) = outcomes_of(notebook((probe, "([], [], [], ['lo'])")))
    assert seen.outcome == "passed", seen.finding


@pytest.mark.usefixtures("sandbox")
def test_a_kernel_that_ends_is_noticed_in_time() -> None:
    """If a cell ends the kernel, the run ends long before nbval's time limit."""
    seen = outcomes_of(notebook(("import os; os._exit(0)", ""), ("1", "1")), cell=4)
    assert [each.outcome for each in seen] != ["passed", "passed"]


@pytest.mark.usefixtures("sandbox")
def test_a_kernel_with_damaged_connections_is_ended() -> None:
    """If a cell damages the kernel's connections, the run ends, and the earlier cells have results."""
    damage = (
        "import os\nfor number in range(3, 200):\n    try:\n        os.set_blocking(number, False)\n"
        "        os.write(number, b'{\"record\": 1}\\n')\n    except OSError:\n        pass\n"
    )
    seen = outcomes_of(notebook(("1 + 1", "2"), (damage, ""), ("3", "3")), cell=2, timeout=100)
    assert [each.outcome for each in seen][:2] == ["passed", "failed"]


def plain_nbval(path: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run pytest on a student's notebook with the course's plug-in."""
    plugin = ["-p", "course_pkg.grading.nbval.plugin", "-p", "no:cacheprovider"]
    command = [sys.executable, "-m", "pytest", "-q", "-c", "/dev/null", "--nbval", *plugin, *words, str(path)]
    return subprocess.run(command, capture_output=True, text=True, cwd=path.parent, timeout=100, check=False)


def chapter_three(folder: Path, *headlines: str, first: str = "1") -> Path:
    """Write a notebook with checks of 03.1, 03.2 and so on, and return its path."""
    shows = "from IPython.display import display\ndisplay({{'text/plain': {!r}}}, raw=True)"
    made = notebook((first, "1"), *((shows.format(each), "") for each in headlines))
    for number, cell in enumerate(made["cells"][1:], 1):
        cell["metadata"]["course"] = {"check": f"03.{number}"}
        # Each output is equal to the stored output, so nbval without the plug-in would pass this notebook.
        data = {"text/plain": headlines[number - 1]}
        cell["outputs"] = [nbformat.v4.new_output("display_data", data)]
    path = folder / "chapter.ipynb"
    path.write_text(json.dumps(made))
    return path


PASSED = [f"{part.check} passed: {part.points} of {part.points} points" for part in parts_of("03")]


def test_plain_nbval_passes_if_all_checks_passed(tmp_path: Path) -> None:
    """The plug-in prints one line for each passed part."""
    done = plain_nbval(chapter_three(tmp_path, *PASSED))
    lines = done.stdout.splitlines()
    assert done.returncode == 0, done.stdout
    assert _after(lines, "parts of the course")[: len(PASSED) + 1] == [
        *PASSED,
        f"{len(PASSED)} parts, and all of them passed.",
    ]


@pytest.mark.parametrize(
    ("headlines", "line"),
    [
        ([PASSED[0], "03.2 not yet: 0 of 2 points", *PASSED[2:]], "03.2 not yet: 0 of 2 points"),
        ([PASSED[0], "something else", *PASSED[2:]], "03.2 not examined"),
        (PASSED[:-1], f"{PASSED[-1].split()[0]} not examined: its check is not in the notebook"),
    ],
)
def test_plain_nbval_fails_if_points_are_missing(tmp_path: Path, headlines: list[str], line: str) -> None:
    """If a check failed, did not run or was removed, the pytest run fails."""
    done = plain_nbval(chapter_three(tmp_path, *headlines))
    assert done.returncode == 1, done.stdout
    assert line in _after(done.stdout.splitlines(), "parts of the course")


def test_course_run_adds_the_plug_in(tmp_path: Path) -> None:
    """`course run pytest --nbval` always uses the plug-in.

    If the comment NBVAL_SKIP skips a check, the run fails.
    """
    path = chapter_three(tmp_path, *PASSED)
    made = json.loads(path.read_text())
    made["cells"][2]["source"] = f"# NBVAL_SKIP\n{made['cells'][2]['source']}"
    path.write_text(json.dumps(made))
    command = [Places.of().checkout / "course", "run", "pytest", "-q", "--nbval", path]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=100, check=False)
    assert done.returncode == 1, done.stdout
    assert "03.2 not examined" in _after(done.stdout.splitlines(), "parts of the course")


def _after(lines: Sequence[str], title: str) -> list[Any]:
    start = next(number for number, line in enumerate(lines) if title in line)
    return list(lines[start + 1 :])
