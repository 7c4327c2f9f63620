"""The still picture of the service panel: the form of the request, the response, and the commands."""

from __future__ import annotations

from course_pkg.panels.forms.still import draw_commands, draw_form, draw_values
from course_pkg.panels.paper import (
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

MOST = 12  # The picture lists at most this many services.
STATUS = {
    "idle": ("Not called yet.", FAINT),
    "running": ("Calling…", FAINT),
    "done": ("Answered", Style(colour=GOOD)),
    "failed": ("Failed", Style(colour=ERROR)),
    "cancelled": ("Cancelled", Style(colour=ERROR)),
}


def still(state: State) -> str:
    """Return the picture of the form and the latest response, without times: times differ in each run."""
    form, trouble = state.get("form", {}), state.get("trouble", "")
    name = form.get("service", "")
    kind = f" of type {form['type']}" if form.get("type") else ""
    paper = Paper(f"A form to call the service {name}{kind}" if name else "A form to call a service")
    paper.put("Service", EDGES, paper.y + 13, HEADING)
    paper.input(name or "Pick a service", left=EDGES + 72, width=260)
    about = f"served by {form['node']}" if form.get("node") else ""
    paper.put(form.get("type", ""), EDGES + 348, paper.y + 6, CODE)
    paper.put(about, EDGES + 348, paper.y + 22, FAINT)
    paper.y += 32
    paper.rule(4)
    for problem in (trouble, form.get("problem", "")):
        if problem:
            paper.band(problem, bad=True)
    if "request" in form:
        _draw_request(paper, state)
    elif not name:
        _draw_services(paper, state.get("services", ()))
    return paper.svg()


def _draw_request(paper: Paper, state: State) -> None:
    form, check, outcome = state["form"], state.get("check", {}), state.get("outcome", {})
    paper.write("Request", HEADING)
    paper.y += 4
    empty = "This request has no fields."
    draw_form(paper, form["request"]["fields"], state.get("draft", {}), empty)
    paper.y += 4
    paper.button("Call", EDGES, main=True)
    paper.put(f"Wait at most {state.get('deadline', '5')} s", EDGES + 88, paper.y + 14, FAINT)
    paper.y += 32
    paper.rule()
    paper.write("Response", HEADING)
    text, style = STATUS[outcome.get("phase", "idle")]
    paper.write(text, style)
    if "error" in outcome:
        _draw_error(paper, outcome["error"])
    elif "rows" in outcome:
        draw_values(paper, outcome["rows"], "The response has no fields.")
    paper.rule()
    commands = [("Terminal", check.get("shell", "")), ("Python", check.get("python", ""))]
    draw_commands(paper, "The same call as a command and in Python", commands)


def _draw_error(paper: Paper, error: State) -> None:
    paper.write(f"{error.get('name', '')}: {error.get('words', '')}", CODE)
    for part in ("cause", "remedy"):
        if error.get(part):
            paper.write(prose(error[part]), PLAIN)


def _draw_services(paper: Paper, services: list[State]) -> None:
    own = [each for each in services if not each["tool"]]
    paper.write(
        "Pick a service to see the fields of its request. On the graph now:" if own else "No service yet",
        FAINT,
    )
    paper.y += 4
    for each in own[:MOST]:
        paper.label(each["name"], f"{each['type']}  served by {each['node']}", left=240)
    if len(own) > MOST:
        paper.write(f"… and {len(own) - MOST} more", FAINT)
