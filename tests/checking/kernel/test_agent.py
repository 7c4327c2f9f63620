"""The kernel agent executes each request within a time limit, and replies with the result."""

from __future__ import annotations

import logging
import time
from pathlib import Path

import pytest

from course_pkg.checking.kernel.agent import KernelAgent
from course_pkg.checking.plain_values import Reply, Value


def ask(namespace: dict[str, Value], folder: Path | None = None, **question: Value) -> Reply:
    """Return the agent's reply to a request."""
    return KernelAgent(namespace, folder).reply({"ask": 1, **question})


def call(namespace: dict[str, Value], *args: Value, within: float = 1.0) -> Reply:
    """Return the agent's reply to a request that calls the function `f`."""
    return ask(namespace, do="call", name="f", args=list(args), kwargs={}, within=within)


def test_result_contains_the_printed_text() -> None:
    """The reply to a request contains the result as plain data, and the printed text."""
    answer = call({"f": lambda a: (print("hello"), a + 1)[1]}, 2)  # noqa: T201
    assert (answer["value"], answer["printed"]) == (3, "hello\n")


@pytest.mark.parametrize(("error", "kind"), [(ValueError("no"), "ValueError"), (SystemExit(3), "SystemExit")])
def test_error_is_a_result(error: BaseException, kind: str) -> None:
    """If an exercise calls sys.exit(), the reply contains an error, and the kernel continues."""

    def f() -> None:
        raise error

    assert call({"f": f})["error"]["type"] == kind


def test_an_interrupt_is_passed_on() -> None:
    """An interrupt raises KeyboardInterrupt in the notebook."""

    def f() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        call({"f": f})


def test_function_is_interrupted_at_its_time_limit() -> None:
    """The time limit ends a function that catches every exception."""

    def stubborn() -> None:
        until = time.monotonic() + 0.5
        while time.monotonic() < until:
            try:
                while True:
                    pass
            except BaseException:  # noqa: BLE001, S110 -- as in a student's code
                pass
        while True:
            pass

    started = time.monotonic()
    assert call({"f": stubborn}, within=0.1)["error"]["type"] == "TimesUp"
    assert time.monotonic() - started < 3


def test_missing_name_comes_with_a_similar_name() -> None:
    """If a requested name does not exist, the reply contains a similar name that exists."""
    assert ask({"mesure": len}, do="look", name="measure") == {
        "answer": 1,
        "kind": "missing",
        "alike": ["mesure"],
    }


def test_an_imported_name_is_not_offered_for_a_missing_one() -> None:
    """If a requested name does not exist, the reply does not suggest an imported name."""
    assert ask({"Patch": Path}, do="look", name="Path")["alike"] == []


def test_the_traceback_of_a_handler_is_kept_once() -> None:
    """The agent returns the traceback of a handler only once; the traceback contains the student's line."""
    agent = KernelAgent({})
    try:
        try:
            raise KeyError("width")
        except KeyError:
            logging.getLogger("rosout").error("Error processing request: 'width'")
        first, second = (str(agent.reply({"ask": 1, "do": "traceback"})["text"]) for _ in range(2))
    finally:
        agent.close()
    assert "test_agent.py, line" in first
    assert first.endswith("KeyError: 'width'")
    assert second == ""


def test_an_exception_without_a_line_of_the_student_has_no_traceback() -> None:
    """If a handler has a wrong number of parameters, the error in the reply has no traceback."""
    agent = KernelAgent({})
    try:
        logging.getLogger("rosout").error("Error processing request: takes 0 positional arguments")
        assert agent.reply({"ask": 1, "do": "traceback"})["text"] == ""
    finally:
        agent.close()


def test_object_of_the_check_can_be_an_argument() -> None:
    """A check can create an object in the kernel and pass this object as an argument."""
    agent = KernelAgent({"f": lambda items: len(items)})
    agent.reply({"ask": 1, "do": "prepare", "code": "made = {1, 2, 3}", "within": 1.0})
    question = {"ask": 2, "do": "call", "name": "f", "args": [{"its": "made"}], "kwargs": {}, "within": 1.0}
    assert agent.reply(question)["value"] == 3


@pytest.mark.parametrize(
    "question",
    [{"do": "fly"}, {"do": "look"}, {"do": "read", "name": "x"}, {}, {"do": "read", "name": "f.x"}],
)
def test_invalid_request_gets_an_error(question: dict[str, Value]) -> None:
    """The reply to an invalid request contains an error."""
    assert "wrong" in KernelAgent({"f": len}).reply({"ask": 1, **question})


def test_a_file_can_be_a_stub(tmp_path: Path) -> None:
    """A file with only comments and `...` counts as blank."""
    (tmp_path / "client.py").write_text("#!/usr/bin/env python3\n...\n")
    (tmp_path / "server.py").write_text("print(1)\n")
    kinds = [
        ask({}, tmp_path, do="look", name=f"file:{name}.py")["kind"] for name in ("client", "server", "none")
    ]
    assert kinds == ["blank", "file", "missing"]


def test_missing_file_comes_with_a_similar_name(tmp_path: Path) -> None:
    """If a file name is wrong only in upper or lower case, the reply contains the right file name."""
    (tmp_path / "lamp.srv").write_text("---\n")
    assert ask({}, tmp_path, do="look", name="file:Lamp.srv") == {
        "answer": 1,
        "kind": "missing",
        "alike": ["lamp.srv"],
    }


def test_file_is_found_in_the_workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a file is not in the working folder, the agent finds the file in the catkin workspace."""
    monkeypatch.setenv("COURSE_WORKSPACE", str(tmp_path / "ws"))
    (tmp_path / "ws" / "src").mkdir(parents=True)
    (tmp_path / "ws" / "src" / "Lamp.srv").write_text("bool on\n---\n")
    (tmp_path / "elsewhere").mkdir()
    answer = ask({}, tmp_path / "elsewhere", do="source", name="file:src/Lamp.srv")
    assert answer["text"] == "bool on\n---\n"
