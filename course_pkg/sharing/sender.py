"""Sends the results in the outbox to the class service, from a thread of the Jupyter server.

The thread reads the outbox every 0.2 s. The thread deletes a result only after the service has stored this
result. If the service does not answer, the thread tries again; the pauses grow from 0.5 s to 60 s.
"""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Callable, Mapping
from contextlib import closing
from http.client import HTTPConnection, HTTPException, HTTPSConnection
from urllib.parse import urlsplit

from course_pkg.sharing.notice import ADDRESS, address, keep_about
from course_pkg.sharing.outbox import Outbox

INTERVAL = 0.2  # time in s between two reads of the outbox
# pauses in s before the next attempt: after the first failure, after the second failure, …
PAUSES = (0.5, 1.0, 2.0, 4.0, 8.0, 15.0, 30.0, 60.0)
TIMEOUT = 10.0  # time limit in s for the connection, and for each wait for data
BATCH = 50  # maximum number of results in one request
LONGEST = 200_000  # maximum size of a response in bytes
TOKENS = ("COURSE_CLASS_TOKEN", "JUPYTERHUB_API_TOKEN")


class NotAccepted(Exception):
    """The service did not store the results; the message contains the reason."""


def start_sender(warn: Callable[[str], object]) -> threading.Thread | None:
    """Start the thread that sends results; return None if sharing is off.

    The function `warn` is called with a message after the first failure, and when the reason of the failure
    changes.
    """
    if not address():
        return None
    token = next(filter(None, map(os.environ.get, TOKENS)), "")
    sender = Sender(address(), token, Outbox(), warn)
    thread = threading.Thread(target=sender.run, name="class view", daemon=True)
    thread.start()
    return thread


class Sender:
    """Sends results to the service at `url`, until another thread sets the event `stopped`."""

    def __init__(self, url: str, token: str, outbox: Outbox, warn: Callable[[str], object]) -> None:
        self._url, self._token, self._outbox, self._warn = url, token, outbox, warn
        self._knows_service = False
        self.stopped = threading.Event()

    def run(self) -> None:
        """Send results repeatedly until `stopped` is set."""
        failures, problem = 0, ""
        pause = 0.0
        while not self.stopped.wait(pause):
            try:
                self.send()
                failures, problem, pause = 0, "", INTERVAL
            except (NotAccepted, OSError, HTTPException, ValueError) as error:
                if str(error) != problem:
                    problem = str(error)
                    self._warn(
                        f"Results are stored now and sent later, because {self._url} does not work: {problem}"
                    )
                pause = PAUSES[min(failures, len(PAUSES) - 1)]
                failures += 1

    def send(self) -> None:
        """Send all results that are in the outbox.

        Raises NotAccepted, OSError, HTTPException or ValueError if the service cannot store the results.
        """
        if not self._knows_service:
            keep_about(self._outbox.folder.parent, self._url, self._ask("GET", "/about"))
            self._knows_service = True
        while results := self._outbox.first(BATCH):
            answer = self._ask("POST", "/results", {"results": results})
            done = answer.get("done")
            if not isinstance(done, list) or not done:
                raise NotAccepted("the answer does not come from a class service")
            self._outbox.remove([str(each["id"]) for each in results if each["id"] in done])

    def _ask(self, method: str, path: str, data: Mapping[str, object] | None = None) -> dict[str, object]:
        """Send a request to the class service; use no HTTP proxy, and follow no redirects."""
        parts = urlsplit(self._url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise NotAccepted(f"{ADDRESS} is not an address such as http://127.0.0.1:8900")
        connect = HTTPSConnection if parts.scheme == "https" else HTTPConnection
        with closing(connect(parts.hostname, parts.port, timeout=TIMEOUT)) as connection:
            headers = {"Authorization": f"token {self._token}", "Content-Type": "application/json"}
            body = None if data is None else json.dumps(data)
            connection.request(method, parts.path + path, body, headers)
            response = connection.getresponse()
            received = response.read(LONGEST)
        if response.status != 200:
            reason = received[:300].decode("utf-8", "replace").strip()
            raise NotAccepted(f"status {response.status}: {reason}")
        answer = json.loads(received)
        if not isinstance(answer, dict):
            raise NotAccepted("the answer does not come from a class service")
        return answer
