"""JupyterLab's page, kept from one start to the next.

What stands in it changes with what is installed, and the server knows that best. So it is the server's own
page, asked for when nobody waits, and given out only while everything that it was made from is as it was.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

TOKEN, NOTEBOOK = "course-token", "course-notebook.ipynb"  # stand for those of a start
LEFT_OUT = ("connection", "content-length", "date", "etag", "server", "set-cookie", "transfer-encoding")
Stamp = list[int] | None


@dataclass(frozen=True)
class Page:
    """The page as the server sent it, and the files that it was made from, each with its stamp."""

    headers: Mapping[str, str]
    body: str
    sources: Mapping[str, Stamp]

    @classmethod
    def of(cls, headers: Mapping[str, str], body: str, token: str, sources: Iterable[Path]) -> Page:
        """Return what to keep of a page that was asked for with `token` and NOTEBOOK."""
        lasting = {name: value for name, value in headers.items() if name.lower() not in LEFT_OUT}
        return cls(lasting, body.replace(token, TOKEN), {str(path): _stamp(path) for path in sources})

    @classmethod
    def read(cls, path: Path) -> Page | None:
        """Return the page that is kept at `path`, if it is as the server would make it now."""
        try:
            page = cls(**json.loads(path.read_text()))
        except (OSError, ValueError, TypeError):
            return None
        return page if all(_stamp(Path(name)) == seen for name, seen in page.sources.items()) else None

    def as_text(self) -> str:
        """Return what read() reads."""
        return json.dumps(vars(self))

    def response(self, token: str, notebook: str) -> bytes:
        """Return the response of HTTP that has this page for one start."""
        body = self.body.replace(NOTEBOOK, _in_script(notebook)).replace(TOKEN, _in_script(token)).encode()
        headers = {**self.headers, "Content-Length": str(len(body)), "Connection": "close"}
        lines = ["HTTP/1.1 200 OK", *(f"{name}: {value}" for name, value in headers.items()), "", ""]
        return "\r\n".join(lines).encode() + body


def _stamp(path: Path) -> Stamp:
    try:
        status = os.stat(path)
    except OSError:
        return None
    return [status.st_mtime_ns, status.st_size]


def _in_script(text: str) -> str:
    """Return `text` as it stands in a JSON string within HTML."""
    quoted = json.dumps(text)[1:-1]
    for letter in "<>&'":
        quoted = quoted.replace(letter, f"\\u{ord(letter):04x}")
    return quoted
