"""The HTTP handler of a page: it adds the security policies, and sends JSON, errors and files."""

from __future__ import annotations

import json
from http import HTTPStatus
from pathlib import Path

from jinja2 import Environment, FileSystemLoader
from tornado.web import RequestHandler

from course_pkg.types.fields import Plain
from course_pkg.web_pages.style import style_sheet

ASSETS = r"(page\.js|page\.css)"  # the paths of a page's script and style sheet
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src data:; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cache-Control": "no-store",
}


def templates_in(folder: Path) -> Environment:
    """Return the HTML templates in the folder `folder`; they escape all values."""
    return Environment(loader=FileSystemLoader(folder), autoescape=True, trim_blocks=True, lstrip_blocks=True)


class PageHandler(RequestHandler):
    """Adds the security policies to each response."""

    def set_default_headers(self) -> None:
        """Add the security policies to each response, including errors."""
        self.clear_header("Server")
        for name, value in HEADERS.items():
            self.set_header(name, value)

    def refuse(self, status: int, reason: str) -> None:
        """Send an error as one sentence."""
        self.set_status(status)
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{reason}\n")

    def refuse_path(self) -> None:
        """Send 404."""
        self.refuse(HTTPStatus.NOT_FOUND, "There is no such page.")

    def write_error(self, status_code: int, **_: object) -> None:
        """Send an error as text, without a traceback."""
        self.refuse(status_code, f"{status_code}: {self._reason}.")

    def answer(self, data: Plain) -> None:
        """Send plain data as JSON."""
        self.set_header("Content-Type", "application/json")
        self.finish(json.dumps(data))

    def send_asset(self, path: Path) -> None:
        """Send the script or style sheet `path`; send the common style sheet before a style sheet."""
        sheet = path.suffix == ".css"
        self.set_header("Content-Type", f"text/{'css' if sheet else 'javascript'}; charset=utf-8")
        self.finish(style_sheet(path) if sheet else path.read_bytes())
