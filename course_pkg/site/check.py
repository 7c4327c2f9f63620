"""Looks a site over: whether links lead somewhere, figures have words, and nothing comes from afar."""

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
    """Return what is wrong with the site in `folder`, each with the page that it is on."""
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
    yield from (
        f"the id {name!r} stands there {count} times" for name, count in page.ids.items() if count > 1
    )


def _dead_links(name: str, page: _Reader, pages: Mapping[str, _Reader], folder: Path) -> Iterator[str]:
    for link in dict.fromkeys(page.links):
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        target = unquote(parts.path) or name
        if not (folder / target).is_file():
            yield f"the link {link} leads to no file"
        elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].ids:
            yield f"the link {link} leads to no place on that page"


class _Reader(HTMLParser):
    """What a page holds that can be wrong."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: Counter[str] = Counter()
        self.links: list[str] = []
        self.faults: list[str] = []
        self._inside: list[str] = []
        self._fronts = fronts()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note ids, links, figures and what a page loads."""
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
        """Note where verbatim text ends."""
        if self._inside and self._inside[-1] == tag:
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        """Note formulas that Markdown has let be, as in a cell's output: only prose has them."""
        if not self._inside and (found := FORMULA.search(data)):
            self.faults.append(f"{found[0]} looks like a formula, and stands where none is set")

    def _link(self, address: str) -> None:
        if not address:
            self.faults.append("a link leads nowhere")
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
            self.faults.append(f"it would load {source} from elsewhere")
        handlers = [name for name in given if name.startswith("on")]
        if handlers or (tag == "script" and not source and given.get("type") != "text/plain"):
            self.faults.append(f"a script stands in the page itself: <{' '.join([tag, *handlers])}>")
