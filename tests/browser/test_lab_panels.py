"""The graph panel, predictions, and all panels in the dark theme, in a real JupyterLab."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page, expect

from tests.browser.jupyter import Lab, panel, picture, run_all, running_lab, running_notebook

GRAPH = """
from course_pkg import GraphPanel, ServicePanel, join, predict, predictions
from course_pkg.srv import geometry
import rospy
from std_msgs.msg import String

node = join("graph_test")
chatter = rospy.Publisher("/chatter", String, queue_size=1)
heard = node.subscribe("/chatter", String)
"""
SERVE = 'served = node.serve("/getGeometry", geometry, lambda request: (request.length, 0))'
PREDICT = """
p = predict("05.reply_none", "What does the client see when the handler returns None?",
            ["an empty reply", "an error", "it waits for ever"])
p
"""

KINDS = '''
from course_pkg.interfaces import compile_service

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
node.serve("/kinds", kinds, lambda r: f"{r.mode} {r.big} {r.flag} {r.label} {r.stamp.nsecs} {r.wait.secs} "
           f"{r.spot.y} {r.gains[2]} {list(r.ids)} {[p.x for p in r.path]} {r.covariance[35]}")
'''

# A function of the page: what in an element has too little contrast.
FAINT = Path(__file__).with_name("contrast.js").read_text()


def test_the_graph_panel_follows_the_graph(lab: Lab, page: Page) -> None:
    """Nodes and topics are there at once, a service that starts later appears, and a click tells its type."""
    later = f"import threading\nthreading.Timer(2, lambda: exec({SERVE!r}, globals())).start()"
    with running_notebook(page, lab, "graph", GRAPH, "GraphPanel(node=node)", later):
        graph = panel(page, "Graph panel")
        expect(graph.get_by_role("button", name="topic /chatter")).to_be_visible()
        service = graph.get_by_role("button", name="service /getGeometry")
        expect(service).to_be_visible(timeout=10_000)
        service.focus()
        page.keyboard.press("Enter")
        expect(graph.locator(".ros-details")).to_contain_text("course_pkg/geometry")
        picture(graph, "graph-panel")
        graph.get_by_label("loggers and /rosout").check()
        expect(graph.get_by_role("button", name="service /graph_test/get_loggers")).to_be_visible()
        expect(graph.get_by_role("button", name="service /getGeometry")).to_have_attribute(
            "aria-pressed", "true"
        )
        picture(graph, "graph-panel-with-loggers")


def test_a_prediction_is_kept_and_compared(lab: Lab, page: Page) -> None:
    """What is chosen is there after a new run, and stands beside what really happened."""
    with running_notebook(page, lab, "predict", GRAPH, PREDICT, 'p.compare("an error")', 'predictions("05")'):
        expect(panel(page, "Prediction compared")).to_contain_text("You had made no prediction.")
        panel(page, "Prediction").get_by_label("an empty reply").check()
        expect(panel(page, "Prediction")).to_contain_text("a change now is marked as made afterwards")
        run_all(page)
        expect(panel(page, "Prediction").get_by_label("an empty reply")).to_be_checked()
        expect(panel(page, "Prediction compared")).to_contain_text("came after the result")
        expect(panel(page, "Predictions").get_by_role("row")).to_have_count(2)
        picture(page, "predictions")


def test_the_dark_theme_can_be_read(tmp_path: Path, page: Page) -> None:
    """Every text of every panel has a contrast of at least 4.5 : 1 in JupyterLab's dark theme."""
    with (
        running_lab(tmp_path, theme="Dark") as lab,
        running_notebook(
            page, lab, "dark", GRAPH, SERVE, "GraphPanel()", 'ServicePanel("/getGeometry")', PREDICT
        ),
    ):
        form = panel(page)
        form.get_by_label("length").fill("three")
        form.get_by_role("button", name="Call").click()
        expect(form.get_by_text("Not called")).to_be_visible()
        expect(page.locator("body")).to_have_attribute("data-jp-theme-light", "false")
        for label in ("Graph panel", "Service panel", "Prediction"):
            assert panel(page, label).evaluate(FAINT) == []
        picture(form, "service-panel-dark")
        picture(panel(page, "Graph panel"), "graph-panel-dark")


def test_the_light_theme_can_be_read(lab: Lab, page: Page) -> None:
    """The same in the light theme, with an error and its explanation in sight."""
    with running_notebook(
        page, lab, "light", GRAPH, SERVE, "GraphPanel()", 'ServicePanel("/getGeometry")', "served.stop()"
    ):
        form = panel(page)
        form.get_by_role("button", name="Call").click()
        expect(form.get_by_label("The error as ROS words it")).to_contain_text("unavailable")
        for label in ("Graph panel", "Service panel"):
            assert panel(page, label).evaluate(FAINT) == []
        picture(form, "service-panel-error")


def test_an_empty_graph_says_what_to_do(lab: Lab, page: Page) -> None:
    """A panel without a service is no blank: it says where services come from."""
    with running_notebook(page, lab, "empty", "from course_pkg import ServicePanel\nServicePanel()"):
        expect(panel(page).get_by_text("No node offers a service yet.")).to_be_visible()
        picture(panel(page), "service-panel-empty")


def test_every_kind_of_field_reaches_the_server(lab: Lab, page: Page) -> None:
    """Numbers to the last digit, times, nested messages and arrays arrive as they were typed."""
    with running_notebook(page, lab, "kinds", GRAPH, KINDS, 'ServicePanel("/kinds", kind=kinds)'):
        page.set_viewport_size({"width": 1280, "height": 2000})
        form = panel(page)
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
            page.keyboard.press("Control+a")
            page.keyboard.type(text)
        form.get_by_role("button", name="Remove ids[1]").click()
        form.get_by_role("button", name="Add element to path").click()
        page.keyboard.press("Control+a")
        page.keyboard.type("4")
        covariance = form.get_by_label("covariance")
        covariance.fill(covariance.input_value().removesuffix("0.0]") + "5]")
        form.get_by_role("button", name="Call").click()
        seen = "1 9007199254740993 True it's 500000000 -2 2.5 3.0 [7, 9] [4.0] 5.0"
        expect(form.get_by_role("cell", name=seen)).to_be_visible()
        picture(form, "service-panel-kinds")
        form.get_by_label("mode").fill("256")
        form.get_by_label("mode").press("Enter")
        expect(form.get_by_text("Give a uint8 from 0 to 255.")).to_be_visible()
