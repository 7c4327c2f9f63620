"""Cells as HTML."""

from __future__ import annotations

import base64

from course_pkg.site.exhibits import EXHIBIT
from course_pkg.site.exporter import Exporter, terminal
from tests.authoring.books import book, code, exercise
from tests.site.shelves import result, shown


def test_a_result_is_shown() -> None:
    """As text, where there is nothing better, with what HTML would take for its own escaped."""
    assert "&lt;Box&gt; &amp; 3" in shown(result(text_plain="<Box> & 3")).html


def test_html_is_cleaned() -> None:
    """It goes before the text of the same result."""
    body = shown(result(text_html="<p onclick=f()>yes</p><script>no()</script>", text_plain="text")).html
    assert "<p>yes</p>" in body
    assert "onclick" not in body
    assert "<script>" not in body
    assert "text</pre>" not in body


def test_a_script_among_the_outputs_is_left_out() -> None:
    """Of JavaScript nothing is shown, not even as text."""
    assert "alert" not in shown(result(application_javascript="alert(1)")).html


def test_a_drawing_is_a_picture() -> None:
    """An SVG stands in an <img>, where no script of its own can run, and keeps its description."""
    drawing = "<svg><script>alert(1)</script></svg>"
    output = result(text_plain="x") | {
        "data": {"image/svg+xml": drawing},
        "metadata": {"image/svg+xml": {"alt": 'a "graph"'}},
    }
    body = shown(output).html
    assert base64.b64encode(drawing.encode()).decode() in body
    assert 'alt="a &quot;graph&quot;"' in body
    assert "<svg" not in body


def test_an_error_is_told_apart_from_output() -> None:
    """It has a class of its own, as has what was written to stderr."""
    error = {"output_type": "error", "ename": "E", "evalue": "v", "traceback": ["\x1b[31mE\x1b[0m: v"]}
    stream = {"output_type": "stream", "name": "stderr", "text": "careful"}
    body = shown(error, stream).html
    assert body.count('class="out err"') == 2
    assert '<span class="ansi-red-fg">E</span>: v' in body


def test_a_terminal_is_read_as_it_looks() -> None:
    """What a carriage return wrote over is gone, lines end in one way, and no control is left."""
    assert terminal("one\r\ntwo\r\n") == "one\ntwo"
    assert terminal("10 %\r20 %\rdone\x1b[K\x07") == "done"
    assert terminal("<b>") == "&lt;b&gt;"


def test_an_exercise_can_be_linked_to() -> None:
    """By the id that its cell has in the notebook, behind the prefix of its chapter."""
    body = Exporter().body(book(exercise("05.1"), code("x")), "c05-")
    assert 'class="in exercise" id="c05-exercise-05-1"' in body.html
    assert body.html.count("id=") == 1


def test_the_states_of_panels_cannot_end_their_element() -> None:
    """They are packed, so that no text in them is markup."""
    output = result() | {
        "data": {EXHIBIT: {"panel": "plot", "state": {"title": "</script><script>alert(1)"}}}
    }
    body = shown(output).html
    assert 'data-panel="plot"' in body
    assert body.count("<script") == body.count("</script>") == 1
    assert "alert" not in body
