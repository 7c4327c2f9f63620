"""Imitates a student's browser, which uses the HTTP and WebSocket interface of the hub."""

from __future__ import annotations

import json
import time
import uuid
from pathlib import Path
from typing import Any

import requests
import websocket

from tests.support import eventually

TIMEOUT = 300.0  # The time limit in s.


class Student:
    """Logs a student in, starts the student's server and a kernel, and runs cells."""

    def __init__(self, hub: str, name: str, certificate: Path | None = None) -> None:
        self.hub, self.name = hub, name
        self.session = requests.Session()
        # An environment variable such as REQUESTS_CA_BUNDLE would override `verify`.
        self.session.trust_env = False
        self.session.verify = str(certificate) if certificate else True
        self._socket: websocket.WebSocket | None = None

    def __enter__(self) -> Student:
        return self

    def __exit__(self, *_error: object) -> None:
        if self._socket:
            self._socket.close()
        self.session.close()

    def log_in(self, password: str) -> bool:
        """Send the form of the login page; return whether the hub accepted the password."""
        page = f"{self.hub}/hub/login"
        self.session.get(page, timeout=TIMEOUT)
        form = {"username": self.name, "password": password, "_xsrf": self._xsrf("/hub/")}
        answer = self.session.post(page, data=form, allow_redirects=False, timeout=TIMEOUT)
        return answer.status_code == 302

    def start_server(self) -> None:
        """Start the student's server, wait until the server answers, and get the server's cookie."""
        answer = self.session.get(f"{self.hub}/hub/spawn/{self.name}", timeout=TIMEOUT)
        assert answer.ok, answer.text
        eventually(self._server_answers, TIMEOUT, 0.3)

    def refused_server(self) -> str:
        """Start the student's server, and return the hub's page that shows why the server did not start."""
        self.session.get(f"{self.hub}/hub/spawn/{self.name}", timeout=TIMEOUT)
        page = f"{self.hub}/hub/spawn-pending/{self.name}"
        return self.session.get(page, timeout=TIMEOUT).text

    def open_notebook(self, path: str) -> dict[str, Any]:
        """Start a kernel for a notebook, connect to the kernel, and return the notebook's content."""
        session = {"path": path, "name": path, "type": "notebook", "kernel": {"name": "python3"}}
        kernel = self.post("api/sessions", session)["kernel"]["id"]
        address = f"{self._server.replace('http', 'ws', 1)}/api/kernels/{kernel}/channels"
        cookies = "; ".join(
            f"{cookie.name}={cookie.value}"
            for cookie in self.session.cookies
            if f"/user/{self.name}/".startswith(cookie.path)
        )
        self._socket = websocket.create_connection(address, cookie=cookies, timeout=TIMEOUT)
        content: dict[str, Any] = self.get(f"api/contents/{path}")["content"]
        return content

    def run(self, code: str) -> tuple[str, float]:
        """Run a cell; return the cell's output as text, and the time in s until the kernel is idle again."""
        assert self._socket
        begun, number = time.monotonic(), uuid.uuid4().hex
        header = {
            "msg_id": number,
            "msg_type": "execute_request",
            "session": self.name,
            "username": "",
            "version": "5.3",
        }
        content = {
            "code": code,
            "silent": False,
            "store_history": True,
            "user_expressions": {},
            "allow_stdin": False,
            "stop_on_error": True,
        }
        message = {
            "header": header,
            "parent_header": {},
            "metadata": {},
            "content": content,
            "channel": "shell",
        }
        self._socket.send(json.dumps(message))
        shown = ""
        while True:
            received = json.loads(self._socket.recv())
            if received["parent_header"].get("msg_id") != number:
                continue
            kind, content = received["msg_type"], received["content"]
            if kind == "status" and content["execution_state"] == "idle":
                return shown, time.monotonic() - begun
            shown += content.get("text", "") + content.get("data", {}).get("text/plain", "")
            shown += "\n".join(content.get("traceback", []))

    def get(self, path: str) -> dict[str, Any]:
        """Return the JSON that the student's server sends for a GET request."""
        answer = self.session.get(f"{self._server}/{path}", timeout=TIMEOUT)
        assert answer.ok, answer.text
        found: dict[str, Any] = answer.json()
        return found

    def post(self, path: str, data: object) -> dict[str, Any]:
        """Send JSON to the student's server, and return the JSON of the response."""
        headers = {"X-XSRFToken": self._xsrf(f"/user/{self.name}/")}
        answer = self.session.post(f"{self._server}/{path}", json=data, headers=headers, timeout=TIMEOUT)
        assert answer.ok, answer.text
        found: dict[str, Any] = answer.json()
        return found

    @property
    def _server(self) -> str:
        return f"{self.hub}/user/{self.name}"

    def _server_answers(self) -> bool:
        answer = self.session.get(f"{self._server}/lab", timeout=TIMEOUT)
        return answer.ok and answer.url.startswith(f"{self._server}/lab")

    def _xsrf(self, path: str) -> str:
        return next(
            (each.value or "" for each in self.session.cookies if each.name == "_xsrf" and each.path == path),
            "",
        )
