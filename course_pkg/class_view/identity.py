"""Find the owner of a token: a student who sends results, or the teacher who opens the page."""

from __future__ import annotations

import hmac
import json
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol
from urllib.parse import urlencode

from tornado.httpclient import AsyncHTTPClient, HTTPClientError, HTTPRequest

from course_pkg.class_view.tokens import Tokens
from course_pkg.types.fields import Plain

TIMEOUT = 10.0  # The time is in s.
KEPT = 60.0  # An answer of the hub is stored and reused for this time in s.
MOST = 1_000  # At most this number of the hub's answers is stored.


class HubUnreachable(Exception):
    """The hub does not answer; the request can be sent again later."""


class Identity(Protocol):
    """Decides who owns a token."""

    async def student(self, token: str) -> str | None:
        """Return the student who owns a token, or None if no student owns it.

        Raises HubUnreachable if the hub does not answer.
        """

    async def is_teacher(self, token: str) -> bool:
        """Return whether the owner of a token may open the page.

        Raises HubUnreachable if the hub does not answer.
        """


class LocalIdentity:
    """The tokens of a file, and one token for the teacher."""

    def __init__(self, tokens: Tokens, teacher: str) -> None:
        self._tokens, self._teacher = tokens, teacher

    async def student(self, token: str) -> str | None:
        """Return the student who owns a token, or None if no student owns it."""
        return self._tokens.student_of(token)

    async def is_teacher(self, token: str) -> bool:
        """Return whether `token` is the teacher's token."""
        return hmac.compare_digest(token.encode(), self._teacher.encode())


@dataclass(frozen=True)
class HubService:
    """The data that JupyterHub passes to a service in environment variables."""

    api: str  # the address of the hub's API
    token: str  # the service's own token
    client: str  # the service's id for OAuth
    prefix: str  # the path of the service, with a slash at both ends
    base: str  # the path of the hub, with a slash at both ends
    scopes: tuple[str, ...]  # a user needs one of these scopes to open the page

    @classmethod
    def of(cls, environment: Mapping[str, str]) -> HubService | None:
        """Return the data in the environment, or None if this process is not a service of a hub."""
        if not (prefix := environment.get("JUPYTERHUB_SERVICE_PREFIX")):
            return None
        return cls(
            environment["JUPYTERHUB_API_URL"].rstrip("/"),
            environment["JUPYTERHUB_API_TOKEN"],
            environment.get("JUPYTERHUB_CLIENT_ID", ""),
            prefix,
            environment.get("JUPYTERHUB_BASE_URL", "/"),
            tuple(json.loads(environment.get("JUPYTERHUB_OAUTH_ACCESS_SCOPES") or "[]")),
        )


class HubIdentity:
    """Asks a JupyterHub. Each answer of the hub is stored for 60 s."""

    def __init__(self, service: HubService) -> None:
        self.service = service
        self._users: dict[str, tuple[float, dict[str, Plain]]] = {}

    async def student(self, token: str) -> str | None:
        """Return the name of the user who owns a token, or None if no user owns it."""
        user = await self._user(token)
        return str(user["name"]) if user.get("kind") == "user" and user.get("name") else None

    async def is_teacher(self, token: str) -> bool:
        """Return whether the hub allows the owner of a token to use this service."""
        user = await self._user(token)
        scopes = user.get("scopes")
        held = set(map(str, scopes)) if isinstance(scopes, list) else set()
        return user.get("kind") == "user" and bool(held & {*self.service.scopes, "access:services"})

    def login_url(self, state: str) -> str:
        """Return the hub's address for a login. After the login, the hub redirects the user to the page."""
        query = {"client_id": self.service.client, "redirect_uri": self._redirect, "response_type": "code"}
        return f"{self.service.base}hub/api/oauth2/authorize?{urlencode({**query, 'state': state})}"

    async def token_for(self, code: str) -> str:
        """Exchange the OAuth code from the hub's redirect for a token; return "" if the code is invalid."""
        form = {
            "client_id": self.service.client,
            "client_secret": self.service.token,
            "grant_type": "authorization_code",
            "code": code,
            "redirect_uri": self._redirect,
        }
        answer = await self._ask("/oauth2/token", body=urlencode(form))
        return str(answer.get("access_token") or "")

    @property
    def _redirect(self) -> str:
        return f"{self.service.prefix}oauth_callback"

    async def _user(self, token: str) -> dict[str, Plain]:
        """Return the hub's data about the owner of a token, or {} if the hub does not know the token."""
        now = time.monotonic()
        kept = self._users.get(token)
        if kept and now - kept[0] < KEPT:
            return kept[1]
        user = await self._ask("/user", token) if token else {}
        if len(self._users) >= MOST:
            self._users.clear()
        self._users[token] = (now, user)
        return user

    async def _ask(self, path: str, token: str = "", body: str | None = None) -> dict[str, Plain]:
        """Return the JSON object in the hub's response, or an empty dict if the hub refuses the request."""
        request = HTTPRequest(
            self.service.api + path,
            method="GET" if body is None else "POST",
            headers={"Authorization": f"token {token}"} if token else {},
            body=body,
            connect_timeout=TIMEOUT,
            request_timeout=TIMEOUT,
            follow_redirects=False,
        )
        try:
            answer = json.loads((await AsyncHTTPClient().fetch(request)).body)
        except HTTPClientError as error:
            if error.code < 500 and error.code != 429:
                return {}
            raise HubUnreachable(f"JupyterHub answers with status {error.code}.") from error
        except (OSError, ValueError) as error:
            raise HubUnreachable(f"JupyterHub does not answer ({error}).") from error
        return answer if isinstance(answer, dict) else {}
