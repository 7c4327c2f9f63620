"""What a turtle may be called."""

from __future__ import annotations

import pytest

from course_pkg.turtlesim.names import objection


@pytest.mark.parametrize("name", ["MyTurtle", "a", "a/b", "/left/turtle", "t_1"])
def test_sound_names(name: str) -> None:
    """Names of the graph, with namespaces too."""
    assert objection(name) == ""


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("hello world", "Character [ ] at element [5] is not valid in Graph Resource Name [hello world]."),
        ("1st", "Character [1] is not valid as the first character in Graph Resource Name [1st]."),
        ("ä", "Character [ä] is not valid as the first character"),
        ("a-b", "Character [-] at element [1]"),
        ("a\n", "Character [\n] at element [1]"),
        ("~a", "Using ~ names"),
        (" ", "Character [ ] is not valid as the first character"),
    ],
)
def test_what_is_wrong_is_named(name: str, words: str) -> None:
    """The refusal names the character and where it stands, as roscpp's does."""
    assert words in objection(name)
