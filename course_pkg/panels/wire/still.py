"""The still picture of a call: a sequence diagram of the steps, and the bytes of some steps."""

from __future__ import annotations

import re
from collections.abc import Sequence

from course_pkg.panels.paper import (
    CODE,
    EDGES,
    ERROR,
    FAINT,
    FAINT_CODE,
    GROUND,
    HEADING,
    LINE,
    TEXT,
    Column,
    Paper,
    State,
    Style,
    cut,
    wrapped,
)

# The x coordinates of the client, the server and the master (px).
ENDS = {"client": 100.0, "server": 440.0, "master": 660.0}
ROW = 34.0  # A step is this many px high.
MOST, BYTES = 24, 8  # A step shows at most `MOST` pieces, and a piece shows at most `BYTES` bytes.
# A fixed text replaces each address: the ports differ in each run.
ADDRESS = re.compile(r"(?:rosrpc://|http://)?[\w.-]+:\d{4,5}\b/?")
SMALL = Style(12.0)
DETAILED = ("Request", "Response", "Error")


def still(state: State) -> str:
    """Return the picture of the steps, and of the request and response bytes, without times and ports."""
    exchange = state["exchange"]
    steps = exchange["steps"]
    paper = Paper(f"A call of {exchange['service']}, byte by byte: {len(steps)} steps")
    paper.write(f"A call of {exchange['service']}, byte by byte", HEADING)
    paper.y += 4
    if exchange["outcome"]:
        paper.band(f"The call failed: {_stable(exchange['outcome'])}", bad=True)
    if not steps:
        paper.write("No connection was made during the recording.", FAINT)
    else:
        _draw_steps(paper, exchange["names"], steps)
    for step in steps:
        if step["pieces"] and (step["title"] in DETAILED or step["bad"]):
            _draw_pieces(paper, step)
    return paper.svg(" ".join(f"{_stable(step['title'])}." for step in steps))


def _draw_steps(paper: Paper, names: State, steps: Sequence[State]) -> None:
    used = [end for end in ENDS if any(end in (step["from"], step["to"]) for step in steps)]
    for end in used:
        paper.put(cut(names[end], CODE, 190), ENDS[end], paper.y + 8, CODE, anchor="middle")
    paper.y += 20
    for end in used:
        paper.add("path", d=f"M{ENDS[end]:.1f} {paper.y:.1f}v{ROW * len(steps) + 6:.1f}", stroke=LINE)
    for step in steps:
        _draw_step(paper, step)
    paper.y += 10


def _draw_step(paper: Paper, step: State) -> None:
    start, tip = ENDS[step["from"]], ENDS[step["to"]]
    colour, y = ERROR if step["bad"] else TEXT, paper.y + ROW - 6
    back = 8.0 if tip > start else -8.0
    paper.add("path", d=f"M{start:.1f} {y:.1f}H{tip:.1f}", stroke=colour, stroke_width=1.5)
    paper.add("path", d=f"M{tip:.1f} {y:.1f}l{-back:.1f} -4v8z", fill=colour)
    number = f"{step['connection']}: " if step["connection"] else ""
    size = f", {step['size']:,} bytes" if step["size"] else ""
    style = Style(12.0, colour=colour)
    text = cut(f"{number}{_stable(step['title'])}{size}", style, abs(tip - start) - 16)
    middle, wide = (start + tip) / 2, style.width(text)
    paper.box(middle - wide / 2, y - 20, wide, 16, fill=GROUND, rx=0)
    paper.put(text, middle, y - 12, style, anchor="middle")
    paper.y += ROW


def _draw_pieces(paper: Paper, step: State) -> None:
    paper.rule()
    paper.write(f"{step['title']}, {step['size']:,} bytes", HEADING)
    paper.y += 2
    columns = [
        Column(EDGES, 40, FAINT_CODE),
        Column(64, 196, CODE),
        Column(276, 150, SMALL),
        Column(436, 84, FAINT_CODE),
        Column(530, 214, CODE),
    ]
    for piece in step["pieces"][:MOST]:
        group = piece["role"] == "group"
        at = "" if group else str(piece["at"])
        name = "\N{NO-BREAK SPACE}" * 3 * piece["depth"] + piece["name"]
        value = wrapped(_stable(piece["value"]), CODE, 214)
        shown = value[0] + ("…" if len(value) > 1 else "")
        paper.row(columns, (at, _bytes(piece), name, piece["type"], shown), room=2)
    if len(step["pieces"]) > MOST:
        paper.write(f"… and {len(step['pieces']) - MOST} more", FAINT)


def _bytes(piece: State) -> str:
    pairs = [piece["hex"][at : at + 2] for at in range(0, min(len(piece["hex"]), 2 * BYTES), 2)]
    return " ".join(pairs) + ("…" if piece["size"] > len(pairs) and pairs else "")


def _stable(text: str) -> str:
    return ADDRESS.sub("the address of the server", text)
