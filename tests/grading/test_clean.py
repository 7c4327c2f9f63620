"""Tests of functions that remove harmful characters from texts in submissions."""

from __future__ import annotations

import pytest

from course_pkg.grading import clean

NASTY = {
    "colours": ("\x1b[31mred\x1b[0m", "red"),
    "a title for the terminal": ("\x1b]0;owned\x07x", "x"),
    "a link of the terminal": ("\x1b]8;;http://x.example\x1b\\label\x1b]8;;\x1b\\", "label"),
    "an eight-bit escape": ("\x9b31mred", "red"),
    "a lone escape at the end": ("x\x1b", "x"),
    "control characters": ("a\x00b\x07c\x7fd\x85e", "abcde"),
    "letters turned round": ("abc\u202efdp.exe\u202c\u2066x\u2069", "abcfdp.exex"),
    "letters unseen": ("a\u200bb\ufeffc\u00add\U000e0041", "abcd"),
    "half of a pair": ("a\ud800b", "a\ufffdb"),
    "no character": ("a\ufffeb\uffffc", "a\ufffdb\ufffdc"),
    "line ends": ("a\r\nb\rc\u2028d", "a\nb\nc\nd"),
    "left alone": ("größe → m²\t✓ 👩‍🔬", "größe → m²\t✓ 👩‍🔬"),
}


@pytest.mark.parametrize(("given", "kept"), NASTY.values(), ids=NASTY)
def test_harmful_characters_are_removed(given: str, kept: str) -> None:
    """The cleaned text contains no terminal codes and no invisible characters."""
    assert clean.text(given) == kept
    assert clean.text(clean.text(given)) == kept


@pytest.mark.parametrize(
    "given", ["x" * 10_000_000, "\n" * 100_000, "\x1b[" * 100_000, "\x1b]" * 100_000 + "y"]
)
def test_length_is_bounded(given: str) -> None:
    """The function shortens a long text, and a second cleaning does not change the result."""
    kept = clean.text(given)
    assert len(kept) <= clean.LONG
    assert kept.count("\n") <= clean.LINES
    assert clean.text(kept) == kept


def test_cut_text_has_a_mark() -> None:
    """A shortened text ends with "… (cut)"."""
    assert clean.text("x" * 5000).endswith("… (cut)")


def test_a_line_is_one_line() -> None:
    """Line ends and tabs become spaces."""
    assert clean.line(" a\n\tb\r\nc ") == "a b c"


@pytest.mark.parametrize(
    "start", ["=", "+", "-", "@", "\t=", "\r=", "\n=", " =", "\x00=", "\u200b=", "\uff1d"]
)
def test_no_cell_is_a_formula(start: str) -> None:
    """A text that begins like a formula gets a leading quote, so a spreadsheet does not evaluate the text."""
    assert clean.cell(start + "HYPERLINK(1)").startswith("'")


def test_markup_is_text() -> None:
    """Markup is escaped, even in an attribute."""
    assert clean.html("<script>'\"&") == "&lt;script&gt;&#x27;&quot;&amp;"


def test_data_of_any_shape_is_cleaned() -> None:
    """The function cleans the strings and keys of nested lists and dicts, and shortens long lists."""
    given = {"a\x1b[1m": ["\x00x", 1.5, None, True, {"k": "\ud800"}], "n": list(range(5000))}
    cleaned = clean.record(given)
    assert cleaned["a"] == ["x", 1.5, None, True, {"k": "\ufffd"}]
    assert len(cleaned["n"]) == clean.ITEMS


@pytest.mark.parametrize("name", ["s01", "anna.b-c_1", "0"])
def test_a_plain_name_stays(name: str) -> None:
    """If a student's name contains only usual characters, it is also the name of the student's file."""
    assert clean.file_name(name) == name


WILD = [
    *(
        "../x",
        "..",
        ".",
        "",
        "/etc/passwd",
        "C:\\x",
        "CON",
        "con",
        "nul.txt",
        "com1",
        "a/b",
        "a\\b",
        ".hidden",
    ),
    *("a b", "Ä", "\ud800", "x" * 500, "a\x00b", "x.", "a..b", "-rf", "~", "$(id)", "S01", "a:b", "名前"),
]


def test_unusual_name_stays_in_its_folder() -> None:
    """A file name contains no separators, device names or leading dots."""
    names = [clean.file_name(name) for name in WILD]
    for name in names:
        assert clean.PLAIN_NAME.fullmatch(name), name
        assert not clean.DEVICES.fullmatch(name)
        assert ".." not in name
        assert len(name) <= clean.NAME
    assert len({name.lower() for name in names}) == len(WILD)


def test_changed_names_stay_different() -> None:
    """Two students always have different file names."""
    changed = clean.file_name("S01")
    assert changed != clean.file_name("s01")
    assert clean.file_name(changed) != changed


def test_a_student_keeps_the_name() -> None:
    """Different Unicode forms of one name become the same name.

    Two different names stay different after cleaning.
    """
    assert clean.identity("Größe_12") == clean.identity("Gro\u0308ße_12") == "Größe_12"
    assert clean.identity("a\x00") != clean.identity("a")
    assert clean.identity("a\ud800") != clean.identity("a\ud801")
