"""Tests of the notebook that the course rebuilds from the reference solution and a student's answers."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path

import nbformat
import pytest

from course_pkg.authoring.cells import Cell, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, derived, read, text_of
from course_pkg.authoring.validate import validate
from course_pkg.grading.rebuild.rebuilder import Rebuilt, rebuild
from tests.authoring.books import book, check, code, exercise, text
from tests.grading.handing_in import raw

Cells = list[Cell]
SOLUTION = 'def double(x):\n    """Twice x."""\n    return 2 * x\n\n\nserve("/double", double)'
BLANK = 'def double(x):\n    """Twice x."""\n    ...\n\n\nserve("/double", double)'
ANSWER = 'def double(x):\n    """Twice x."""\n    return x + x\n\n\nserve("/double", double)'
OTHER = ANSWER.replace("x + x", "x << 1")
COUNTER = "class Counter:\n    def count(self):\n        return 1\n\n\ncounter = Counter()"
WRITES = "%%writefile a.srv\n# Sides.\nint8 a"
D, C, W = "exercise-05-1", "exercise-05-2", "exercise-05-3"
REFERENCE = book(
    text("# Title", "title"),
    code("import math\n\n\ndef serve(name, handler):\n    pass", id="setup"),
    exercise("05.1", source=SOLUTION)
    | {"execution_count": 2, "outputs": [{"output_type": "stream", "name": "stdout", "text": "x"}]},
    check("05.1"),
    exercise("05.2", source=COUNTER),
    check("05.2"),
    text("Between.", "between"),
    exercise("05.3", source=WRITES),
    check("05.3"),
)


def _student(change: Callable[[Cells], object] = lambda _: None, **answers: str) -> bytes:
    """Make a student's notebook with these answers, change its cells, and return the notebook.

    The keys of `answers` are "d", "c" and "w", for the cells D, C and W.
    """
    notebook = derived(copy.deepcopy(REFERENCE))
    for cell in notebook["cells"]:
        letter = {D: "d", C: "c", W: "w"}.get(cell["id"], "")
        cell["source"] = answers.get(letter, cell["source"])
    change(notebook["cells"])
    return raw(notebook)


def _place(cells: Cells, name: str) -> int:
    return next(place for place, cell in enumerate(cells) if cell["id"] == name)


def _copied(cells: Cells, name: str, source: str, shift: int = 1) -> None:
    """Copy a cell in the same way as JupyterLab: the copy has a new id and the same metadata."""
    place = _place(cells, name)
    cells.insert(
        place + shift, {**copy.deepcopy(cells[place]), "id": f"copy-{shift}-{len(cells)}", "source": source}
    )


def _own(cells: Cells, name: str, *sources: str, shift: int = 1) -> None:
    """Insert a student's additional cells below the named cell.

    If `shift` is 0, insert the cells above the named cell.
    """
    place = _place(cells, name) + shift
    cells[place:place] = [code(source, id=f"own-{place}-{number}") for number, source in enumerate(sources)]


def _rebuilt(content: bytes) -> Rebuilt:
    """Rebuild a submission, and assert what must be true for every rebuilt submission."""
    before = copy.deepcopy(REFERENCE)
    made = rebuild(REFERENCE, content)
    assert before == REFERENCE
    parts = {"05.1", "05.2", "05.3"}
    assert set(made.answers) | set(made.missing) == parts
    assert not set(made.answers) & set(made.missing)
    assert made.untouched <= set(made.answers)
    assert len(made.notebook["cells"]) == len(REFERENCE["cells"])
    for given, cell in zip(REFERENCE["cells"], made.notebook["cells"], strict=True):
        if part := exercise_of(given):
            assert cell["source"] == made.answers.get(part, cell["source"])
            assert (cell["outputs"], cell["execution_count"]) == ([], None)
            assert "return 2 * x" not in cell["source"]
            assert {**cell, "source": "", "outputs": [], "execution_count": None} == {
                **given,
                "source": "",
                "outputs": [],
                "execution_count": None,
            }
        else:
            assert cell == given
    text_of(made.notebook)
    json.dumps([made.notes, dict(made.missing)]).encode()
    return made


def test_an_answer_is_placed() -> None:
    """Only the exercise cells of the reference notebook get the student's answers."""
    made = _rebuilt(_student(d=ANSWER))
    assert made.answers["05.1"] == ANSWER
    assert made.untouched == {"05.2", "05.3"}
    assert made.notes == ()


@pytest.mark.parametrize("path", NotebookStore().solutions(), ids=lambda path: path.stem)
def test_every_chapter(path: Path) -> None:
    """A solution contains an answer to each exercise.

    In the notebook for students, each exercise is blank.
    """
    reference = read(path)
    full = rebuild(reference, path.read_bytes())
    blank = rebuild(reference, raw(derived(reference)))
    parts = {part for cell in reference["cells"] if (part := exercise_of(cell))}
    assert set(full.answers) == set(blank.answers) == blank.untouched == parts
    assert (full.untouched, full.notes, full.missing, blank.notes) == (frozenset(), (), {}, ())
    sources = {exercise_of(cell): cell["source"] for cell in reference["cells"]}
    assert dict(full.answers) == {part: sources[part] for part in parts}


def _split_at(source: str, line: int) -> tuple[str, str]:
    lines = source.split("\n")
    return "\n".join(lines[:line]), "\n".join(lines[line:])


def _gone(cells: Cells) -> None:
    for cell in cells:
        cell.pop("id")


def _split(cells: Cells, at: int, *, metadata: bool, keep: int = 0) -> None:
    place = _place(cells, D)
    halves = _split_at(ANSWER, at)
    made = [code(half, id=f"half-{number}") for number, half in enumerate(halves)]
    made[keep]["id"] = D if not metadata else "new"
    for number, cell in enumerate(made):
        if metadata or number == keep:
            cell["metadata"] = copy.deepcopy(cells[place]["metadata"])
    cells[place : place + 1] = made


TAKEN = {
    "copied, the copy filled in": lambda cells: _copied(cells, D, ANSWER),
    "copied, the copy far below": lambda cells: _copied(cells, D, ANSWER, shift=5),
    "copied, the copy above": lambda cells: _copied(cells, D, ANSWER, shift=0),
    "the same id twice": lambda cells: cells.insert(9, {**cells[_place(cells, D)], "source": ANSWER}),
    "moved": lambda cells: cells.append({**cells.pop(_place(cells, D)), "source": ANSWER}),
    "no ids": lambda cells: (cells[_place(cells, D)].update(source=ANSWER), _gone(cells)),
    "another id": lambda cells: cells[_place(cells, D)].update(source=ANSWER, id="x"),
    "no metadata": lambda cells: cells[_place(cells, D)].update(source=ANSWER, metadata={}),
    "metadata of another kind": lambda cells: cells[_place(cells, D)].update(source=ANSWER, metadata=[]),
    "neither": lambda cells: cells[_place(cells, D)].update(source=ANSWER, metadata={}, id="x"),
    "a list of lines": lambda cells: cells[_place(cells, D)].update(source=ANSWER.splitlines(keepends=True)),
    "in a cell of its own, the blank left": lambda cells: _own(cells, "between", ANSWER),
    "split in a function": lambda cells: _split(cells, 2, metadata=False),
    "split in a function, both with metadata": lambda cells: _split(cells, 2, metadata=True),
    "split between function and call": lambda cells: _split(cells, 4, metadata=False),
    "split between function and call, both with metadata": lambda cells: _split(cells, 4, metadata=True),
}


@pytest.mark.parametrize("change", TAKEN.values(), ids=TAKEN)
def test_the_answer_is_found(change: Callable[[Cells], object]) -> None:
    """The search finds an answer even if its cell was copied, moved or split."""
    made = _rebuilt(_student(change))
    assert [line for line in made.answers["05.1"].split("\n") if line] == [
        line for line in ANSWER.split("\n") if line
    ]
    assert made.untouched == {"05.2", "05.3"}


@pytest.mark.parametrize("kind", ["markdown", "raw"])
def test_a_cell_of_another_kind(kind: str) -> None:
    """If the cell of an exercise is a Markdown cell, the text of the cell counts as code."""

    def change(cells: Cells) -> None:
        cells[_place(cells, D)].update(cell_type=kind, source=ANSWER)

    made = _rebuilt(_student(change))
    assert made.answers["05.1"] == ANSWER
    assert "not a code cell" in made.notes[0]
    made = _rebuilt(_student(lambda cells: (_copied(cells, D, OTHER), change(cells))))
    assert made.answers["05.1"] == OTHER


def test_last_of_several_answers_is_used() -> None:
    """If there are several answers, the last answer counts and gets a note."""
    made = _rebuilt(_student(lambda cells: _copied(cells, D, OTHER), d=ANSWER))
    assert made.answers["05.1"] == OTHER
    assert made.notes == ("05.1: 2 cells answer this exercise. Only the last of these cells was used.",)


def test_identical_copy_leads_to_no_note() -> None:
    """If a copied exercise cell has the same answer, no code or a blank exercise, there is no note."""
    for source in (ANSWER, "", BLANK):
        made = _rebuilt(_student(lambda cells, source=source: _copied(cells, D, source), d=ANSWER))
        assert (made.answers["05.1"], made.notes) == (ANSWER, ())


def test_a_helper_split_off_belongs_to_the_answer() -> None:
    """If the answer uses a function from a later cell, the rebuilt notebook contains this cell."""
    answer = ANSWER.replace("x + x", "helper(x)")
    helper = "def helper(x):\n    return x + x"
    made = _rebuilt(_student(lambda cells: _own(cells, D, "print('try')", helper, "double(3)"), d=answer))
    assert made.answers["05.1"] == f"{answer}\nprint('try')\n{helper}"
    assert "The answer was in 3 cells" in made.notes[0]


def test_a_file_that_was_split() -> None:
    """If a student has split a cell that writes a file, the rebuilder joins the two cells."""

    def change(cells: Cells) -> None:
        _copied(cells, W, "int16 b")

    made = _rebuilt(_student(change, w=WRITES))
    assert made.answers["05.3"] == f"{WRITES}\nint16 b"


@pytest.mark.parametrize(
    "source",
    ["double(21)", "x = double(1)\nprint(x)", "while True:\n    pass", "%%bash\n  ls", "!ls", "# thoughts"],
)
def test_cells_that_the_answer_does_not_need_are_left_out(source: str) -> None:
    """The rebuilt notebook does not contain a cell that the answer does not need."""
    made = _rebuilt(_student(lambda cells: _own(cells, D, source), d=ANSWER))
    assert (made.answers["05.1"], made.notes) == (ANSWER, ())


@pytest.mark.parametrize("shift", [-1, 0, 3])
def test_a_helper_elsewhere_is_named(shift: int) -> None:
    """If a helper function is in a cell that is not used, a note contains the function's name."""
    answer = ANSWER.replace("x + x", "helper(x)")
    made = _rebuilt(
        _student(lambda cells: _own(cells, D, "def helper(x):\n    return x + x", shift=shift), d=answer)
    )
    assert made.answers["05.1"] == answer
    assert "helper" in made.notes[0]
    assert "all the code of the answer" in made.notes[0]


def test_an_import_in_a_given_cell_is_named() -> None:
    """A student's change in a cell of the course has no effect, and the student gets a note."""
    answer = ANSWER.replace("x + x", "numpy.add(x, math.floor(x))")

    def change(cells: Cells) -> None:
        cells[_place(cells, "setup")]["source"] += "\nimport numpy"

    made = _rebuilt(_student(change, d=answer))
    assert "numpy" in made.notes[0]
    assert "math" not in made.notes[0]


def test_missing_answer_has_a_reason() -> None:
    """If an answer is missing, the rebuilt notebook contains the blank exercise."""

    def change(cells: Cells) -> None:
        del cells[_place(cells, D)]
        cells[_place(cells, C)]["source"] = " \n"
        del cells[_place(cells, W)]

    made = _rebuilt(_student(change))
    assert made.answers == {}
    assert made.notes == tuple(f"{part}: {why}" for part, why in made.missing.items())
    assert "defines double" in made.missing["05.1"]
    assert "empty" in made.missing["05.2"]
    assert "writes a.srv" in made.missing["05.3"]
    assert made.notebook["cells"][2]["source"] == BLANK


def test_an_answer_of_absurd_length() -> None:
    """The program does not run an answer that is too long."""
    made = _rebuilt(_student(d=ANSWER + "\n#" + "x" * 100_001))
    assert "100000 characters" in made.missing["05.1"]


def test_id_decides_between_different_metadata() -> None:
    """If the id and the metadata of a cell belong to different exercises, the id selects the exercise."""

    def change(cells: Cells) -> None:
        cells[_place(cells, D)].update(metadata={"course": {"exercise": "05.2"}}, source=ANSWER)
        cells.append(code("x = 1", id="x", course={"exercise": "99.9"}))
        cells.append(code("x = 1", id="y", course={"exercise": ["05.2"]}))

    made = _rebuilt(_student(change))
    assert made.answers["05.1"] == ANSWER
    assert "05.2" in made.untouched


def test_tags_and_metadata_of_the_student_stay_out() -> None:
    """A student's tags have no effect and lead to a note."""

    def change(cells: Cells) -> None:
        cells[_place(cells, D)]["metadata"]["tags"] = ["nbval-skip", "raises-exception", "mine"]

    made = _rebuilt(_student(change, d=ANSWER))
    assert made.notes == (
        "05.1: The tag nbval-skip, raises-exception on the exercise's cell does not change the grade.",
    )


def test_markers_and_magics_are_removed() -> None:
    """The program removes markers of nbval and cell magics from answers, and adds a note for each removal."""
    made = _rebuilt(_student(d="%%script true\n# NBVAL_SKIP\n" + ANSWER))
    assert made.answers["05.1"] == "# %%script has no effect here\n# (NBVAL_SKIP)\n" + ANSWER
    assert len(made.notes) == 2


def test_checks_and_given_cells_do_not_change() -> None:
    """The program ignores changes to the checks and to the given cells."""

    def change(cells: Cells) -> None:
        for cell in cells:
            if cell["id"] not in (D, C, W):
                cell.update(source="raise SystemExit", metadata={"tags": ["nbval-skip"]})

    _rebuilt(_student(change, d=ANSWER))


@pytest.mark.parametrize(
    "content", [b"", b"{", b"[]", b"\xff", b'{"cells": 1}', b'{"cells": ' + b"[" * 100_000]
)
def test_what_is_no_notebook(content: bytes) -> None:
    """If the file is not a notebook, the result contains a reason for the missing answer to each part."""
    made = _rebuilt(content)
    assert made.problem
    assert set(made.missing.values()) == {made.problem}


@pytest.mark.parametrize(
    "cell",
    [
        None,
        3,
        [],
        {},
        {"id": 3},
        {"source": {"a": 1}},
        {"source": [1, "x = 1", None]},
        {"cell_type": ["code"]},
        {"metadata": {"course": [1], "tags": "x"}},
    ],
)
def test_cells_that_are_none(cell: object) -> None:
    """The program ignores invalid cells, and grades the other cells."""
    made = _rebuilt(_student(lambda cells: cells.insert(0, cell), d=ANSWER))  # type: ignore[arg-type]
    assert made.answers["05.1"] == ANSWER


@pytest.mark.parametrize("version", [2, 3])
def test_an_old_format(version: int) -> None:
    """The program finds the answers in notebooks of the old formats 2 and 3."""
    notebook = nbformat.from_dict(json.loads(_student(d=ANSWER, c=COUNTER, w=WRITES)))
    old = nbformat.convert(notebook, version)
    made = _rebuilt(json.dumps(old).encode())
    assert (made.answers["05.1"], made.answers["05.2"]) == (ANSWER, COUNTER)
    assert made.answers["05.3"] == WRITES


MANY = {
    "of the same exercise": lambda number: code(
        f"x{number} = {number}", id=f"m{number}", course={"exercise": "05.1"}
    ),
    "copies of the answer": lambda number: code(ANSWER, id=f"m{number}", course={"exercise": "05.1"}),
    "of the student's": lambda number: code(
        f"def f{number}():\n    return double({number})", id=f"m{number}"
    ),
    "that look split off": lambda number: code("    return 1", id=f"m{number}"),
    "with no id": lambda _: {"cell_type": "code", "source": "x = 1\n" * 100},
    "without a kind": lambda _: {},
    "that write the file": lambda number: code(WRITES + str(number), id=f"m{number}"),
}


@pytest.mark.parametrize("made_of", MANY.values(), ids=MANY)
def test_ten_thousand_cells(made_of: Callable[[int], Cell]) -> None:
    """The program rebuilds a notebook with ten thousand cells quickly."""

    def change(cells: Cells) -> None:
        place = _place(cells, D) + 1
        cells[place:place] = [made_of(number) for number in range(10_000)]

    made = _rebuilt(_student(change, d=ANSWER))
    assert len(made.notes) <= 40


@pytest.mark.parametrize(
    "source",
    [
        "x" * 99_000,
        "(" * 99_000,
        "=" * 99_000,
        "def " * 24_000,
        "\n" * 99_000,
        "import " + "a," * 40_000,
        "x:" * 40_000,
        "%%" * 40_000,
    ],
)
def test_sources_built_to_take_long(source: str) -> None:
    """The program reads sources with very long lines quickly."""
    _rebuilt(_student(lambda cells: _own(cells, D, source), d=source, c=source, w=source))


def test_nbval_runs_it(tmp_path: Path) -> None:
    """A run of nbval compares all outputs except those of exercise cells."""
    done = {"output_type": "execute_result", "execution_count": 2, "metadata": {}}
    reference = book(
        exercise("05.1", source="def double(x):\n    return 2 * x"),
        code("double(2)", id="b", execution_count=2, outputs=[{**done, "data": {"text/plain": "4"}}]),
    )
    reference["metadata"] = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    answers = (
        "print('mine')\ndef double(x):\n    return x + x",
        "# NBVAL_SKIP\ndef double(x):\n    return 3 * x",
    )
    paths = [tmp_path / str(number) / f"n{number}.ipynb" for number in range(2)]
    for path, answer in zip(paths, answers, strict=True):
        student = copy.deepcopy(reference)
        student["cells"][0]["source"] = answer
        path.parent.mkdir()
        path.write_text(text_of(rebuild(reference, raw(student)).notebook))
    run = validate(paths, workers=1)
    assert "1 failed, 3 passed" in run.stdout
    assert "n1.ipynb::Cell 1" in run.stdout
