"""Functions that draw a form, a table of values or commands into a still picture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from course_pkg.panels.paper import CODE, EDGES, FAINT, FAINT_CODE, HEADING, Column, Paper, State

MOST = 16  # A form or a table has at most this many rows.
FIELD = 250.0  # An input field is this many px wide.
INDENT = 14.0  # Each level of nesting moves a row to the right by this many px.


def draw_form(paper: Paper, fields: Sequence[State], draft: State, empty: str, room: float = FIELD) -> None:
    """Draw a row for each field of a message: its name, an input field, and its type."""
    controls = list(_controls(fields, draft, 0))
    if not controls:
        paper.write(empty, FAINT)
    widest = max((CODE.width(name) + INDENT * depth for depth, name, _, _ in controls), default=0.0)
    left = EDGES + min(max(widest + 16, 96.0), 220.0)
    for depth, name, kind, text in controls[:MOST]:
        paper.put(name, EDGES + INDENT * depth, paper.y + 13, CODE)
        if text is not None:
            paper.input(text, left=left, width=room)
        paper.put(kind, left + (room + 12 if text is not None else 0), paper.y + 13, FAINT_CODE)
        paper.y += 32
    if len(controls) > MOST:
        paper.write(f"… and {len(controls) - MOST} more", FAINT)


def _controls(
    fields: Sequence[State], draft: Mapping[str, Any], depth: int
) -> Iterator[tuple[int, str, str, str | None]]:
    """Yield the depth, name, type and text of each field; the text of a nested message is None."""
    for field in fields:
        given = draft.get(field["name"], field.get("default", ""))
        if isinstance(given, Mapping):
            yield depth, field["name"], field["type"], None
            yield from _controls(field.get("fields", ()), given, depth + 1)
        elif isinstance(given, str):
            yield depth, field["name"], field["type"], given
        else:
            yield depth, field["name"], field["type"], f"[{', '.join(map(_flat, given))}]"


def _flat(given: object) -> str:
    if isinstance(given, Mapping):
        return f"{{{', '.join(f'{name}: {_flat(each)}' for name, each in given.items())}}}"
    return given if isinstance(given, str) else f"[{', '.join(map(_flat, given))}]"  # type: ignore[call-overload]


def draw_values(paper: Paper, rows: Sequence[State], empty: str) -> None:
    """Draw the values of a message as a table."""
    columns = [Column(EDGES, 180, CODE), Column(210, 400, CODE), Column(620, 124, FAINT_CODE)]
    if not rows:
        paper.write(empty, FAINT)
    for row in rows[:MOST]:
        name = "\N{NO-BREAK SPACE}" * (2 * row["depth"]) + row["name"]
        paper.row(columns, (name, row["text"], row["type"]))
    if len(rows) > MOST:
        paper.write(f"… and {len(rows) - MOST} more", FAINT)


def draw_commands(paper: Paper, title: str, commands: Sequence[tuple[str, str]]) -> None:
    """Draw the text of each command with its label; draw nothing if all texts are empty."""
    shown = [(label, text) for label, text in commands if text]
    if shown:
        paper.write(title, HEADING)
        paper.y += 2
    for label, text in shown:
        paper.label(label, text)
        paper.y += 4
