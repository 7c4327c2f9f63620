"""HTML from an output, made harmless: what an output says may be shown, and none of it may run."""

from __future__ import annotations

import re

from bleach import Cleaner
from bleach.css_sanitizer import CSSSanitizer

TAGS = frozenset(
    (
        *(
            "abbr",
            "b",
            "code",
            "del",
            "em",
            "i",
            "ins",
            "kbd",
            "q",
            "s",
            "samp",
            "small",
            "span",
            "strong",
            "sub",
        ),
        *("sup", "u", "var", "a", "br", "img"),
        *("blockquote", "details", "div", "figcaption", "figure", "h3", "h4", "h5", "h6", "hr", "p", "pre"),
        *("section", "summary", "dd", "dl", "dt", "li", "ol", "ul"),
        *("caption", "table", "tbody", "td", "tfoot", "th", "thead", "tr"),
    )
)
ANYWHERE = frozenset({"class", "title", "role", "lang", "dir", "aria-label", "aria-hidden"})
SOMEWHERE = {
    "a": {"href"},
    "img": {"src", "alt", "width", "height"},
    "details": {"open"},
    "ol": {"start"},
    "td": {"colspan", "rowspan"},
    "th": {"colspan", "rowspan", "scope"},
}
VERDICT = ["border-left"]  # the property by which a report shows how it went
PLAIN = re.compile(r"[-\w\s:;#.%]*")  # a style that calls nothing
PICTURE = re.compile(r"data:image/(png|jpeg|gif|webp);base64,[A-Za-z0-9+/=\s]*")


class Purifier:
    """Lets through text, its structure, pictures that it carries along, and links that lead somewhere."""

    def __init__(self) -> None:
        self._cleaner = Cleaner(
            tags=TAGS,
            attributes=_may_have,
            protocols=["http", "https", "mailto", "data"],
            css_sanitizer=CSSSanitizer(allowed_css_properties=VERDICT),
            strip=True,
            strip_comments=True,
        )

    def __call__(self, html: str) -> str:
        """Return `html` without whatever could run, fetch or look like a part of the page."""
        return str(self._cleaner.clean(html))


def _may_have(tag: str, name: str, value: str) -> bool:
    if name == "src":
        return tag == "img" and bool(PICTURE.fullmatch(value))
    if name == "style":
        return tag == "section" and bool(PLAIN.fullmatch(value))
    if name == "href":
        return tag == "a" and not value.strip().lower().startswith("data:")
    return name in ANYWHERE or name in SOMEWHERE.get(tag, ())
