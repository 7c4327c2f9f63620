"""The progress as HTML, for a notebook's output and for the exported page. All texts are escaped."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path

from course_pkg.overview.model import NO_GRADE, ChapterProgress, PartProgress, Progress
from course_pkg.overview.steps import Step, next_steps
from course_pkg.overview.text import LEGEND, answers, headline, of

STYLE = Path(__file__).with_name("overview.css")
HEAD = ("Chapter", "Parts", "Passed", "Points", "Predictions")


def overview_output(progress: Progress) -> str:
    """Return HTML for the output of a cell: a table of all chapters, and the next steps."""
    return _output(
        [_strong(headline(progress)), chapters_table(progress), steps_html(next_steps(progress))], progress
    )


def chapter_output(progress: Progress, steps: Sequence[Step]) -> str:
    """Return HTML for the output of a cell: a table of one chapter's parts, and the next steps."""
    chapter = progress.chapters[0]
    head = _strong(headline(progress, chapter.number))
    return _output([head, parts_table(chapter), steps_html(steps)], progress)


def chapters_table(progress: Progress, *, links: bool = True) -> str:
    """Return a table with a row for each chapter. If `links` is True, each title links to the notebook."""
    rows = "".join(_row(chapter, links=links) for chapter in progress.chapters)
    return f"{_table('Chapters', HEAD, rows)}<p class='course-muted'>{escape(LEGEND)}</p>"


def parts_table(chapter: ChapterProgress) -> str:
    """Return a table with a row for each part of a chapter."""
    rows = "".join(
        f"<tr><td>{_mark(part)}</td><th scope='row'>{escape(part.check)}</th><td>{escape(part.state)}</td>"
        f"<td>{of((part.earned, part.possible))}</td><td class='course-goal'>{escape(part.goal)}</td></tr>"
        for part in chapter.parts
    )
    return _table(f"Parts of chapter {chapter.number}", ("", "Part", "Result", "Points", "Goal"), rows)


def steps_html(steps: Sequence[Step], *, links: bool = True) -> str:
    """Return a paragraph with the next steps. If `links` is True, each step links to its notebook."""
    texts = " or ".join(_step(step, links=links) for step in steps)
    return f"<p><strong>Next:</strong> {texts}</p>"


def problems_html(progress: Progress) -> str:
    """Return a paragraph for each message about a record that cannot be read."""
    return "".join(f"<p class='course-problem'>{escape(text)}</p>" for text in progress.problems)


def _output(parts: Sequence[str], progress: Progress) -> str:
    inside = "".join((*parts, problems_html(progress), f"<p class='course-muted'>{escape(NO_GRADE)}</p>"))
    return f"<style>{STYLE.read_text('utf-8')}</style><section class='course-progress'>{inside}</section>"


def _table(caption: str, head: Sequence[str], rows: str) -> str:
    cells = "".join(f"<th scope='col'>{name}</th>" if name else "<td></td>" for name in head)
    return (
        f"<div class='course-scroll' tabindex='0' role='region' aria-label='{escape(caption)}'>"
        f"<table><thead><tr>{cells}</tr></thead><tbody>{rows}</tbody></table></div>"
    )


def _row(chapter: ChapterProgress, *, links: bool) -> str:
    title = _link(chapter.notebook, chapter.title) if links else escape(chapter.title)
    cells = [
        "".join(map(_mark, chapter.parts)),
        of((chapter.passed, len(chapter.parts))),
        of(chapter.points),
        answers(chapter),
    ]
    return (
        f"<tr><th scope='row'><span class='course-number'>{chapter.number}</span> {title}</th>"
        + "".join(f"<td>{cell}</td>" for cell in cells)
        + "</tr>"
    )


def _mark(part: PartProgress) -> str:
    kind = "passed" if part.passed else "tried" if part.record else "open"
    label = escape(f"{part.check} {part.state}")
    title = escape(f"{part.check} {part.state}: {part.goal}")
    return f"<span class='course-{kind}' role='img' aria-label='{label}' title='{title}'>{part.mark}</span>"


def _step(step: Step, *, links: bool) -> str:
    if not step.notebook:
        return escape(step.text)
    where = _link(step.notebook, step.notebook) if links else f"<code>{escape(step.notebook)}</code>"
    return f"{where}: {escape(step.text)}"


def _link(notebook: str, text: str) -> str:
    return f"<a href='{escape(notebook)}'>{escape(text)}</a>"


def _strong(text: str) -> str:
    return f"<p><strong>{escape(text)}</strong></p>"


def sections(progress: Progress) -> Iterator[str]:
    """Yield a section with the parts of each chapter, for the exported page."""
    for chapter in progress.chapters:
        result = answers(chapter)
        count = f"{of((chapter.passed, len(chapter.parts)))} parts passed, {of(chapter.points)} points"
        predicted = f", predictions: {result}" if result else ""
        yield (
            f"<h2>{escape(f'{chapter.number} {chapter.title}')}</h2>"
            f"<p>{escape(count + predicted)}</p>{parts_table(chapter)}"
        )
