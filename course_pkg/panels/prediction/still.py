"""The still picture of a question, of a comparison, or of a table of predictions."""

from __future__ import annotations

from course_pkg.panels.paper import (
    ACCENT,
    EDGES,
    ERROR,
    FAINT,
    GOOD,
    HEADING,
    MUTED,
    PLAIN,
    TEXT,
    Column,
    Paper,
    State,
    Style,
    prose,
)

TAG = Style(12.0, bold=True, colour=ACCENT)
RESULTS = {
    "open": ("not compared yet", MUTED),
    "decided": ("decided", MUTED),
    "late": ("no prediction", MUTED),
    "right": ("as predicted", GOOD),
    "wrong": ("otherwise", ERROR),
}
MARKS = {"✓": GOOD, "✗": ERROR}


def still(state: State) -> str:
    """Return the picture of the panel: a question, a comparison, or a table of predictions."""
    part = state["part"]
    if part == "question":
        return _question(state)
    return _comparison(state["record"]) if part == "comparison" else _table(state)


def _question(state: State) -> str:
    choices = state["choices"]
    options = f" Choices: {', '.join(choices)}." if choices else ""
    paper = Paper(f"Prediction: {state['question']}{options}")
    paper.put("Predict", EDGES, paper.y + PLAIN.height / 2, TAG)
    paper.write(prose(state["question"]), HEADING, left=EDGES + 64)
    paper.y += 8
    if choices:
        paper.options(choices, state.get("answer", ""))
    else:
        paper.put("Your answer", EDGES, paper.y + 13)
        paper.input(state.get("answer", ""), left=EDGES + 88, width=320)
        paper.y += 32
    paper.write("Answer before you run the next cell.", FAINT)
    return paper.svg()


def _comparison(record: State) -> str:
    sides = (("You predicted", record["predicted"] or "nothing"), ("What really happened", record["actual"]))
    paper = Paper(". ".join(f"{label}: {text}" for label, text in sides) + ".")
    for label, text in sides:
        paper.put(label, EDGES, paper.y + PLAIN.height / 2, FAINT)
        paper.write(text, HEADING, left=EDGES + 152)
    paper.y += 4
    paper.write(record["verdict"], Style(colour=RESULTS[record["state"]][1]))
    return paper.svg()


def _table(state: State) -> str:
    records, progress = state["records"], state.get("row") or {}
    paper = Paper(f"Predictions of chapter {state['chapter']}" if state["chapter"] else "Predictions")
    columns = [Column(EDGES, 276), Column(304, 124), Column(440, 172), Column(624, 120)]
    if records:
        heads = ("Question", "You predicted", "What really happened", "Result")
        paper.row([Column(each.left, each.width, HEADING) for each in columns], heads)
        paper.rule(2)
    for record in records:
        word, colour = RESULTS[record["state"]]
        styled = [*columns[:3], Column(columns[3].left, columns[3].width, Style(colour=colour))]
        shown = (record["predicted"] or "nothing", record["actual"] or "not known yet")
        paper.row(styled, (prose(record["question"]), *shown, record.get("result") or word))
    paper.write(_score(records) if records else "Nothing has been predicted yet.", FAINT)
    if progress:
        paper.rule()
        _progress(paper, progress)
    return paper.svg(progress.get("text", ""))


def _score(records: list[State]) -> str:
    """Return how many predictions were right, and how many choices were expected options."""
    right, wrong = (sum(each["state"] == which for each in records) for which in ("right", "wrong"))
    said = f"{right} of {right + wrong} predictions were right. " if right + wrong else ""
    cases, fit = (sum(each.get(name, 0) for each in records) for name in ("cases", "fit"))
    said += f"{fit} of {cases} choices fit. " if cases else ""
    return (said or "No prediction has been compared yet. ").rstrip()


def _progress(paper: Paper, progress: State) -> None:
    paper.write(progress["text"], HEADING)
    at = EDGES
    paper.y += 4
    for part in progress["parts"]:
        text = f"{part['mark']} {part['check']}"
        if at + PLAIN.width(text) > paper.width - EDGES:
            at, paper.y = EDGES, paper.y + PLAIN.height
        paper.put(text, at, paper.y + PLAIN.height / 2, Style(colour=MARKS.get(part["mark"], TEXT)))
        at += PLAIN.width(text) + 20
    paper.y += PLAIN.height + 4
    paper.write(prose(progress["next"]))
    for problem in progress.get("problems", ()):
        paper.write(problem, Style(colour=ERROR))
