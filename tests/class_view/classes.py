"""Functions that run a class view, and that send the requests of students and teachers."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from tornado.web import Application

from course_pkg.class_view.command import every_chapter
from course_pkg.class_view.identity import Identity, LocalIdentity
from course_pkg.class_view.pages import application
from course_pkg.class_view.service import ClassService, Settings
from course_pkg.class_view.storage import Storage
from course_pkg.class_view.tokens import FILE, Tokens
from tests.web_pages.servers import ask, served

TEACHER = "secret"  # the teacher's token, which only this test's server knows
NASTY = "</span><img src=x onerror=alert(1)>"


def tokens_in(folder: Path) -> dict[str, str]:
    """Return the students' tokens; the keys are the usernames."""
    lines = (folder / FILE).read_text().splitlines()[1:]
    return {line.split(",")[0]: line.split(",")[-1] for line in lines}


def result(name: str, check: str = "05.1", verdict: str = "not yet", **more: object) -> dict[str, object]:
    """Return a result in the format in which a student's server sends it."""
    return {"id": name, "check": check, "verdict": verdict, "time": time.time(), "hint": "", **more}


@contextmanager
def serving(folder: Path, students: int = 3, identity: Identity | None = None) -> Iterator[str]:
    """Run a class view in a thread; yield the view's address without the token and the final slash."""
    tokens = Tokens(folder / FILE)
    tokens.complete({f"s{number:02}": f"Student {number:02} {NASTY}" for number in range(1, students + 1)})
    settings = Settings("Dr. Ada", 30.0, tokens.names)

    @contextmanager
    def view(_: int) -> Iterator[Application]:
        with closing(Storage(folder)) as storage:
            service = ClassService(storage, identity or LocalIdentity(tokens, TEACHER), settings)
            watching = asyncio.create_task(service.watch())
            yield application(service, "/", "signs cookies", every_chapter())
            watching.cancel()

    with served(view) as url:
        yield url


def send(url: str, token: str, *results: dict[str, object]) -> tuple[int, str]:
    """Send results as a student's server does; return the status and the text of the response."""
    return ask(f"{url}/results", {"results": results}, Authorization=f"token {token}")[:2]


def enter(url: str, token: str = TEACHER) -> str:
    """Open the page as a teacher; return the cookie."""
    status, _, headers = ask(f"{url}/?token={token}")
    assert (status, headers["Location"]) == (302, "/")
    assert "HttpOnly" in headers["Set-Cookie"]
    return headers["Set-Cookie"].partition(";")[0]


def changes(url: str, cookie: str, epoch: str = "", since: int = -1) -> dict[str, object]:
    """Return the changes since a version of the page, in the format that the page receives."""
    status, text, _ = ask(f"{url}/changes?epoch={epoch}&since={since}", Cookie=cookie)
    assert status == 200, text
    found = json.loads(text)
    assert isinstance(found, dict)
    return found
