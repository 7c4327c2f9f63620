"""JupyterLab's page, kept from one start to the next."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from course_pkg.lab.page import NOTEBOOK, Page

BODY = f'<script>{{"token": "secret1", "treePath": "{NOTEBOOK}"}}</script>é'


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    """A page that is kept, made from the files `there` and `folder` and from one that is not there."""
    (tmp_path / "there").write_text("x")
    (tmp_path / "folder").mkdir()
    headers = {"Content-Type": "text/html; charset=UTF-8", "Set-Cookie": "user=me", "Date": "then"}
    sources = [tmp_path / name for name in ("there", "folder", "not-there")]
    path = tmp_path / "page.json"
    path.write_text(Page.of(headers, BODY, "secret1", sources).as_text())
    return path


def test_the_page_of_a_start_has_its_own_token_and_notebook(kept: Path) -> None:
    """No secret of another start is kept or given out, and no cookie; the length is that of the bytes."""
    assert "secret1" not in kept.read_text()
    page = Page.read(kept)
    assert page is not None
    head, _, body = page.response("secret2", "notebooks/a b.ipynb").partition(b"\r\n\r\n")
    lines = head.decode().split("\r\n")
    assert body.decode() == BODY.replace("secret1", "secret2").replace(NOTEBOOK, "notebooks/a b.ipynb")
    assert lines[0] == "HTTP/1.1 200 OK"
    assert set(lines[1:]) == {
        "Content-Type: text/html; charset=UTF-8",
        f"Content-Length: {len(body)}",
        "Connection: close",
    }


def test_a_name_cannot_leave_the_script(kept: Path) -> None:
    """A file's name is data in the page, whatever it is made of, and says the same when it is read."""
    page = Page.read(kept)
    assert page is not None
    name = '</script><b "\\ é>.ipynb'
    body = page.response("secret2", name).partition(b"\r\n\r\n")[2].decode()
    inside = body.partition("<script>")[2].partition("</script>")[0]
    assert "<" not in inside
    assert json.loads(inside)["treePath"] == name


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("there", lambda path: path.write_text("xy")),
        ("there", lambda path: os.utime(path, ns=(1, 1))),
        ("there", lambda path: path.unlink()),
        ("folder", lambda path: (path / "extension").mkdir()),
        ("not-there", lambda path: path.write_text("")),
        ("page.json", lambda path: path.write_text(path.read_text()[:-10])),
        ("page.json", lambda path: path.write_text("[]")),
        ("page.json", lambda path: path.unlink()),
    ],
)
def test_a_page_made_from_something_else_is_not_given_out(kept: Path, name: str, change: object) -> None:
    """Whatever it was made from has changed, came or went, or the page itself is broken: there is none."""
    assert Page.read(kept)
    assert callable(change)
    change(kept.parent / name)
    assert Page.read(kept) is None
