"""HTML of an output, made harmless."""

from __future__ import annotations

from html.parser import HTMLParser

import pytest

from course_pkg.examiner.report import Report, Rule, Verdict
from course_pkg.site.clean import Purifier

ATTACKS = [
    "<script>alert(1)</script>",
    "<SCRIPT SRC=//x></SCRIPT>",
    "<img src=x onerror=alert(1)>",
    "<img src='data:image/svg+xml;base64,PHN2Zz4='>",
    "<svg><script>alert(1)</script></svg>",
    "<svg onload=alert(1)>",
    "<a href='javascript:alert(1)'>x</a>",
    "<a href=' jAvAsCrIpT&#58;alert(1)'>x</a>",
    "<a href='data:text/html,<script>alert(1)</script>'>x</a>",
    "<iframe src='x'></iframe>",
    "<object data='x'></object><embed src='x'>",
    "<form action='//x'><input name=a></form>",
    "<base href='//x'><meta http-equiv=refresh content='0;url=//x'>",
    "<link rel=stylesheet href='//x'>",
    "<style>@import '//x'</style>",
    "<p style='background:url(//x)'>x</p>",
    "<section style='border-left: 1px solid url(//x)'>x</section>",
    "<div id=text data-panel=graph>x</div>",
    "<noscript><p title='</noscript><img src=x onerror=alert(1)>'>",
    "<math><mtext><table><mglyph><style><!--</style><img title='--&gt;&lt;img src=1 onerror=alert(1)&gt;'>",
    "<!--<img src=x onerror=alert(1)>-->",
]


class Reader(HTMLParser):
    """Every tag and attribute that a browser would see."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.seen: list[tuple[str, str, str]] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note a tag with each of its attributes."""
        self.seen += [(tag, "", ""), *((tag, name, value or "") for name, value in attrs)]


@pytest.mark.parametrize("attack", ATTACKS)
def test_nothing_runs_or_loads(attack: str) -> None:
    """Whatever could run, fetch, or pass for a part of the page is gone; only its text may be left."""
    for tag, name, value in Reader(Purifier()(attack)).seen:
        assert tag in ("p", "a", "div", "section", "img", "table")
        assert name in ("", "title")
        assert not value or name == "title"


def test_a_report_is_still_a_report() -> None:
    """Its words, its structure and the edge that shows how it went are what they were."""
    rule = Rule("it answers", holds=False, asked="2", expected="4", seen="<5>", hint="Add.")
    report = Report("05.1", Verdict.FAILED, "A goal.", 0, 2, (rule,), "Again.", "printed")
    clean = Purifier()(report.html())
    for part in (
        'class="course-report"',
        "border-left",
        "<strong>",
        'aria-label="does not hold"',
        "&lt;5&gt;",
    ):
        assert part in clean
    assert "<details>" in clean


def test_a_picture_that_is_carried_along_stays() -> None:
    """With its description and its size."""
    picture = '<img src="data:image/png;base64,iVBORw0KGgo=" alt="a chair" width="64" height="48">'
    assert Purifier()(picture) == picture
