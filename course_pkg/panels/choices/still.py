"""The still picture of the choices panel: the cases, the options, and the reasons if the panel shows them."""

from __future__ import annotations

from course_pkg.panels.paper import (
    ACCENT,
    EDGES,
    ERROR,
    FAINT,
    GOOD,
    HEADING,
    PLAIN,
    Paper,
    State,
    Style,
    prose,
)

INDENT = 24.0  # distance in px between the left edges of a case's number and of the case's text


def still(state: State) -> str:
    """Return the picture of all cases with their options."""
    paper = Paper(f"{prose(state['question'])} {len(state['cases'])} cases, each with the same options")
    paper.put("Choose", EDGES, paper.y + PLAIN.height / 2, Style(12.0, bold=True, colour=ACCENT))
    paper.write(prose(state["question"]), HEADING, left=EDGES + 56)
    verdicts = state.get("verdicts", ())
    for number, text in enumerate(state["cases"]):
        paper.y += 8
        paper.put(f"{number + 1}.", EDGES, paper.y + PLAIN.height / 2)
        paper.write(prose(text), left=EDGES + INDENT)
        paper.y += 2
        paper.options(map(prose, state["options"]), prose(state["chosen"][number]), left=EDGES + INDENT)
        if verdicts:
            verdict = verdicts[number]
            said = "Fits." if verdict["fits"] else f"Does not fit. Better: {verdict['answer']}."
            colour = GOOD if verdict["fits"] else ERROR
            paper.write(f"{said} {prose(verdict['reason'])}", Style(colour=colour), left=EDGES + INDENT)
    paper.y += 8
    paper.button("Choose again" if verdicts else "Show the reasons", EDGES, main=not verdicts)
    still_open = sum(not each for each in state["chosen"])
    words = (
        "Each case has an answer."
        if not still_open
        else f"{still_open} of {len(state['chosen'])} cases have no answer."
    )
    paper.put(words, EDGES + 176, paper.y + 14, FAINT)
    paper.y += 30
    return paper.svg()
