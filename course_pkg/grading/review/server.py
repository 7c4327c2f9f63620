"""The server of the review page; it refuses requests that have no token or come from another page."""

from __future__ import annotations

import asyncio
import hmac
import json
import os
from collections.abc import Callable
from http import HTTPStatus
from pathlib import Path

from jinja2 import Environment
from tornado.web import Application

from course_pkg.errors import GradingError
from course_pkg.grading.reports.gradebook import name_of
from course_pkg.grading.reports.page import KINDS
from course_pkg.grading.review.items import marked_lines
from course_pkg.grading.review.session import Session
from course_pkg.types.fields import Plain
from course_pkg.web_pages.handler import ASSETS, PageHandler, templates_in

HERE = Path(__file__).parent
LARGEST = 100_000  # A request may have at most this many bytes.
WAIT = 0.05  # The time is in s.


def application(session: Session, token: str, port: Callable[[], int]) -> Application:
    """Return the web application; `port` returns the port at which the server listens."""
    shared = {"session": session, "token": token, "port": port, "templates": templates_in(HERE)}
    return Application(
        [
            (r"/", Page, shared),
            ("/" + ASSETS, Asset, shared),
            (r"/items", Items, shared),
            (r"/items/(\d{1,6})", OneItem, shared),
            (r"/rows", Rows, shared),
            (r"/save", Save, shared),
            (r"/undo", Undo, shared),
        ],
        default_handler_class=Unknown,
        default_handler_args=shared,
        # No log is needed, because the page shows refused requests.
        log_function=lambda _handler: None,
    )


class Handler(PageHandler):
    """Refuses a request that has no token, comes from another page, or has a wrong host in its header."""

    def initialize(
        self, session: Session, token: str, port: Callable[[], int], templates: Environment
    ) -> None:
        """Store the data that all handlers use."""
        self.session, self.token, self.port, self.templates = session, token, port, templates

    def prepare(self) -> None:
        """Refuse a request that has no token, or does not come from the review page."""
        hosts = [f"{host}:{self.port()}" for host in ("127.0.0.1", "localhost")]
        origin = self.request.headers.get("Origin")
        known = self.request.host in hosts and origin in (None, f"http://{self.request.host}")
        near = self.request.headers.get("Sec-Fetch-Site", "none") in ("none", "same-origin")
        header = self.request.headers.get("Authorization", "").removeprefix("token ")
        given = header or self.get_query_argument("token", "")
        if not (known and near and hmac.compare_digest(given.encode(), self.token.encode())):
            reason = "Open the whole address that `course review` printed, including `?token=…` at its end."
            self.refuse(HTTPStatus.FORBIDDEN, reason)

    async def attempt(self, action: Callable[[], dict[str, Plain]]) -> None:
        """Send the result of the function `action`, or the reason why it failed."""
        while self.session.is_being_written():
            await asyncio.sleep(WAIT)
        try:
            self.answer(action())
        except (ValueError, GradingError) as error:
            self.set_status(HTTPStatus.CONFLICT)
            self.answer({"problem": f"{str(error).rstrip('.')}."})
        except OSError as error:
            self.set_status(HTTPStatus.INSUFFICIENT_STORAGE)
            why = os.strerror(error.errno) if error.errno else str(error)
            self.answer({"problem": f"overrides.csv cannot be written: {why}."})

    def sent(self) -> dict[str, Plain]:
        """Return the JSON data of the request, or {} if the data are not an object."""
        try:
            data = json.loads(self.request.body)
        except ValueError:
            return {}
        return data if isinstance(data, dict) else {}


class Unknown(Handler):
    """Answers a request for an unknown address with the status 404."""

    def get(self) -> None:
        """Send an error with the status 404."""
        self.refuse_path()


class Page(Handler):
    """Sends the page."""

    def get(self) -> None:
        """Send the page."""
        self.finish(self.templates.get_template("page.html").render(token=self.token))


class Asset(Handler):
    """Sends the page's script and style sheet."""

    def get(self, name: str) -> None:
        """Send a file."""
        self.send_asset(HERE / name)


class Items(Handler):
    """Sends all answers, and all rows of overrides.csv, to the browser."""

    def get(self) -> None:
        """Send all answers, and all rows of overrides.csv."""
        self.answer(self.session.describe())


class OneItem(Handler):
    """Sends the HTML of one answer."""

    def get(self, number: str) -> None:
        """Send the answer with its code, assertions and flags."""
        if int(number) >= len(self.session.items):
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        item = self.session.items[int(number)]
        kind, sign = KINDS[item.report.verdict]
        self.finish(
            self.templates.get_template("item.html").render(
                item=item,
                report=item.report,
                name=name_of(item.grade.student),
                kind=kind,
                sign=sign,
                lines=list(marked_lines(item)) if item.code else [],
                alike=len(self.session.alike(int(number))),
                name_of=name_of,
            )
        )


class Rows(Handler):
    """Sends all rows of overrides.csv if another program has changed this file."""

    async def get(self) -> None:
        """Send all rows of overrides.csv if another program has changed the file since the last request.

        If no other program has changed the file, send an empty JSON object.
        """
        session = self.session
        await self.attempt(lambda: {"rows": session.rows(), "reloaded": True} if session.refresh() else {})


class Save(Handler):
    """Stores the points and the comment of an answer."""

    async def post(self) -> None:
        """Store the points and the comment."""
        sent = self.sent()
        number, points, comment = sent.get("number"), sent.get("points"), sent.get("comment")
        whole = isinstance(number, int) and 0 <= number < len(self.session.items)
        if not (whole and isinstance(points, str) and isinstance(comment, str)):
            self.send_error(HTTPStatus.BAD_REQUEST)
            return
        assert isinstance(number, int)
        identical = sent.get("identical") is True
        await self.attempt(lambda: self.session.decide(number, points, comment, also_identical=identical))


class Undo(Handler):
    """Undoes the last change of points and comments."""

    async def post(self) -> None:
        """Undo the last change."""
        await self.attempt(self.session.undo)
