"""The still picture of the graph: the panel's drawing with fixed colours, and a legend for the shapes."""

from __future__ import annotations

import re
from xml.etree.ElementTree import Element, fromstring

from course_pkg.panels.graph.drawing import ABOVE
from course_pkg.panels.paper import CODE, EDGES, FAINT, GROUND, MONO, MUTED, TEXT, WIDTH, Paper, State, number

# Each shape has a fill colour and an edge colour from the light theme of drawing.css.
SHAPES = {
    "ros-node": ("#e7f0fc", "#3a78c9"),
    "ros-topic": ("#f1f2f4", "#6b7580"),
    "ros-service": ("#fdf1dc", "#a5660a"),
    "ros-namespace": ("#e9f3ea", "#3f7d4b"),
}
LEGEND = (
    ("ros-node", "node"),
    ("ros-topic", "topic: messages in one direction"),
    ("ros-service", "service: a request and its response"),
)
STREAM, CALL = SHAPES["ros-topic"][1], SHAPES["ros-service"][1]
ROLES = ("publishes", "subscribes", "serves")
# The pattern matches the suffix that rospy and roscpp add to the name of an anonymous node.
NUMBERED = re.compile(r"_\d+_\d{10,}")


def still(state: State) -> str:
    """Return the picture without rates and recent calls; these values differ in each run."""
    drawing, trouble = state.get("drawing", ""), state.get("trouble", "")
    if not drawing:
        return _without_drawing(state, trouble)
    root = fromstring(drawing)  # noqa: S314 - the panel itself has made this XML
    counts = _text(root, "desc").partition(". ")[0]
    wide, high = (float(root.get(side, "0")) for side in ("width", "height"))
    paper = Paper(f"The ROS graph: {counts}", max(WIDTH, wide + 2 * EDGES))
    scale = 1.0
    # The picture has at most twice the standard width; a wider drawing is scaled down.
    if wide + 2 * EDGES > 2 * WIDTH:
        scale = (2 * WIDTH - 2 * EDGES) / wide
        paper.width = 2 * WIDTH
    if trouble:
        paper.band(trouble, bad=True)
    left = (paper.width - scale * wide) / 2
    group = Element("g", {"transform": f"translate({number(left)} {number(paper.y)}) scale({scale:.3g})"})
    group.extend(_plain(each) for each in root if _tag(each) == "g")
    paper.put_in(group)
    paper.y += scale * high + 4
    paper.rule(4)
    _legend(paper, lost=any(fact["lost"] for fact in state.get("facts", ())))
    return paper.svg(_roles(state))


def _without_drawing(state: State, trouble: str) -> str:
    paper = Paper("The ROS graph")
    if trouble:
        paper.band(trouble, bad=True)
    if not state.get("facts"):
        paper.write("The graph has no nodes.", FAINT)
    for fact in state.get("facts", ()):
        paper.label(fact["kind"], fact["name"])
    return paper.svg()


def _legend(paper: Paper, *, lost: bool) -> None:
    at, middle = EDGES, paper.y + 10
    for kind, text in (*LEGEND, *((("", "dashed: does not answer"),) if lost else ())):
        fill, edge = SHAPES.get(kind, (GROUND, MUTED))
        x, y = number(at), number(middle - 7)
        if kind == "ros-node":
            paper.add("ellipse", cx=at + 14, cy=middle, rx=14, ry=7, fill=fill, stroke=edge)
        elif kind == "ros-topic":
            paper.add("rect", x=x, y=y, width=28, height=14, rx=2, fill=fill, stroke=edge)
        elif not kind:
            dashed = paper.add("path", d=f"M{x} {number(middle)}h28", stroke=edge, stroke_width=1.5)
            dashed.set("stroke-dasharray", "5 4")
        else:
            paper.add("path", d=f"M{x} {number(middle)}l6 -7h16l6 7l-6 7h-16z", fill=fill, stroke=edge)
        paper.put(text, at + 36, middle, FAINT)
        at += 36 + FAINT.width(text) + 24
    paper.y += 20


def _roles(state: State) -> str:
    """Return a text for readers who cannot see the picture: the topics and services of each node."""
    sentences = []
    for fact in state.get("facts", ()):
        said = [f"{label} {text}" for label, text in fact["facts"] if label in ROLES]
        if fact["kind"] == "node" and said:
            sentences.append(f"{fact['name']} {', '.join(said)}.")
    return NUMBERED.sub("…", " ".join(sentences))


def _plain(element: Element, classes: frozenset[str] = frozenset()) -> Element:
    """Return a copy of the element for a still picture.

    In the copy, colours are attributes, and elements that only an interactive page needs are left out.
    """
    own = frozenset(element.get("class", "").split())
    around = classes | own
    tag = _tag(element)
    kept = {name: value for name, value in element.attrib.items() if name in KEPT}
    made = Element(tag, {**kept, **_colours(tag, own, around)})
    made.text = NUMBERED.sub("…", element.text or "") if tag == "text" else None
    made.extend(_plain(child, around) for child in element if not _only_live(child))
    if "ros-topic" in own:
        # In the still picture, a topic has no rate below its name, so the name moves to the middle.
        for name in made.findall("text"):
            name.set("y", number(float(name.get("y", "0")) - ABOVE))
    return made


def _only_live(element: Element) -> bool:
    """Return whether only an interactive page needs an element: a title, calls, or an empty note."""
    classes = element.get("class", "").split()
    return (
        _tag(element) == "title"
        or "ros-calls" in classes
        or ("ros-note" in classes and not (element.text or "").strip())
    )


KEPT = frozenset(
    ("transform", "x", "y", "width", "height", "rx", "ry", "cx", "cy", "r", "d", "points", "text-anchor")
)


def _colours(tag: str, own: frozenset[str], around: frozenset[str]) -> dict[str, str]:
    edged = CALL if "ros-call" in around else STREAM
    if tag == "text":
        small = "ros-note" in own
        anchor = "start" if "ros-title" in around else "middle"
        return {
            "font-family": MONO,
            "font-size": "11" if small else number(CODE.size),
            "fill": MUTED if small else TEXT,
            "text-anchor": anchor,
            "dy": "0.35em",
        }
    if "ros-edge" in around:
        return {"fill": "none", "stroke": edged, "stroke-width": "1.5"} if tag == "path" else {"fill": edged}
    if "ros-frame" in own:
        return {"fill": "none", "stroke": SHAPES["ros-namespace"][1]}
    if "ros-title" in around:
        return {"fill": SHAPES["ros-namespace"][0]}
    kind = next((each for each in SHAPES if each in around), "")
    if tag == "g" or not kind:
        return {}
    fill, edge = SHAPES[kind]
    dashes = {"stroke-dasharray": "5 4"} if "ros-lost" in around else {}
    return {"fill": fill, "stroke": edge, "stroke-width": "1.5", **dashes}


def _text(root: Element, tag: str) -> str:
    return next((each.text or "" for each in root if _tag(each) == tag), "")


def _tag(element: Element) -> str:
    """Return the name of an element without its XML namespace."""
    return element.tag.rpartition("}")[2]
