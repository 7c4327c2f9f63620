"""The landing page: the question, the chapters, the systems that run."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from course_pkg.site.chapters import Chapter, hours
from course_pkg.site.pages import COURSE, Page, Press

HERE = Path(__file__).parent


def landing(press: Press, chapters: Sequence[Chapter]) -> Page:
    """Return the page that a reader opens first."""
    systems = json.loads((HERE / "systems.json").read_text("utf-8"))
    by_number = {chapter.number: chapter for chapter in chapters}
    for system in systems:
        system["chapters"] = [by_number[number] for number in system["chapters"] if number in by_number]
    html = press.part(
        "landing.html.j2",
        systems=[system for system in systems if system["chapters"]],
        hours=hours(chapters),
        exercises=sum(len(chapter.points) for chapter in chapters),
        drawing=drawing(),
    )
    return Page("index.html", "landing", COURSE, "A course on ROS 1 services.", html)


def drawing() -> Markup:
    """Return the drawing of the two ways to talk."""
    return Markup((HERE / "template" / "waiting.svg").read_text("utf-8"))  # noqa: S704 -- a file of ours
