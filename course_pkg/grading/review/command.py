"""The command `course review`."""

from __future__ import annotations

import asyncio
import secrets
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets

from course_pkg.errors import GradingError
from course_pkg.grading.grade import Grade
from course_pkg.grading.reports.records import RESULTS, read_grades
from course_pkg.grading.review.items import Wanted
from course_pkg.grading.review.overrides import FILE
from course_pkg.grading.review.server import LARGEST, application
from course_pkg.grading.review.session import Session
from course_pkg.grading.run.selection import two_digits
from course_pkg.grading.store import FOLDER
from course_pkg.state import locked

AFTERWARDS = (
    "To write these points into the reports, type your `course grade` command again. The command "
    "does not grade any answer again."
)


def review(out: Path, wanted: Wanted, port: int, *, browser: bool) -> int:
    """Serve the review page for the folder `out` until Ctrl-C; return the exit status."""
    grades = _results(out)
    try:
        with locked(out / FOLDER / "review", 0):
            session = Session(out, grades, wanted)
            _require_answers(session, wanted, {each.check for grade in grades for each in grade.reports})
            asyncio.run(_serve(session, port, browser=browser))
    except TimeoutError as error:
        raise GradingError(
            f"Another `course review` command uses {out}. Use the page of that command, or end that "
            "command with Ctrl-C in its terminal."
        ) from error
    except KeyboardInterrupt:
        sys.stdout.write(f"\nThe review has ended. All saved points are in {out / FILE}. {AFTERWARDS}\n")
    except OSError as error:
        raise GradingError(
            f"{out} cannot be written ({error.strerror}). Correct the permissions of this folder."
        ) from error
    return 0


def wanted_of(parts: Sequence[str], *, flagged: bool, unfinished: bool) -> Wanted:
    """Return the selection of answers for the command-line options."""
    return Wanted(tuple(map(two_digits, parts)), flagged, unfinished)


def _results(out: Path) -> list[Grade]:
    if not out.is_dir():
        raise GradingError(f"There is no folder {out}. Give the folder that `course grade` wrote with --out.")
    grades = read_grades(out)
    if not any(grade.reports for grade in grades):
        raise GradingError(
            f"{out} contains no results in {RESULTS}. Run `course grade SUBMISSIONS --out {out}` first."
        )
    return grades


def _require_answers(session: Session, wanted: Wanted, known: set[str]) -> None:
    if unknown := [part for part in wanted.parts if part not in known]:
        raise GradingError(f"The results have no part {', '.join(unknown)}. A part is a number such as 05.2.")
    if not session.items:
        raise GradingError("No answer fits these options, so there is nothing to review.")


async def _serve(session: Session, port: int, *, browser: bool) -> None:
    try:
        (listening,) = bind_sockets(port, "127.0.0.1")
    except OSError as error:
        raise GradingError(
            f"Port {port} cannot be used ({error.strerror}). Leave out the option --port, or give "
            "another port."
        ) from error
    number = listening.getsockname()[1]
    token = secrets.token_urlsafe(24)
    server = HTTPServer(application(session, token, lambda: number), max_body_size=LARGEST)
    server.add_socket(listening)
    url = f"http://127.0.0.1:{number}/?token={token}"
    answers = "1 answer" if len(session.items) == 1 else f"{len(session.items)} answers"
    sys.stdout.write(f"{answers} to review: {url}\nCtrl-C ends the review.\n")
    sys.stdout.flush()
    if browser:
        webbrowser.open(url)
    await asyncio.Event().wait()
