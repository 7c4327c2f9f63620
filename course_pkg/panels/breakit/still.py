"""The still picture of the panel "Break it": the list of cases, and the open case."""

from __future__ import annotations

from course_pkg.panels.paper import (
    ACCENT,
    CODE,
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

BEGIN = (
    "Each case causes a real fault on the graph, and shows its symptoms. Find the fault. Click a case to "
    "begin. When the next case begins, the panel removes this fault."
)
VERDICTS = {"right": GOOD, "half": ACCENT, "wrong": ERROR, "shown": ACCENT}


def still(state: State) -> str:
    """Return the picture of the list of cases and of the open case, if a case is open."""
    cases, score, case = state["cases"], state["score"], state.get("case") or {}
    paper = Paper(f"The lab Break it: {len(cases)} cases, {score['solved']} of them solved")
    paper.put("Break it", EDGES, paper.y + PLAIN.height / 2, Style(12.0, bold=True, colour=ACCENT))
    words = f"{score['solved']} of {score['of']} solved"
    paper.put(words, paper.width - EDGES, paper.y + PLAIN.height / 2, FAINT, anchor="end")
    paper.write("Find the fault", HEADING, left=EDGES + 64)
    paper.y += 6
    at = EDGES
    for each in cases:
        text = f"Case {each['number']}"
        if at + PLAIN.width(text) + 24 > paper.width - EDGES:
            at, paper.y = EDGES, paper.y + 36
        at = paper.button(text, at, main=each["number"] == case.get("number"))
    paper.y += 36
    if state.get("trouble"):
        paper.band(state["trouble"], bad=True)
    if case:
        _draw_case(paper, case)
    else:
        paper.write(BEGIN, FAINT)
    return paper.svg()


def _draw_case(paper: Paper, case: State) -> None:
    paper.write(prose(case["story"]))
    for look in case["looks"]:
        paper.y += 6
        paper.write(look["shown"], CODE)
        paper.write(look["said"], CODE)
        if look["verdict"]:
            paper.write(look["verdict"], FAINT)
    for title, options in (("What is wrong?", case["diagnoses"]), ("What helps?", case["remedies"])):
        paper.y += 6
        paper.write(title, HEADING)
        for option in options:
            paper.options([prose(option)])
    verdict = case.get("verdict") or {}
    if verdict:
        paper.write(verdict["words"], Style(bold=True, colour=VERDICTS[verdict["state"]]))
        for part in ("diagnosis", "remedy", "reason"):
            if verdict.get(part):
                paper.write(prose(verdict[part]))
