"""Tests of the conversion of notebook cells to HTML."""

from __future__ import annotations

import base64
from html.parser import HTMLParser

import pytest

from course_pkg.checking.report import Assertion, Report, Verdict
from course_pkg.site.exporter import Exporter, Sanitizer, terminal
from course_pkg.site.recordings import PANEL
from tests.authoring.books import book, code, exercise
from tests.site.notebook_stores import result, shown


def test_a_result_is_shown() -> None:
    """If a result contains only plain text, the page shows this text with escaped HTML characters."""
    assert "&lt;Box&gt; &amp; 3" in shown(result(text_plain="<Box> & 3")).html


def test_html_is_cleaned() -> None:
    """The page shows the HTML of a result without scripts."""
    body = shown(result(text_html="<p onclick=f()>yes</p><script>no()</script>", text_plain="text")).html
    assert "<p>yes</p>" in body
    assert "onclick" not in body
    assert "<script>" not in body
    assert "text</pre>" not in body


def test_a_script_among_the_outputs_is_left_out() -> None:
    """The page does not contain a result of the type JavaScript."""
    assert "alert" not in shown(result(application_javascript="alert(1)")).html


def test_a_drawing_is_a_picture() -> None:
    """An SVG becomes an <img>, because scripts cannot run in an <img>."""
    drawing = "<svg><script>alert(1)</script></svg>"
    output = result(text_plain="x") | {
        "data": {"image/svg+xml": drawing},
        "metadata": {"image/svg+xml": {"alt": 'a "graph"'}},
    }
    body = shown(output).html
    assert base64.b64encode(drawing.encode()).decode() in body
    assert 'alt="a &quot;graph&quot;"' in body
    assert "<svg" not in body


def test_a_figure_is_described_by_its_own_text() -> None:
    """The alternative text of a matplotlib figure contains its labels and title."""
    texts = ("0.0", "\u22125", "10", "time (s)", "a &amp; b", "How late?")
    drawing = "<svg>" + "".join(f'<text x="1">{each}</text>' for each in texts) + "</svg>"
    output = result(text_plain="<Figure>") | {"data": {"image/svg+xml": drawing, "text/plain": "<Figure>"}}
    assert 'alt="Figure: time (s), a &amp; b, How late?"' in shown(output).html


def test_a_picture_of_a_panel_is_shown_if_there_is_no_state() -> None:
    """If a panel has no state, the page shows its picture.

    Without a picture, the page shows the panel's text.
    """
    drawing = '<svg width="1"><title>The ROS graph: 2 &lt; 3 nodes</title><text>/a</text></svg>'
    data = {"image/svg+xml": drawing, "text/plain": "GraphPanel()"}
    body = shown(result() | {"data": data}).html
    assert 'alt="The ROS graph: 2 &lt; 3 nodes"' in body
    assert "GraphPanel()" not in body
    live = {**data, PANEL: {"panel": "graph", "state": {}}}
    assert "<img" not in shown(result() | {"data": live}).html


def test_an_error_looks_different_from_other_output() -> None:
    """A traceback and text on stderr have the CSS class `err`."""
    error = {"output_type": "error", "ename": "E", "evalue": "v", "traceback": ["\x1b[31mE\x1b[0m: v"]}
    stream = {"output_type": "stream", "name": "stderr", "text": "careful"}
    body = shown(error, stream).html
    assert body.count('class="out err"') == 2
    assert '<span class="ansi-red-fg">E</span>: v' in body


def test_a_terminals_output_is_shown_as_in_a_terminal() -> None:
    """The page shows terminal output without control characters."""
    assert terminal("one\r\ntwo\r\n") == "one\ntwo"
    assert terminal("10 %\r20 %\rdone\x1b[K\x07") == "done"
    assert terminal("<b>") == "&lt;b&gt;"


def test_an_exercise_can_be_linked_to() -> None:
    """The HTML id of an exercise contains the chapter's prefix and the id of the cell."""
    body = Exporter().body(book(exercise("05.1"), code("x")), "c05-")
    assert 'class="in exercise" id="c05-exercise-05-1"' in body.html
    assert body.html.count("id=") == 1


def test_the_states_of_panels_cannot_add_markup() -> None:
    """The states of panels are compressed, so they contain no HTML tags."""
    output = result() | {"data": {PANEL: {"panel": "graph", "state": {"title": "</script><script>alert(1)"}}}}
    body = shown(output).html
    assert 'data-panel="graph"' in body
    assert body.count("<script") == body.count("</script>") == 1
    assert "alert" not in body


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
    """Collects all tags and attributes of a page."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.seen: list[tuple[str, str, str]] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Store a tag with its attributes."""
        self.seen += [(tag, "", ""), *((tag, name, value or "") for name, value in attrs)]


@pytest.mark.parametrize("attack", ATTACKS)
def test_nothing_runs_or_loads(attack: str) -> None:
    """The sanitizer removes scripts, styles and addresses of other files."""
    for tag, name, value in Reader(Sanitizer()(attack)).seen:
        assert tag in ("p", "a", "div", "section", "img", "table")
        assert name in ("", "title")
        assert not value or name == "title"


def test_the_sanitizer_keeps_a_report() -> None:
    """The sanitizer does not change the text, structure and colours of a check's report."""
    rule = Assertion("it answers", holds=False, asked="2", expected="4", actual="<5>", hint="Add.")
    report = Report("05.1", Verdict.FAILED, "A goal.", 0, 2, (rule,), "Again.", "printed")
    clean = Sanitizer()(report.html())
    for part in (
        'class="course-report"',
        "border-left",
        "<strong>",
        'aria-label="does not hold"',
        "&lt;5&gt;",
    ):
        assert part in clean
    assert "<details>" in clean


def test_a_picture_with_its_data_in_the_page_stays() -> None:
    """If the page contains the data of a picture, the sanitizer does not change the picture."""
    picture = '<img src="data:image/png;base64,iVBORw0KGgo=" alt="a chair" width="64" height="48">'
    assert Sanitizer()(picture) == picture
