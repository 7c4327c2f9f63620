"""Tests of the class view as a service of a JupyterHub; the tests imitate the hub's HTTP API."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from tornado.web import Application, RequestHandler

from course_pkg.class_view.identity import HubIdentity, HubService
from course_pkg.ports import free_port
from tests.class_view.classes import result, send, serving
from tests.web_pages.servers import ask, served

USERS = {
    "student": {"kind": "user", "name": "ada", "scopes": ["access:servers!server=ada/"]},
    "teacher": {"kind": "user", "name": "prof", "scopes": ["access:services!service=class"]},
    "service": {"kind": "service", "name": "class", "scopes": ["access:services!service=class"]},
}


class User(RequestHandler):
    """The request handler that returns the owner of a token."""

    def get(self) -> None:
        """Respond with the token's owner, or with status 403 for an unknown token."""
        user = USERS.get(self.request.headers.get("Authorization", "").removeprefix("token "))
        self.set_status(200 if user else 403)
        self.finish(json.dumps(user or {"status": 403}))


class Token(RequestHandler):
    """The request handler that exchanges an OAuth code for a token."""

    def post(self) -> None:
        """Respond with a token; in these tests, the OAuth code is also the token."""
        right = self.get_argument("client_secret") == "service"
        self.set_status(200 if right else 400)
        self.finish(json.dumps({"access_token": self.get_argument("code")}))


@contextmanager
def imitated_hub() -> Iterator[str]:
    """Run the HTTP API of a hub in a thread; yield its address."""
    hub = Application([("/hub/api/user", User), ("/hub/api/oauth2/token", Token)])
    with served(lambda _: nullcontext(hub)) as url:
        yield f"{url}/hub/api"


def environment(api: str) -> dict[str, str]:
    """Return the variables that a hub sets for a service."""
    return {
        "JUPYTERHUB_API_URL": api,
        "JUPYTERHUB_API_TOKEN": "service",
        "JUPYTERHUB_CLIENT_ID": "service-class",
        "JUPYTERHUB_SERVICE_PREFIX": "/",
        "JUPYTERHUB_OAUTH_ACCESS_SCOPES": '["access:services!service=class"]',
    }


@pytest.fixture
def url(tmp_path: Path) -> Iterator[str]:
    """Run the class view as a service of the imitated hub."""
    with imitated_hub() as api:
        hub = HubService.of(environment(api))
        assert hub
        with serving(tmp_path, identity=HubIdentity(hub)) as url:
            yield url


def login(url: str, user: str, state: str = "") -> tuple[int, dict[str, str]]:
    """Log in at the hub as a user, and follow the redirect to the class view."""
    status, _, headers = ask(f"{url}/")
    address = urlsplit(headers["Location"])
    query = parse_qs(address.query)
    assert (status, address.path) == (302, "/hub/api/oauth2/authorize")
    assert query["redirect_uri"] == ["/oauth_callback"]
    cookie = headers["Set-Cookie"].partition(";")[0]
    back = f"{url}/oauth_callback?code={user}&state={state or query['state'][0]}"
    status, _, headers = ask(back, Cookie=cookie)
    return status, headers


def test_the_hub_decides_whose_token_it_is(url: str) -> None:
    """A token of a user's server belongs to this user; a token of a hub service belongs to no student."""
    assert send(url, "student", result("r1")) == (200, '{"done": ["r1"]}')
    assert send(url, "service", result("r1"))[0] == 403
    assert send(url, "wrong", result("r1"))[0] == 403


def test_only_a_teacher_of_the_hub_opens_the_page(url: str) -> None:
    """The hub logs users in, and only users with the teacher's scope can open the page.

    The class view refuses a forged login.
    """
    status, headers = login(url, "teacher")
    cookie = headers["Set-Cookie"].partition(";")[0]
    assert (status, headers["Location"]) == (302, "/")
    assert ask(f"{url}/changes", Cookie=cookie)[0] == 200
    assert login(url, "student")[0] == 403
    assert login(url, "wrong")[0] == 403
    assert login(url, "teacher", state="forged")[0] == 403
    assert ask(f"{url}/?token=teacher")[0] == 302  # The service ignores a token in the URL.
    assert ask(f"{url}/changes")[0] == 403


def test_a_hub_that_does_not_answer_is_not_a_refusal(tmp_path: Path) -> None:
    """If the hub does not answer, the sender keeps its results and sends them again later."""
    hub = HubService.of(environment(f"http://127.0.0.1:{free_port()}/hub/api"))
    assert hub
    with serving(tmp_path, identity=HubIdentity(hub)) as url:
        assert send(url, "student", result("r1"))[0] == 503


def test_without_a_hub_there_is_no_hub() -> None:
    """In a user's server, the hub's variables for services are missing, so HubService.of() returns None."""
    assert HubService.of({"JUPYTERHUB_API_TOKEN": "x", "JUPYTERHUB_API_URL": "x"}) is None
