"""The still picture of the topic panel: the nodes on the topic, the form, and the commands."""

from __future__ import annotations

from collections.abc import Sequence

from course_pkg.panels.forms.still import draw_commands, draw_form
from course_pkg.panels.paper import CODE, EDGES, ERROR, FAINT, HEADING, PLAIN, Paper, State, Style


def still(state: State) -> str:
    """Return the picture of the panel before a message is published or received."""
    about, connections = state["about"], state.get("connections", {})
    message = about.get("message", {})
    kind = f" of type {message['name']}" if message else ""
    paper = Paper(f"A form to publish on the topic {about['topic']}{kind}")
    paper.put("Topic", EDGES, paper.y + PLAIN.height / 2, HEADING)
    paper.put(about["topic"], EDGES + 56, paper.y + PLAIN.height / 2, Style(mono=True, bold=True))
    paper.put(message.get("name", ""), paper.width - EDGES, paper.y + PLAIN.height / 2, CODE, anchor="end")
    paper.y += PLAIN.height + 6
    paper.label("Published by", _names(connections.get("publishers", ())))
    paper.label("Subscribed by", _names(connections.get("subscribers", ())))
    for text in (*connections.get("warnings", ()), about.get("problem", ""), state.get("trouble", "")):
        if text:
            paper.write(text, Style(colour=ERROR))
    if message:
        _draw_publishing(paper, state)
    return paper.svg()


def _draw_publishing(paper: Paper, state: State) -> None:
    settings, check = state.get("settings", {}), state.get("check", {})
    paper.rule()
    paper.write("Publish", HEADING)
    paper.y += 4
    fields = state["about"]["message"]["fields"]
    draw_form(paper, fields, state.get("draft", {}), "This message has no fields.")
    paper.y += 4
    at = EDGES
    for label, value, unit in (
        ("Rate", settings["rate"], "Hz"),
        ("Queue size", settings["queue"], "messages"),
    ):
        paper.put(label, at, paper.y + 13)
        at += PLAIN.width(label) + 8
        paper.input(value, left=at, width=64)
        paper.put(unit, at + 72, paper.y + 13, FAINT)
        at += 88 + FAINT.width(unit) + 16
    paper.y += 36
    at = paper.button("Publish", EDGES, main=True)
    at = paper.button("Publish at a rate", at)
    paper.button(f"Publish {state['about'].get('burst', 1000):,} at once", at)
    paper.y += 32
    paper.rule()
    commands = [("once", "once"), ("at a rate", "often"), ("Python", "python")]
    listen = [(line.split(" ")[1], line) for line in state["about"].get("listen", ())]
    draw_commands(
        paper,
        "The same as commands and in Python",
        [*((label, check.get(name, "")) for label, name in commands), *listen],
    )


def _names(nodes: Sequence[State]) -> str:
    return ", ".join(each["node"] for each in nodes) or "no node"
