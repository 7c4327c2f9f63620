"""The progress as one HTML page, which needs no other files and no network."""

from __future__ import annotations

from datetime import datetime, timezone
from html import escape

from course_pkg.overview.markup import (
    STYLE,
    chapters_table,
    problems_html,
    sections,
    steps_html,
)
from course_pkg.overview.model import NO_GRADE, Progress
from course_pkg.overview.steps import next_steps
from course_pkg.overview.text import headline

# With this policy, the page cannot load any other file.
POLICY = "default-src 'none'; style-src 'unsafe-inline'"
PAGE_STYLE = """
:root { color-scheme: light dark; }
body { margin: 0 auto; max-width: 60rem; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif;
  color: light-dark(#1c2127, #e6e9ec); background: light-dark(#ffffff, #16191d); }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2rem; }
@media print { .course-progress .course-scroll { overflow: visible; } h2 { break-after: avoid; } }
"""


def page(progress: Progress) -> str:
    """Return the whole page: a table of the chapters, and then the parts of each chapter."""
    made = datetime.now(timezone.utc).strftime("%d %B %Y, %H:%M UTC")
    body = (
        "<h1>Progress in the course on ROS 1 services</h1>"
        f"<p><strong>{escape(headline(progress))}</strong></p>"
        f"{steps_html(next_steps(progress), links=False)}{problems_html(progress)}"
        f"{chapters_table(progress, links=False)}{''.join(sections(progress))}"
        f"<p class='course-muted'>{escape(NO_GRADE)} Written on {made}.</p>"
    )
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        f"<title>Progress in the course</title><style>{STYLE.read_text('utf-8')}{PAGE_STYLE}</style></head>"
        f'<body><main class="course-progress">{body}</main></body></html>\n'
    )
