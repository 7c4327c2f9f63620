"""Tests of the service: permissions to send and see results, stored results, and the data for the page."""

from __future__ import annotations

import sqlite3
import time
from pathlib import Path

import pytest

from course_pkg.class_view.command import delete_student
from course_pkg.class_view.model import ClassModel
from course_pkg.class_view.results import Result
from course_pkg.class_view.storage import DAY, Storage, TooMany
from tests.class_view.classes import TEACHER, changes, enter, result, send, serving, tokens_in
from tests.support import eventually
from tests.web_pages.servers import ask


def test_a_student_writes_only_own_results(tmp_path: Path) -> None:
    """The token decides to which student a result belongs; a result that is sent twice is stored once."""
    with serving(tmp_path) as url:
        tokens = tokens_in(tmp_path)
        forged = result("r1", student="s02", hint="Multiply.")
        assert send(url, tokens["s01"], forged) == (200, '{"done": ["r1"]}')
        assert send(url, tokens["s01"], forged, result("r2", "05.2", "passed"))[0] == 200
        assert send(url, tokens["s02"], result("r1", "05.2", "passed"))[0] == 200
        seen = changes(url, enter(url))
        assert [cell[:3] for cell in seen["cells"]] == [
            ["s01", "05.1", 1],
            ["s01", "05.2", 1],
            ["s02", "05.2", 1],
        ]
        assert seen["hints"] == [["05.1", "Multiply.", 1, 1]]
    with serving(tmp_path) as url:  # The service starts again with the same folder.
        assert changes(url, enter(url))["cells"] == seen["cells"]


def test_foreign_requests_are_refused(tmp_path: Path) -> None:
    """A request that sends results needs a student's token.

    A request for the page needs the teacher's token.
    """
    with serving(tmp_path) as url:
        student = tokens_in(tmp_path)["s01"]
        for token in ("", "wrong", TEACHER, "ü"):
            assert ask(f"{url}/results", {"results": [result("x")]}, Authorization=f"token {token}")[0] == 403
        own = {"Authorization": f"token {student}"}
        assert ask(f"{url}/results", {"results": [result("x")]}, Origin=url, **own)[0] == 403
        for path in ("/", "/page.js", "/page.css", "/changes"):
            for query in ("", "?token=wrong", f"?token={student}"):
                assert ask(url + path + query)[0] == 403
            assert ask(url + path, Cookie="course-class=forged")[0] == 403
        cookie = enter(url)
        assert ask(f"{url}/changes", Cookie=cookie, Sec_Fetch_Site="cross-site")[0] == 403
        status, _, headers = ask(f"{url}/", Cookie=cookie)
        assert status == 200
        assert headers["Content-Security-Policy"].startswith("default-src 'none'; script-src 'self';")
        assert ask(f"{url}/nothing")[0] == 404


@pytest.mark.parametrize(
    ("body", "status"),
    [(b"{", 400), ([], 400), ({"results": []}, 400), ({"results": [{}] * 101}, 400), (b"[" * 100_000, 400)],
)
def test_bad_requests_are_refused(tmp_path: Path, body: object, status: int) -> None:
    """A request without a list of results gets status 400; a request that is too large gets status 413."""
    with serving(tmp_path) as url:
        own = {"Authorization": f"token {tokens_in(tmp_path)['s01']}"}
        assert ask(f"{url}/results", body, **own)[0] == status
        assert ask(f"{url}/results", b" " * 600_000, **own)[0] == 413


def test_what_is_not_a_result_is_left_out(tmp_path: Path) -> None:
    """The service stores only the valid results of a request.

    The response lists the ids of all results, so that the sender can delete the invalid results too.
    """
    wrong = [
        *({"id": "a"}, result("b", check="../x"), result("c", verdict="best"), result("d", time="now")),
        *(result("e", time=float("inf")), result("f" * 65)),
    ]
    with serving(tmp_path) as url:
        status, text = send(url, tokens_in(tmp_path)["s01"], *wrong, result("g", time=time.time() + 1e6))
        assert (status, text.count('"')) == (200, 2 + 2 * 7)
        (cell,) = changes(url, enter(url))["cells"]  # type: ignore[misc]
        assert cell[:2] == ["s01", "05.1"]
        assert cell[5] <= time.time()


def test_a_full_disk_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the disk is full, the service reports an error, and the sender keeps its results."""

    def full(*_: object) -> None:
        raise sqlite3.OperationalError("database or disk is full")

    with serving(tmp_path) as url:
        monkeypatch.setattr(Storage, "add", full)
        status, text = send(url, tokens_in(tmp_path)["s01"], result("r1"))
        assert (status, text) == (507, "The results cannot be stored: database or disk is full.\n")


def test_a_student_is_deleted_while_the_service_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """After a student is deleted, the student's results are not shown, and the student's token is invalid."""
    with serving(tmp_path) as url:
        tokens, cookie = tokens_in(tmp_path), enter(url)
        send(url, tokens["s01"], result("r1", hint="Multiply."))
        send(url, tokens["s02"], result("r1"))
        before = changes(url, cookie)
        assert delete_student(tmp_path, "s01") == 0
        assert capsys.readouterr().out == "Deleted 1 results and the token of s01.\n"
        after = eventually(lambda: (now := changes(url, cookie))["epoch"] != before["epoch"] and now)
        assert [cell[0] for cell in after["cells"]] == ["s02"]  # type: ignore[index, union-attr]
        assert send(url, tokens["s01"], result("r2"))[0] == 403
    assert b"Multiply" not in b"".join(each.read_bytes() for each in tmp_path.glob("results.*"))


def _result(student: str, name: str, verdict: str = "not yet", when: float = 1.0, hint: str = "") -> Result:
    return Result(student, name, "05.1", verdict, when, hint)


def test_old_results_are_deleted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a student has sent no result for some days, the service deletes all results of this student."""
    storage = Storage(tmp_path)
    storage.add([_result("old", "1"), _result("new", "1")])
    now = time.time()
    monkeypatch.setattr(time, "time", lambda: now + 20 * DAY)
    storage.add([_result("new", "2")])
    monkeypatch.setattr(time, "time", lambda: now + 31 * DAY)
    assert storage.delete_old(30) == 1
    assert [each.student for each in storage.read()] == ["new", "new"]
    storage.close()


def test_a_student_cannot_fill_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a request exceeds the limit, the service stores nothing from this request."""
    monkeypatch.setattr("course_pkg.class_view.storage.MOST", 2)
    storage = Storage(tmp_path)
    storage.add([_result("s", "1")])
    with pytest.raises(TooMany):
        storage.add([_result("s", "2"), _result("s", "3")])
    assert len(storage.read()) == 1
    storage.close()


def test_the_model_counts_tries_until_the_first_pass() -> None:
    """A blank answer is not counted as an attempt, and a passed part remains passed after a later failure."""
    verdicts = ["not attempted", "not yet", "not examined", "passed", "not yet"]
    model = ClassModel({"s": "Sam"})
    for number, verdict in enumerate(verdicts, 1):
        model.add([_result("s", str(number), verdict, number)])
    seen = model.changes("", 0)
    assert seen["cells"] == [["s", "05.1", 3, 4, 2, 5]]
    assert model.changes(model.epoch, 5)["cells"] == []
