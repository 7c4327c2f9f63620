"""Tests of the function that removes nbval markers and cell magics from an answer."""

from __future__ import annotations

import pytest
from IPython.core.inputtransformer2 import TransformerManager
from nbval.plugin import comment_markers, find_comment_markers, metadata_tags

from course_pkg.grading.rebuild.defusing import MARKERS, TAGS, defuse, magic_of

DEF = "def f():\n    return 1"


def test_the_markers_are_those_of_nbval() -> None:
    """The list of markers in the course is equal to the list in nbval."""
    assert set(MARKERS) == set(comment_markers)
    assert set(metadata_tags) < set(TAGS)


@pytest.mark.parametrize("marker", MARKERS)
@pytest.mark.parametrize(
    "shape",
    [
        "# {}\n" + DEF,
        "#{}\n" + DEF,
        DEF + "\n    # {}",
        "  ###   {}  \n" + DEF,
        'x = """\n# {}\n"""',
        DEF + "\x0c# {}",
        DEF + "\r# {}\r",
        DEF + "\u2028# {}",
        DEF + "\x1c#{}\x1d",
        "# x\r\n# {}\r\n# {}",
        "#\x00 {}",
        "# {}\ud800\n# {}",
    ],
)
def test_markers_have_no_effect(marker: str, shape: str) -> None:
    """The rebuilt answer contains no nbval marker, and a note describes the removed marker."""
    made = defuse(shape.replace("{}", marker))
    assert list(find_comment_markers(made.source)) == []
    assert any(marker in note for note in made.notes)


MAGICS = [
    *("%%script true", "%%bash", "%%javascript", "%%capture", "%%time", "%%writefile x.py", "%%html"),
    *("%%bash?", "%%x"),
]
BEFORE = ["", "\n\n", "  \n\t\n", ">>> ", "In [1]: ", "\x0c\n", "\r\n"]


@pytest.mark.parametrize("magic", MAGICS)
@pytest.mark.parametrize("before", BEFORE)
def test_magic_of_a_cell_is_removed(magic: str, before: str) -> None:
    """The function removes the cell magic, and the other lines run as Python."""
    made = defuse(f"{before}{magic}\n{DEF}")
    code = TransformerManager().transform_cell(made.source)
    assert "run_cell_magic" not in code
    names: dict[str, object] = {}
    exec(code, names)  # noqa: S102 -- it is the test's code
    assert "f" in names
    assert "was removed" in made.notes[0]


def test_a_magic_below_a_magic() -> None:
    """After the first magic, the function also removes a magic in the next line."""
    made = defuse("%%time\n%%script true\n" + DEF)
    assert magic_of(made.source) == ""


def test_an_indented_cell_with_a_magic() -> None:
    """An indented first line with %% counts as a magic."""
    assert "was removed" in defuse("  %%script true\n  x = 1").notes[0]


WRITES = "%%writefile src/a.srv"


@pytest.mark.parametrize(
    ("source", "notes"),
    [
        (f"{WRITES}\nint8 a", 0),
        ("\n%%writefile   src/a.srv \nint8 a", 0),
        ("int8 a", 1),
        ("%%writefile /etc/passwd\nint8 a", 1),
        ("%%writefile -a src/a.srv\nint8 a", 1),
        ("%%bash\nint8 a", 1),
        ("%%script true\nint8 a", 1),
    ],
)
def test_a_cell_that_writes_a_file_writes_that_file(source: str, notes: int) -> None:
    """The line with %%writefile comes from the reference solution. All other lines come from the student."""
    made = defuse(source, WRITES)
    assert made.source == f"{WRITES}\nint8 a"
    assert len(made.notes) == notes


def test_invalid_characters_are_removed() -> None:
    """The function removes null characters and unpaired surrogates, and ends each line with LF."""
    made = defuse("x = 1\x00\r\ny = '\ud800'\rz = 2")
    assert made.source == "x = 1\ny = '?'\nz = 2"
    made.source.encode()
    assert made.notes


@pytest.mark.parametrize(
    "source",
    [
        DEF,
        "",
        "%time f()\n" + DEF,
        "x = 5 %% 3",
        "# %%bash\n" + DEF,
        "# NBVAL_SKIPPED\n" + DEF,
        "x = 1 # NBVAL_SKIP",
    ],
)
def test_an_ordinary_answer_is_left_alone(source: str) -> None:
    """A harmless answer does not change and gets no note."""
    assert defuse(source) == type(defuse(""))(source)
