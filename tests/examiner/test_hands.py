"""The hands in the kernel do what they are asked, in bounded time, and say what came of it."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from course_pkg.examiner.hands import Hands


def ask(namespace: dict[str, Any], folder: Path | None = None, **question: Any) -> dict[str, Any]:  # noqa: ANN401
    """Return the answer to one question."""
    return Hands(namespace, folder).answer({"ask": 1, **question})


def call(namespace: dict[str, Any], *args: Any, within: float = 1.0) -> dict[str, Any]:  # noqa: ANN401
    """Return what came of calling `f`."""
    return ask(namespace, do="call", name="f", args=list(args), kwargs={}, within=within)


def test_a_value_comes_with_what_was_printed() -> None:
    """The value is plain, and the print is kept from the cell's own output."""
    answer = call({"f": lambda a: (print("hello"), a + 1)[1]}, 2)  # noqa: T201
    assert (answer["value"], answer["printed"]) == (3, "hello\n")


@pytest.mark.parametrize(("error", "kind"), [(ValueError("no"), "ValueError"), (SystemExit(3), "SystemExit")])
def test_an_error_is_an_outcome(error: BaseException, kind: str) -> None:
    """Also what would end the kernel: sys.exit in an exercise."""

    def f() -> None:
        raise error

    assert call({"f": f})["error"]["type"] == kind


def test_an_interrupt_is_passed_on() -> None:
    """It is the reader's, not an outcome."""

    def f() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        call({"f": f})


def test_a_function_that_hangs_is_broken_off() -> None:
    """Also one that swallows whatever is raised in it."""

    def stubborn() -> None:
        until = time.monotonic() + 0.5
        while time.monotonic() < until:
            try:
                while True:
                    pass
            except BaseException:  # noqa: BLE001, S110 -- as a student would
                pass
        while True:
            pass

    started = time.monotonic()
    assert call({"f": stubborn}, within=0.1)["error"]["type"] == "TimesUp"
    assert time.monotonic() - started < 3


def test_a_name_that_is_not_there_comes_with_one_that_is_like_it() -> None:
    """A typing slip in the name of a function is the commonest reason."""
    assert ask({"mesure": len}, do="look", name="measure") == {
        "answer": 1,
        "kind": "missing",
        "alike": ["mesure"],
    }


def test_what_the_check_prepares_can_be_an_argument() -> None:
    """An object that cannot cross the wire is made in the kernel, by the check's own code."""
    hands = Hands({"f": lambda items: len(items)})
    hands.answer({"ask": 1, "do": "prepare", "code": "made = {1, 2, 3}", "within": 1.0})
    question = {"ask": 2, "do": "call", "name": "f", "args": [{"its": "made"}], "kwargs": {}, "within": 1.0}
    assert hands.answer(question)["value"] == 3


@pytest.mark.parametrize(
    "question",
    [{"do": "fly"}, {"do": "look"}, {"do": "read", "name": "x"}, {}, {"do": "read", "name": "f.x"}],
)
def test_what_cannot_be_answered_is_said(question: dict[str, Any]) -> None:
    """Never an exception that would end the check in a traceback."""
    assert "wrong" in Hands({"f": len}).answer({"ask": 1, **question})


def test_a_file_can_be_a_stub(tmp_path: Path) -> None:
    """A file that holds its first comments and `...` was handed out like that."""
    (tmp_path / "client.py").write_text("#!/usr/bin/env python3\n...\n")
    (tmp_path / "server.py").write_text("print(1)\n")
    kinds = [
        ask({}, tmp_path, do="look", name=f"file:{name}.py")["kind"] for name in ("client", "server", "none")
    ]
    assert kinds == ["stub", "file", "missing"]


def test_a_file_that_is_not_there_comes_with_one_that_is_like_it(tmp_path: Path) -> None:
    """Upper and lower case in the name of a definition is a common slip."""
    (tmp_path / "lamp.srv").write_text("---\n")
    assert ask({}, tmp_path, do="look", name="file:Lamp.srv") == {
        "answer": 1,
        "kind": "missing",
        "alike": ["lamp.srv"],
    }


def test_a_file_is_looked_for_in_the_workspace_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After a restart of the kernel nobody has changed to the workspace yet, and the work is still there."""
    monkeypatch.setenv("COURSE_WORKSPACE", str(tmp_path / "ws"))
    (tmp_path / "ws" / "src").mkdir(parents=True)
    (tmp_path / "ws" / "src" / "Lamp.srv").write_text("bool on\n---\n")
    (tmp_path / "elsewhere").mkdir()
    answer = ask({}, tmp_path / "elsewhere", do="source", name="file:src/Lamp.srv")
    assert answer["text"] == "bool on\n---\n"
