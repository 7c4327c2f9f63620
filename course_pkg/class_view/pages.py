"""The HTTP interface: students' servers send results with their token, and a teacher opens the page."""

from __future__ import annotations

import hmac
import json
import secrets
import sqlite3
from collections.abc import Sequence
from dataclasses import dataclass
from http import HTTPStatus
from pathlib import Path

from jinja2 import Environment
from tornado.web import Application

from course_pkg.class_view.identity import HubIdentity, HubUnreachable
from course_pkg.class_view.service import ClassService
from course_pkg.class_view.storage import MOST, TooMany
from course_pkg.web_pages.handler import ASSETS, PageHandler, templates_in

HERE = Path(__file__).parent
LARGEST = 500_000  # A request has at most this number of bytes.
WAIT = 20.0  # A request for changes waits at most this time in s.
SESSION, STATE = "course-class", "course-class-state"  # These are the names of the cookies.
DAYS = 1.0  # a teacher's session ends after this number of days


@dataclass(frozen=True)
class Chapter:
    """A chapter and its parts, each with its goal."""

    number: str
    title: str
    parts: Sequence[tuple[str, str]]


@dataclass(frozen=True)
class Shared:
    """The objects that all handlers use."""

    service: ClassService
    prefix: str  # the path of the service, with a slash at both ends
    chapters: Sequence[Chapter]
    templates: Environment


def application(service: ClassService, prefix: str, secret: str, chapters: Sequence[Chapter]) -> Application:
    """Return the application; `secret` signs the cookies of teachers."""
    shared = {"shared": Shared(service, prefix, chapters, templates_in(HERE))}
    return Application(
        [
            (prefix, Page, shared),
            (prefix + ASSETS, Asset, shared),
            (prefix + "changes", Changes, shared),
            (prefix + "about", About, shared),
            (prefix + "results", Results, shared),
            (prefix + "oauth_callback", Callback, shared),
        ],
        default_handler_class=Unknown,
        default_handler_args=shared,
        cookie_secret=secret,
        # Requests are not logged: the page and the sender show an error if the service refuses a request.
        log_function=lambda _handler: None,
    )


class Handler(PageHandler):
    """A handler with access to the service; it finds the student who owns the token of a request."""

    def initialize(self, shared: Shared) -> None:
        """Store the objects that all handlers use."""
        self.shared, self.service = shared, shared.service

    async def student(self) -> str | None:
        """Return the student who owns the request's token.

        If the token belongs to no student, refuse the request and return None.
        """
        token = self.request.headers.get("Authorization", "").removeprefix("token ")
        try:
            # Programs send the results. A request with the header Origin comes from a page in a browser and
            # is refused.
            student = None if "Origin" in self.request.headers else await self.service.identity.student(token)
        except HubUnreachable as error:
            self.refuse(HTTPStatus.SERVICE_UNAVAILABLE, str(error))
            return None
        if student is None:
            self.refuse(HTTPStatus.FORBIDDEN, "The token is wrong. Ask your teacher for a new token.")
        return student


class Unknown(Handler):
    """Refuses requests with an unknown address."""

    def get(self) -> None:
        """Send an error with the status 404."""
        self.refuse_path()


class TeacherHandler(Handler):
    """Refuses requests without a teacher's token, and requests that come from another page."""

    async def prepare(self) -> None:
        """Refuse a request without a teacher's token; on a hub, redirect the browser to the hub's login."""
        if (
            self.request.headers.get("Sec-Fetch-Site", "none") == "cross-site"
            and self.request.path != self.shared.prefix
        ):
            self.refuse(
                HTTPStatus.FORBIDDEN,
                "This request comes from a page of a different server. Enter the address of the "
                "class view in the browser.",
            )
            return
        given = self.get_query_argument("token", "")
        kept = (self.get_signed_cookie(SESSION, max_age_days=DAYS) or b"").decode()
        identity = self.service.identity
        try:
            if kept and await identity.is_teacher(kept):
                return
            if given and not isinstance(identity, HubIdentity) and await identity.is_teacher(given):
                self.enter(given)
                return
        except HubUnreachable as error:
            self.refuse(HTTPStatus.SERVICE_UNAVAILABLE, str(error))
            return
        if isinstance(identity, HubIdentity) and self.request.path == self.shared.prefix:
            state = secrets.token_urlsafe(24)
            self.keep(STATE, state)
            self.redirect(identity.login_url(state))
            return
        self.refuse(
            HTTPStatus.FORBIDDEN,
            "Open the address that `course class` printed. This address contains your token.",
        )

    def enter(self, token: str) -> None:
        """Store a teacher's token in a cookie, and open the page without a token in its address."""
        self.keep(SESSION, token)
        self.redirect(self.shared.prefix)

    def keep(self, name: str, value: str) -> None:
        """Set a signed cookie, which scripts cannot read."""
        secure = self.request.headers.get("X-Forwarded-Proto", self.request.protocol) == "https"
        self.set_signed_cookie(
            name,
            value,
            expires_days=None,
            path=self.shared.prefix,
            httponly=True,
            samesite="Lax",
            secure=secure,
        )


class Page(TeacherHandler):
    """Sends the page."""

    async def get(self) -> None:
        """Send the page."""
        template = self.shared.templates.get_template("page.html")
        settings = self.service.settings
        self.finish(template.render(chapters=self.shared.chapters, days=f"{settings.days:g}"))


class Asset(TeacherHandler):
    """Sends the page's script and style sheet."""

    def get(self, name: str) -> None:
        """Send a file."""
        self.send_asset(HERE / name)


class Changes(TeacherHandler):
    """Sends the changes of the class to the page."""

    async def get(self) -> None:
        """Wait for changes of the class, and send them."""
        since = self.get_query_argument("since", "-1")
        number = int(since) if since.isdecimal() and len(since) < 12 else -1
        self.answer(await self.service.changes(self.get_query_argument("epoch", ""), number, WAIT))


class Callback(TeacherHandler):
    """Receives the redirect from the hub at the end of a login."""

    async def prepare(self) -> None:
        """Accept each request; during the login, the browser has no teacher's token yet."""

    async def get(self) -> None:
        """Exchange the OAuth code for a token, and open the page."""
        identity = self.service.identity
        expected = self.get_signed_cookie(STATE, max_age_days=DAYS) or b""
        state = self.get_query_argument("state", "").encode()
        if not isinstance(identity, HubIdentity) or not expected or not hmac.compare_digest(expected, state):
            self.refuse(HTTPStatus.FORBIDDEN, "The login has expired. Open the page again.")
            return
        try:
            token = await identity.token_for(self.get_query_argument("code", ""))
            if token and await identity.is_teacher(token):
                self.enter(token)
                return
        except HubUnreachable as error:
            self.refuse(HTTPStatus.SERVICE_UNAVAILABLE, str(error))
            return
        self.refuse(HTTPStatus.FORBIDDEN, "Only a teacher may open this page.")


class About(Handler):
    """Sends the settings of the service that students may see."""

    async def get(self) -> None:
        """Send the teacher's name, and the number of days after which results are deleted."""
        if await self.student() is not None:
            settings = self.service.settings
            self.answer({"teacher": settings.teacher, "days": settings.days})


class Results(Handler):
    """Receives the results of a student."""

    async def post(self) -> None:
        """Store results; respond with the ids of the results that need not be sent again."""
        if len(self.request.body) > LARGEST:
            self.refuse(
                HTTPStatus.REQUEST_ENTITY_TOO_LARGE,
                f"The request is too large. A request can have at most {LARGEST} bytes.",
            )
            return
        if (student := await self.student()) is None:
            return
        try:
            self.answer({"done": list(await self.service.store(student, json.loads(self.request.body)))})
        except (ValueError, RecursionError) as error:
            self.refuse(HTTPStatus.BAD_REQUEST, f"The request is not valid: {error}")
        except TooMany:
            reason = (
                f"The service already has {MOST} results of this student. Ask your teacher to delete "
                "these results."
            )
            self.refuse(HTTPStatus.TOO_MANY_REQUESTS, reason)
        except sqlite3.Error as error:
            self.refuse(HTTPStatus.INSUFFICIENT_STORAGE, f"The results cannot be stored: {error}.")
