"""Tests of the outbox for results, the sender, and the notice in the notebook."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.sharing.notice import notice
from course_pkg.sharing.outbox import Outbox
from course_pkg.sharing.sender import NotAccepted, Sender, start_sender
from tests.class_view.classes import changes, enter, serving, tokens_in

REPORT = {
    "check": "05.1",
    "verdict": "not yet",
    "printed": "my secret",
    "assertions": [
        {"text": "It returns.", "holds": True, "hint": ""},
        {"text": "area", "holds": False, "actual": "my secret", "hint": "Multiply."},
    ],
}


@pytest.fixture
def outbox(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Outbox:
    """Return an empty outbox, which stores results until the sender has sent them."""
    monkeypatch.setenv("COURSE_STATE", str(tmp_path / "state"))
    return Outbox()


def test_results_arrive_and_leave_the_outbox(
    outbox: Outbox, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After send(), the outbox is empty, and the service has the hint, but none of the student's values."""
    assert outbox.put(REPORT) == ""
    (stored,) = outbox.folder.glob("*.json")
    assert "my secret" not in stored.read_text()
    (outbox.folder / "forged.json").write_text('["x"]')
    with serving(tmp_path / "class") as url:
        Sender(url, tokens_in(tmp_path / "class")["s01"], outbox, print).send()
        assert list(outbox.folder.iterdir()) == []
        assert changes(url, enter(url))["hints"] == [["05.1", "Multiply.", 1, 1]]
    monkeypatch.setenv("COURSE_CLASS_URL", f"{url}/")
    shown = notice()
    assert "are shared with Dr. Ada (127.0.0.1): the part, the result, the time and the hint" in shown
    assert "30 days after your last result" in shown
    assert notice() == ""


def test_results_stay_if_they_cannot_be_sent(outbox: Outbox, tmp_path: Path) -> None:
    """With a wrong token, a bad address, or no running service, the results stay in the outbox."""
    outbox.put(REPORT)
    with serving(tmp_path / "class") as url, pytest.raises(NotAccepted, match="403: The token is wrong"):
        Sender(url, "wrong", outbox, print).send()
    with pytest.raises(ConnectionRefusedError):
        Sender(url, "any", outbox, print).send()
    for address in ("nonsense", "ftp://127.0.0.1", "http://"):
        with pytest.raises(NotAccepted, match="not an address such as"):
            Sender(address, "any", outbox, print).send()
    assert len(list(outbox.folder.iterdir())) == 1


def test_a_full_disk_is_one_message(outbox: Outbox) -> None:
    """If the disk is full, the report of the check says that the result is not shared."""
    outbox.folder.parent.mkdir(parents=True)
    outbox.folder.write_text("This file is in the way.")
    assert "This result is not shared with your teacher" in outbox.put(REPORT)


def test_nothing_runs_without_an_address(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without COURSE_CLASS_URL, no thread runs and no notice is printed."""
    monkeypatch.delenv("COURSE_CLASS_URL", raising=False)
    assert start_sender(print) is None
    assert notice() == ""
