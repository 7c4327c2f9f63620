"""Checks a site: links need targets, figures need descriptions, and pages may load only files of the site."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from course_pkg.site.scripts import fronts

FORMULA = re.compile(r"\$\$.+?\$\$|(?<![\w$])\$[^\s$](?:[^$\n]*[^\s$])?\$(?!\w)", re.DOTALL)
VERBATIM = ("pre", "code", "script", "style", "title")


def faults(folder: Path) -> list[str]:
    """Return all faults of the site in the folder `folder`; each message begins with the name of the page."""
    pages = {path.name: _read(path) for path in sorted(folder.glob("*.html"))}
    return [
        f"{name}: {fault}"
        for name, page in pages.items()
        for fault in (*page.faults, *_doubles(page), *_dead_links(name, page, pages, folder))
    ]


def _read(path: Path) -> _Reader:
    reader = _Reader()
    reader.feed(path.read_text("utf-8"))
    reader.close()
    return reader


def _doubles(page: _Reader) -> Iterator[str]:
    yield from (f"the id {name!r} is used {count} times" for name, count in page.ids.items() if count > 1)


def _dead_links(name: str, page: _Reader, pages: Mapping[str, _Reader], folder: Path) -> Iterator[str]:
    for link in dict.fromkeys(page.links):
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        target = unquote(parts.path) or name
        if not (folder / target).is_file():
            yield f"the file of the link {link} does not exist"
        elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].ids:
            yield f"the page of the link {link} has no such id"


class _Reader(HTMLParser):
    """Collects the ids, the links and the faults of one page."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: Counter[str] = Counter()
        self.links: list[str] = []
        self.faults: list[str] = []
        self._inside: list[str] = []
        self._fronts = fronts()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Record the ids, links and figures of a page, and the files that the page loads."""
        given = {name: value or "" for name, value in attrs}
        if "id" in given:
            self.ids[given["id"]] += 1
        if tag in ("a", "link"):
            self._link(given.get("href", ""))
        self._figure(tag, given)
        self._loaded(tag, given)
        if tag in VERBATIM:
            self._inside.append(tag)

    def handle_endtag(self, tag: str) -> None:
        """Record the end of an element without prose, such as <pre>."""
        if self._inside and self._inside[-1] == tag:
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        """Record formulas in the page that are LaTeX and not MathML.

        Only formulas in prose must be MathML; a cell's output may contain LaTeX.
        """
        if not self._inside and (found := FORMULA.search(data)):
            self.faults.append(f"{found[0]} looks like a formula, but is not rendered")

    def _link(self, address: str) -> None:
        if not address:
            self.faults.append("a link has no address")
        elif not address.startswith("data:"):
            self.links.append(address)

    def _figure(self, tag: str, given: Mapping[str, str]) -> None:
        if tag == "img" and not given.get("alt", "").strip():
            self.faults.append(f"a picture has no description: {given.get('src', '')[:40]}")
        named = given.get("aria-label") or given.get("aria-labelledby") or given.get("aria-hidden")
        if tag == "svg" and not named:
            self.faults.append("a drawing has no description")
        if given.get("data-panel", self._fronts[0]) not in self._fronts:
            self.faults.append(f"there is no front end for the panel {given['data-panel']!r}")

    def _loaded(self, tag: str, given: Mapping[str, str]) -> None:
        source = given.get("src", "") or (given.get("href", "") if tag == "link" else "")
        if tag == "script" and source:
            self.links.append(source)
        if urlsplit(source).netloc:
            self.faults.append(f"the page would load {source} from another computer")
        handlers = [name for name in given if name.startswith("on")]
        if handlers or (tag == "script" and not source and given.get("type") != "text/plain"):
            self.faults.append(f"the page contains a script: <{' '.join([tag, *handlers])}>")
