"""The still picture of the type browser: the fields of the open type, and its services or topics."""

from __future__ import annotations

from collections.abc import Sequence

from course_pkg.panels.forms.still import draw_commands
from course_pkg.panels.paper import (
    CODE,
    EDGES,
    ERROR,
    FAINT,
    FAINT_CODE,
    HEADING,
    Column,
    Paper,
    State,
    Style,
)

HALVES = {"srv": "service type", "msg": "message type"}
INDENT = 16.0  # The widths are in px.
MOST = 40  # A request, a response or a message shows at most this many fields.


def still(state: State) -> str:
    """Return the picture of the open type, without the list of types and without the path of the file."""
    described = state.get("described") or {}
    if not described.get("name"):
        count = sum(len(each["srv"]) + len(each["msg"]) for each in state.get("packages", ()))
        paper = Paper("The type browser: no type is open")
        paper.write(f"{count} types in {len(state.get('packages', ()))} packages. Pick a type.", FAINT)
        return paper.svg()
    name, half = described["name"], described["half"]
    paper = Paper(f"The {HALVES[half]} {name}")
    paper.put(HALVES[half], paper.width - EDGES, paper.y + 10, FAINT, anchor="end")
    paper.write(name, Style(14.0, bold=True, mono=True))
    for problem in (described.get("problem"), described.get("warning")):
        if problem:
            paper.write(problem, Style(colour=ERROR))
    for part in described["parts"]:
        paper.y += 6
        paper.write(part["title"], HEADING)
        _draw_part(paper, part)
    _draw_offers(paper, state, name, half)
    paper.rule()
    lines = [("MD5", described["md5"]), *((each["label"], each["text"]) for each in described["lines"])]
    for label, text in lines:
        paper.label(label, text, left=152)
    paper.y += 8
    draw_commands(paper, f"The text of {name}", [(half, described["text"].rstrip())])
    return paper.svg()


def _draw_part(paper: Paper, part: State) -> None:
    if part["help"]:
        paper.write(part["help"], FAINT)
    if not part["fields"] and not part["constants"]:
        paper.write("no fields", FAINT)
    _draw_fields(paper, part["fields"][:MOST], EDGES)
    for each in part["constants"][:MOST]:
        paper.row(_columns(EDGES), (each["type"], f"{each['name']} = {each['value']}", "constant"))


def _draw_fields(paper: Paper, fields: Sequence[State], left: float) -> None:
    for each in fields:
        paper.row(_columns(left), (each["type"], each["name"], each["help"]))


def _columns(left: float) -> list[Column]:
    return [
        Column(left, 180, FAINT_CODE),
        Column(left + 190, 230, CODE),
        Column(left + 430, 298 - left + EDGES, FAINT),
    ]


def _draw_offers(paper: Paper, state: State, name: str, half: str) -> None:
    rows = (state.get("offers") or {}).get(half, {}).get(name, ())
    paper.y += 6
    paper.write("On the graph now", HEADING)
    if not rows:
        paper.write(f"No {'service' if half == 'srv' else 'topic'} has this type.", FAINT)
    for row in rows:
        ends = [f"{label} {', '.join(nodes) or 'no node'}" for label, nodes in row.items() if label != "name"]
        paper.write(f"{row['name']}  {', '.join(ends)}", CODE)
