"""Tests of Markdown on a page."""

from __future__ import annotations

import pytest

from course_pkg.errors import SiteError
from course_pkg.site.markup.prose import Prose, page_of


def prose(prefix: str = "") -> Prose:
    """Return a converter from Markdown to HTML that does not change code."""
    return Prose(lambda code, _language: code, prefix)


def test_raw_html_is_shown_as_text() -> None:
    """HTML tags in prose are escaped."""
    assert "&lt;script&gt;" in prose()("<script>alert(1)</script>")
    assert "&lt;b&gt;" in prose()("a <b>word</b>")


@pytest.mark.parametrize("link", ["javascript:alert(1)", "data:text/html,x", "vbscript:x"])
def test_a_link_cannot_run(link: str) -> None:
    """The converter removes a script in a link's address."""
    assert link.partition(":")[0] not in prose()(f"[here]({link})")


def test_each_heading_has_a_different_anchor() -> None:
    """Headings with the same text have different anchors, which begin with the chapter's prefix."""
    page = prose("c05-")
    page("# Ask, and wait\n\n## Again")
    page("## Again\n\n### `rosservice`?")
    assert page.headings == [
        (1, "c05-ask-and-wait", "Ask, and wait"),
        (2, "c05-again", "Again"),
        (2, "c05-again-2", "Again"),
        (3, "c05-rosservice", "rosservice?"),
    ]


@pytest.mark.parametrize(
    ("link", "page"),
    [
        ("05_write_a_server.ipynb", "05_write_a_server.html"),
        ("05_write_a_server.ipynb#refuse", "05_write_a_server.html#refuse"),
        ("other.ipynb", "other.ipynb"),
        ("#here", "#here"),
    ],
)
def test_a_link_to_a_chapter_leads_to_its_page(link: str, page: str) -> None:
    """A link to a notebook becomes a link to the page of the chapter."""
    assert page_of(link) == page
    assert f'href="{page}"' in prose()(f"[there]({link})")


def test_a_formula_is_mathml() -> None:
    """A formula becomes MathML without dollar signs."""
    html = prose()("so $d_n = 2^n$ it is\n\n$$\n\\sum_{n=0}^{7} 2^n\n$$")
    assert html.count("<math ") == 2
    assert 'display="inline"' in html
    assert 'display="block"' in html
    assert "<msup><mn>2</mn><mi>n</mi></msup>" in html
    assert "$" not in html


@pytest.mark.parametrize(
    "text", ["It costs $5, and then $7.", "`$A` and `$B`", "```\n$x$\n```", "It costs 5 $ or 6 $."]
)
def test_other_dollar_signs_stay_text(text: str) -> None:
    """Prices and shell variables are not formulas."""
    assert "<math" not in prose()(text)


def test_an_invalid_formula_is_refused() -> None:
    """The error message for an invalid formula contains the formula."""
    with pytest.raises(SiteError, match=r"The formula \$2\^2\^2\$ cannot be read"):
        prose()("so $2^2^2$")
