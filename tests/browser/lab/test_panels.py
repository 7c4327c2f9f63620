"""Tests of the graph panel, predictions, choices, a figure and the themes in a real JupyterLab."""

from __future__ import annotations

from playwright.sync_api import Page, expect

from tests.browser.jupyter import Lab, run_all, running_notebook
from tests.browser.pages import FAINT, panel, picture

GRAPH = """
from course_pkg import GraphPanel, ServicePanel, join, predict, predictions
from course_pkg.srv import geometry
import rospy
from std_msgs.msg import String

node = join("graph_test")
chatter = rospy.Publisher("/chatter", String, queue_size=1)
heard = node.subscribe("/chatter", String)
"""
SERVE = 'served = rospy.Service("/getGeometry", geometry, lambda request: (request.length, 0))'
PREDICT = """
p = predict("05.reply_none", "What does the client see when the handler returns None?",
            ["an empty reply", "an error", "it waits for ever"])
p
"""

KINDS = '''
from course_pkg.types import compile_service

kinds = compile_service("demo/Kinds", """
uint8 ON=1
uint8 OFF=0
uint8 mode          # ON or OFF
int64 big
bool flag
string label
time stamp
duration wait
geometry_msgs/Point spot
float64[3] gains
int32[] ids
geometry_msgs/Point[] path
float64[36] covariance
---
string seen
""")
rospy.Service("/kinds", kinds.cls, lambda r: f"{r.mode} {r.big} {r.flag} {r.label} {r.stamp.nsecs} "
           f"{r.wait.secs} {r.spot.y} {r.gains[2]} {list(r.ids)} {[p.x for p in r.path]} {r.covariance[35]}")
'''
CHOICES = """
import matplotlib.pyplot as plt
from course_pkg import choose, join, predictions
node = join("choices_test")
"""
CHOOSE = """
choose("03.lab", "Which fits each case?", options=["a topic", "a service", "either"], cases=[
    ("Joint values, 100 times a second", "a topic", "A lost one is replaced at once."),
    ("One picture, on demand", "a service", "Somebody waits for it."),
])
"""
PLOT = "plt.plot([0, 1], [1.5, 2.5])\nplt.xlabel('time (s)')\nplt.show()"


def test_the_graph_panel_follows_the_graph(lab: Lab, lab_page: Page) -> None:
    """The panel shows a service that starts later, and a click shows the type of this service."""
    later = f"import threading\nthreading.Timer(2, lambda: exec({SERVE!r}, globals())).start()"
    with running_notebook(lab_page, lab, "graph", GRAPH, "GraphPanel(node=node)", later):
        graph = panel(lab_page, "Graph panel")
        expect(graph.get_by_role("button", name="topic /chatter")).to_be_visible()
        service = graph.get_by_role("button", name="service /getGeometry")
        expect(service).to_be_visible()
        service.focus()
        lab_page.keyboard.press("Enter")
        expect(graph.locator(".ros-details")).to_contain_text("course_pkg/geometry")
        picture(graph, "graph-panel")
        graph.get_by_label("loggers and /rosout").check()
        expect(graph.get_by_role("button", name="service /graph_test/get_loggers")).to_be_visible()
        expect(graph.get_by_role("button", name="service /getGeometry")).to_have_attribute(
            "aria-pressed", "true"
        )
        picture(graph, "graph-panel-with-loggers")


def test_a_prediction_is_kept_and_compared(lab: Lab, lab_page: Page) -> None:
    """When the cell runs again, the panel shows the student's prediction next to the result."""
    with running_notebook(
        lab_page, lab, "predict", GRAPH, PREDICT, 'p.compare("an error")', 'predictions("05")'
    ):
        expect(panel(lab_page, "Prediction compared")).to_contain_text("You made no prediction.")
        panel(lab_page, "Prediction").get_by_label("an empty reply").check()
        expect(panel(lab_page, "Prediction")).to_contain_text("a change is marked as a late change")
        run_all(lab_page)
        expect(panel(lab_page, "Prediction").get_by_label("an empty reply")).to_be_checked()
        expect(panel(lab_page, "Prediction compared")).to_contain_text("came after the result")
        expect(panel(lab_page, "Predictions").get_by_role("row")).to_have_count(2)
        picture(lab_page, "predictions")


def test_choices_are_made_compared_and_kept(lab: Lab, lab_page: Page) -> None:
    """After a choice for each case, the panel shows the reasons, and ignores later choices."""
    with running_notebook(lab_page, lab, "choose", CHOICES, CHOOSE, 'predictions("03")', PLOT):
        choices = panel(lab_page, "Choices")
        first = choices.get_by_role("radiogroup", name="Joint values")
        second = choices.get_by_role("radiogroup", name="One picture")
        choices.get_by_role("button", name="Show the reasons").click()
        expect(
            choices.get_by_text("First choose an option for each case: 2 of 2 cases have no answer.")
        ).to_be_visible()
        expect(first.get_by_label("a topic")).to_be_focused()
        lab_page.keyboard.press("Space")
        lab_page.keyboard.press("Tab")
        lab_page.keyboard.press("ArrowDown")
        expect(second.get_by_label("a service")).to_be_checked()
        lab_page.keyboard.press("ArrowDown")
        expect(choices.get_by_text("Each case has an answer.")).to_be_visible()
        lab_page.keyboard.press("Tab")
        expect(choices.get_by_role("button", name="Show the reasons")).to_be_focused()
        lab_page.keyboard.press("Enter")
        expect(choices.get_by_text("Does not fit. Better: a service.")).to_be_visible()
        expect(choices.get_by_text("1 of 2 fit.")).to_be_visible()
        picture(choices, "choices")
        run_all(lab_page)
        expect(panel(lab_page, "Choices").get_by_text("Does not fit. Better: a service.")).to_be_visible()
        expect(panel(lab_page, "Predictions").get_by_text("1 of 2 fit", exact=True)).to_be_visible()
        choices = panel(lab_page, "Choices")
        choices.get_by_role("button", name="Choose again").click()
        # Wait until the kernel has cleared the old choices, because check() does nothing if an option is
        # already selected.
        expect(choices.get_by_text("2 of 2 cases have no answer.")).to_be_visible()
        for name, option in {"Joint values": "a topic", "One picture": "a service"}.items():
            choices.get_by_role("radiogroup", name=name).get_by_label(option).check()
        choices.get_by_role("button", name="Show the reasons").click()
        said = "2 of 2 fit. 1 of 2 of your first choices fit, and only the first choices count."
        expect(choices.get_by_text(said)).to_be_visible()
        figure = lab_page.locator(".jp-RenderedSVG img")
        expect(figure).to_be_visible()
        assert "time%20(s)%3C%2Ftext%3E" in (figure.get_attribute("src") or "")
        picture(lab_page, "choices-lab_page")


def test_the_dark_theme_can_be_read(lab: Lab, lab_page: Page) -> None:
    """In the dark theme, each text of each panel has a contrast of at least 4.5 : 1."""
    cells = (GRAPH, SERVE, "GraphPanel()", 'ServicePanel("/getGeometry")', PREDICT)
    with running_notebook(lab_page, lab, "dark", *cells, theme="Dark"):
        form = panel(lab_page)
        form.get_by_label("length").fill("three")
        form.get_by_role("button", name="Call").click()
        expect(form.get_by_text("Not called")).to_be_visible()
        expect(lab_page.locator("body")).to_have_attribute("data-jp-theme-light", "false")
        for label in ("Graph panel", "Service panel", "Prediction"):
            assert panel(lab_page, label).evaluate(FAINT) == []
        picture(form, "service-panel-dark")
        picture(panel(lab_page, "Graph panel"), "graph-panel-dark")


def test_the_light_theme_can_be_read(lab: Lab, lab_page: Page) -> None:
    """In the light theme, each text of each panel has a contrast of at least 4.5 : 1."""
    with running_notebook(
        lab_page,
        lab,
        "light",
        GRAPH,
        SERVE,
        "GraphPanel()",
        'ServicePanel("/getGeometry")',
        "served.shutdown()",
    ):
        form = panel(lab_page)
        form.get_by_role("button", name="Call").click()
        expect(form.get_by_label("The error message of ROS")).to_contain_text("unavailable")
        for label in ("Graph panel", "Service panel"):
            assert panel(lab_page, label).evaluate(FAINT) == []
        picture(form, "service-panel-error")


def test_an_empty_graph_says_what_to_do(lab: Lab, lab_page: Page) -> None:
    """A service panel without services explains how to start a service."""
    with running_notebook(lab_page, lab, "empty", "from course_pkg import ServicePanel\nServicePanel()"):
        expect(panel(lab_page).get_by_text("No node provides a service yet.")).to_be_visible()
        picture(panel(lab_page), "service-panel-empty")


def test_every_kind_of_field_reaches_the_server(lab: Lab, lab_page: Page) -> None:
    """The server receives large numbers, times, nested messages and arrays as the student typed them."""
    with running_notebook(lab_page, lab, "kinds", GRAPH, KINDS, 'ServicePanel("/kinds", kind=kinds)'):
        lab_page.set_viewport_size({"width": 1280, "height": 2000})
        form = panel(lab_page)
        texts = {
            "mode": "1",
            "big": "9007199254740993",
            "label": "it's",
            "stamp": "1.5",
            "wait": "-2",
            "y": "2.5",
        }
        for name, text in texts.items():
            form.get_by_label(f"{name} ").first.fill(text)
        form.get_by_label("flag").check()
        form.get_by_role("group", name="gains").get_by_label("[2]").fill("3")
        for text in ("7", "8", "9"):
            form.get_by_role("button", name="Add element to ids").click()
            lab_page.keyboard.press("Control+a")
            lab_page.keyboard.type(text)
        form.get_by_role("button", name="Remove ids[1]").click()
        form.get_by_role("button", name="Add element to path").click()
        lab_page.keyboard.press("Control+a")
        lab_page.keyboard.type("4")
        covariance = form.get_by_label("covariance")
        covariance.fill(covariance.input_value().removesuffix("0.0]") + "5]")
        form.get_by_role("button", name="Call").click()
        seen = "1 9007199254740993 True it's 500000000 -2 2.5 3.0 [7, 9] [4.0] 5.0"
        expect(form.get_by_role("cell", name=seen)).to_be_visible()
        picture(form, "service-panel-kinds")
        form.get_by_label("mode").fill("256")
        form.get_by_label("mode").press("Enter")
        expect(form.get_by_text("Give a uint8 from 0 to 255.")).to_be_visible()
