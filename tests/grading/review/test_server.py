"""Tests of the review server and of its command."""

from __future__ import annotations

import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from course_pkg.grading.review.overrides import read_overrides
from course_pkg.ros.process.supervisor import descendants
from course_pkg.setup import Places
from tests.grading.review.classes import TOKEN, serving, write_class
from tests.web_pages.servers import ask

COURSE = Places.of().checkout / "course"
FOREIGN: list[dict[str, str]] = [
    {},
    {"Authorization": "token wrong"},
    {"Authorization": f"token {TOKEN}", "Origin": "http://evil.example"},
    {"Authorization": f"token {TOKEN}", "Host": "evil.example"},
    {"Authorization": f"token {TOKEN}", "Sec-Fetch-Site": "cross-site"},
]


def test_foreign_requests_are_refused(tmp_path: Path) -> None:
    """The server refuses a request without the token, or with a wrong Host or Origin header."""
    out = write_class(tmp_path)
    change = {"number": 1, "points": "1", "comment": ""}
    with serving(out) as url:
        for headers in FOREIGN:
            for path in ("/", "/page.js", "/page.css", "/items", "/items/0", "/rows", "/nothing"):
                assert ask(url + path, **headers)[0] == 403, (path, headers)
            for path in ("/save", "/undo"):
                assert ask(url + path, change, **headers)[0] == 403, (path, headers)
        assert not (out / "overrides.csv").exists()
        own = {"Authorization": f"token {TOKEN}", "Origin": url}
        for path, status in {"/": 200, "/items/99": 404, "/nothing": 404, "/items/x": 404}.items():
            status_seen, _, headers = ask(url + path, **own)
            assert status_seen == status
            assert headers["Content-Security-Policy"].startswith("default-src 'none'; script-src 'self';")
        for wrong in ({}, [], {**change, "number": 99}, {**change, "points": 1}, {**change, "number": -1}):
            assert ask(f"{url}/save", wrong, **own)[0] == 400
        assert ask(f"{url}/save", change, **own)[0] == 200


@contextmanager
def _review(out: Path, *options: str) -> Iterator[tuple[subprocess.Popen[str], str, str]]:
    """Run `course review`, and yield the process, its address and its token."""
    command = [COURSE, "review", out, "--no-browser", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout
            address = process.stdout.readline().split()[-1]
            url, _, token = address.partition("/?token=")
            yield process, url, token
        finally:
            process.kill()


def _refused(out: Path, *options: str) -> str:
    command = [COURSE, "review", out, "--no-browser", *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 1, done
    return done.stderr


def test_the_command(tmp_path: Path) -> None:
    """The server refuses a second `course review` for a folder, and SIGKILL deletes no saved points."""
    out = write_class(tmp_path / "grades")
    with _review(out, "--part", "5.1") as (process, url, token):
        own = {"Authorization": f"token {token}"}
        assert ask(f"{url}/save", {"number": 1, "points": "1", "comment": "kept"}, **own)[0] == 200
        assert "Another `course review` command uses" in _refused(out)
        process.kill()
    assert [(row.points, row.comment) for row in read_overrides(out).rows.values()] == [(1, "kept")]
    with _review(out) as (process, _url, _token):
        process.send_signal(signal.SIGINT)
        ended, said = process.communicate(timeout=30)
    assert process.returncode == 0, said
    assert "The review has ended. All saved points are in" in ended.splitlines()[-1]
    assert said == ""


def test_the_command_explains_what_is_wrong(tmp_path: Path) -> None:
    """A wrong folder, a busy port or an unknown part leads to one error message."""
    assert "There is no folder" in _refused(tmp_path / "none")
    assert "contains no results" in _refused(tmp_path)
    out = write_class(tmp_path / "grades")
    assert "The results have no part 05.7" in _refused(out, "--part", "05.7")
    with socket.create_server(("127.0.0.1", 0)) as busy:
        assert f"Port {busy.getsockname()[1]} cannot be used" in _refused(
            out, "--port", str(busy.getsockname()[1])
        )


@pytest.mark.parametrize("content", ["student,part\n", "\xff"])
def test_a_wrong_file_stops_the_review(tmp_path: Path, content: str) -> None:
    """If overrides.csv is wrong, the error message contains the line number, and the file stays unchanged."""
    out = write_class(tmp_path / "grades")
    (out / "overrides.csv").write_bytes(content.encode("latin-1"))
    assert "line 1" in _refused(out)
    assert (out / "overrides.csv").read_bytes() == content.encode("latin-1")


def _in_a_small_folder(source: Path, out: Path) -> list[str]:
    """Return a command that runs `course review` for a copy of `source`, in a small file system at `out`."""
    out.mkdir()
    words = [
        "bwrap",
        "--die-with-parent",
        "--dev-bind",
        "/",
        "/",
        "--size",
        str(2 << 20),
        "--tmpfs",
        str(out),
    ]
    script = 'cp -r "$0/." "$1" && exec "$2" review "$1" --no-browser'
    return [*words, "sh", "-c", script, str(source), str(out), str(COURSE)]


def _fill(path: Path) -> None:
    """Write to `path` until the disk is full."""
    with path.open("wb", buffering=0) as file, suppress(OSError):
        while file.write(bytes(1 << 12)):
            pass


@pytest.mark.usefixtures("sandbox")
def test_a_full_disk_during_a_review(tmp_path: Path) -> None:
    """If the disk is full, each change gets one message, and all earlier points and comments stay."""
    out = tmp_path / "grades"
    command = _in_a_small_folder(write_class(tmp_path / "source"), out)
    later = {"number": 2, "points": "1", "comment": "x" * 3900}
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout
            url, _, token = process.stdout.readline().split()[-1].partition("/?token=")
            own = {"Authorization": f"token {token}"}
            # Only the processes in bwrap see the small file system.
            seen = Path(f"/proc/{descendants(process.pid)[-1]}/root{out}")
            assert ask(f"{url}/save", {"number": 1, "points": "1", "comment": "kept"}, **own)[0] == 200
            before = (seen / "overrides.csv").read_bytes()
            _fill(seen / "other")
            for path, change in (("save", later), ("save", later), ("undo", {})):
                status, text, _ = ask(f"{url}/{path}", change, **own)
                assert status == 507
                assert "overrides.csv cannot be written: No space left on device." in str(text)
                assert (seen / "overrides.csv").read_bytes() == before
            assert not [each.name for each in seen.iterdir() if each.name.startswith(".overrides")]
            (seen / "other").unlink()
            assert ask(f"{url}/save", later, **own)[0] == 200
            rows = read_overrides(seen).rows.values()
            assert [(row.points, row.comment) for row in rows] == [(1, "kept"), (1, later["comment"])]
        finally:
            process.kill()
        assert "Traceback" not in process.communicate()[1]
