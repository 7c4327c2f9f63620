"""Functions that create HTML pages without scripts.

The page's Content-Security-Policy permits only the page's own style sheet.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Iterable, Sequence
from pathlib import Path

from course_pkg.checking.report import Verdict
from course_pkg.grading import clean
from course_pkg.web_pages.style import style_sheet

KINDS = {  # Each verdict has a class in the style sheet, and a symbol that is shown before the verdict.
    Verdict.PASSED: ("passed", "✓"),
    Verdict.FAILED: ("failed", "✗"),
    Verdict.NOT_ATTEMPTED: ("untried", "○"),
    Verdict.UNDECIDED: ("open", "?"),
}


class Frame:
    """The HTML head of all pages; the style sheet is read only once."""

    def __init__(self) -> None:
        style = style_sheet(Path(__file__).with_name("page.css"))
        digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
        policy = f"default-src 'none'; style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'"
        self._head = (
            '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            '<meta name="referrer" content="no-referrer">\n<meta name="robots" content="noindex">\n'
            f"<style>{style}</style>\n"
        )

    def page(self, title: str, body: Iterable[str]) -> str:
        """Return a page; `body` is HTML. This method escapes the HTML characters in `title`."""
        inside = "\n".join(body)
        title = f"<title>{clean.html(clean.line(title))}</title>"
        return f"{self._head}{title}\n</head>\n<body>\n<main>\n{inside}\n</main>\n</body>\n</html>\n"


def text(value: object, limit: int = clean.SHORT) -> str:
    """Convert a value into one line of text, with HTML characters escaped."""
    return clean.html(clean.line(value, limit))


def paragraph(value: object, kind: str = "") -> str:
    """Return an HTML paragraph that contains the text, or "" if the text is empty."""
    shown = text(value, 1000)
    attribute = f' class="{kind}"' if kind else ""
    return f"<p{attribute}>{shown}</p>" if shown else ""


def banner(title: str, sentences: Sequence[str]) -> str:
    """Return a highlighted box that contains the sentences, or "" if there are no sentences."""
    shown = [sentence for value in sentences if (sentence := text(value, 1000))]
    if not shown:
        return ""
    items = "".join(f"<li>{sentence}</li>" for sentence in shown)
    words = f"<ul>{items}</ul>" if len(shown) > 1 else f"<p>{shown[0]}</p>"
    return f'<div class="banner" role="note"><p><strong>{text(title)}</strong></p>{words}</div>'


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]], numbers: int) -> str:
    """Return an HTML table.

    The first cell of each row is a header cell. The last columns contain numbers; `numbers` is the number of
    these columns.

    The cells in `rows` are HTML. This function escapes the HTML characters in `caption` and `head`.
    """
    numeric = len(head) - numbers

    def cells(values: Sequence[str], first: str, other: str) -> str:
        made = []
        for place, value in enumerate(values):
            tag = first if place == 0 else other
            name = tag.partition(" ")[0]
            kind = ' class="number"' if place >= numeric else ""
            made.append(f"<{tag}{kind}>{value}</{name}>")
        return f"<tr>{''.join(made)}</tr>"

    top = cells([text(value) for value in head], 'th scope="col"', 'th scope="col"')
    body = "\n".join(cells(row, 'th scope="row"', "td") for row in rows)
    name = text(caption)
    return (
        f'<div class="wide" role="region" aria-label="{name}" tabindex="0"><table><caption>{name}</caption>'
        f"<thead>{top}</thead>\n<tbody>{body}</tbody></table></div>"
    )
