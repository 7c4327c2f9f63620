"""Answers that are equal to the course's solution get a flag."""

from __future__ import annotations

from tests.grading.flags.classes import flags_of, solutions, submission


def test_the_whole_solution() -> None:
    """If all answers are equal to the solution, each answer gets a flag, even with additional comments."""
    commented = {part: f"{source}\n# mine" for part, source in solutions("05").items()}
    flags = flags_of(["solution"], submission("s01", commented), submission("s02", {}))
    assert [flag.where for flag in flags["s01"]] == ["05.1", "05.2", "05.3", "05.4", "05.5"]
    assert set(flags) == {"s01"}


def test_one_short_answer() -> None:
    """A short answer that is equal to the solution gets no flag."""
    assert flags_of(["solution"], submission("s01", {"05.2": solutions("05")["05.2"]})) == {}


def test_the_solution_with_other_names() -> None:
    """A long answer that is equal to the solution except for variable names gets a flag."""
    changed = solutions("05")["05.5"].replace("moves", "number").replace("changed", "different")
    (flag,) = flags_of(["solution"], submission("s01", {"05.5": changed}))["s01"]
    assert flag.words.startswith("The answer differs from the course's solution only in names")
