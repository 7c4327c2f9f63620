"""Tests of the topic panel in a real JupyterLab."""

from __future__ import annotations

import re

from playwright.sync_api import Locator, Page, expect

from course_pkg.ros import MasterClient
from tests.browser.jupyter import Lab, running_notebook
from tests.browser.pages import FAINT, panel, picture
from tests.support import eventually

JOIN = """
from course_pkg import TopicPanel, join
import rospy
from std_msgs.msg import Float64, String

node = join("topic_test")
"""
PANEL = 'TopicPanel("/speed", "std_msgs/Float64")'


def listening(page: Page) -> Locator:
    """Wait until the panel has subscribed to its topic, and return the panel."""
    found = panel(page, "Topic panel")
    expect(found.locator(".ros-who")).to_contain_text("this panel")
    return found


def test_the_first_message_is_lost_and_the_second_arrives(lab: Lab, lab_page: Page) -> None:
    """A message that is published before a subscriber connects is lost, and the next message arrives."""
    with running_notebook(lab_page, lab, "first", JOIN, PANEL):
        topic = listening(lab_page)
        topic.get_by_label("data").fill("1.5")
        topic.get_by_role("button", name="Publish", exact=True).click()
        expect(
            topic.get_by_text("Message 1 reached no subscriber, because no subscriber was connected")
        ).to_be_visible()
        expect(topic.locator(".ros-deliveries")).to_contain_text("this panel")
        expect(topic.get_by_text("Nothing received yet.").first).to_be_visible()
        topic.get_by_label("data").fill("-2.5")
        lab_page.keyboard.press("Enter")
        expect(topic.get_by_text("Message 2 was sent to this panel.")).to_be_visible()
        expect(topic.get_by_label("The last messages")).to_contain_text("data -2.5")
        topic.get_by_text("The same as commands and in Python").click()
        line = topic.get_by_label("Command that publishes once")
        expect(line).to_have_text("rostopic pub --once /speed std_msgs/Float64 -- -2.5")
        picture(topic, "topic-panel-first")


def test_a_latched_message_arrives(lab: Lab, lab_page: Page) -> None:
    """A latched message reaches a later subscriber, and the panel shows that the message was latched."""
    with running_notebook(lab_page, lab, "latched", JOIN, PANEL):
        topic = listening(lab_page)
        topic.get_by_label("Latch").check()
        topic.get_by_role("button", name="Publish", exact=True).click()
        expect(
            topic.get_by_text(
                "Message 1 was stored until the first connection, and was then sent to this panel"
            )
        ).to_be_visible()
        expect(topic.get_by_label("The last messages")).to_contain_text("data 0.0")
        topic.get_by_role("button", name="Unregister the publisher").click()
        expect(topic.get_by_text("The publisher was unregistered.")).to_be_visible()


def test_a_rate_runs_until_it_is_stopped(lab: Lab, lab_page: Page) -> None:
    """The panel publishes at about 50 Hz until the student clicks Stop."""
    with running_notebook(lab_page, lab, "rate", JOIN, PANEL):
        topic = listening(lab_page)
        topic.get_by_label("Rate", exact=True).fill("50")
        topic.get_by_role("button", name="Publish at a rate").click()
        expect(topic.get_by_text(re.compile(r"Publishing at 50 Hz \(measured: [45]\d"))).to_be_visible()
        expect(topic.locator(".ros-figures")).to_contain_text(re.compile(r"at [45]\d\.\d Hz"))
        expect(topic.locator("polyline")).to_be_attached()
        picture(topic, "topic-panel-rate")
        topic.get_by_role("button", name="Stop").click()
        expect(topic.get_by_role("button", name="Publish at a rate")).to_be_visible()
        topic.get_by_role("button", name="1000 at once").click()
        expect(topic.locator(".ros-facts")).to_contain_text(re.compile(r"Published1,\d\d\d"))
        picture(topic, "topic-panel-burst")


def test_leaving_the_page_ends_the_node(lab: Lab, lab_page: Page) -> None:
    """When the page is closed, the panel's publisher ends, but the kernel continues."""
    with running_notebook(lab_page, lab, "left", JOIN, 'open("master.txt", "w").write(node.master)', PANEL):
        topic = listening(lab_page)
        topic.get_by_role("button", name="Publish at a rate").click()
        expect(topic.get_by_role("button", name="Stop")).to_be_visible()
        master = MasterClient((lab.folder / "master.txt").read_text())
        assert master.system_state().publishers["/speed"]
        lab_page.goto("about:blank")
        eventually(lambda: not any("topic_panel" in node for node in master.system_state().nodes))
        assert "/topic_test" in master.system_state().nodes


def test_a_busy_kernel_is_reported(lab: Lab, lab_page: Page) -> None:
    """If the student clicks while a cell runs, the panel says that the kernel is busy."""
    busy = lab.folder / "busy"
    wait = "import os, time\nwhile os.path.exists('busy'): time.sleep(0.05)"
    with running_notebook(lab_page, lab, "waiting", JOIN, PANEL, wait):
        topic = listening(lab_page)
        busy.touch()
        lab_page.locator(".jp-CodeCell").last.locator(".jp-InputPrompt").click()
        lab_page.keyboard.press("Control+Enter")
        expect(lab_page.locator(".jp-CodeCell").last.locator(".jp-InputPrompt")).to_have_text("[*]:")
        topic.get_by_role("button", name="Publish", exact=True).click()
        expect(topic.get_by_text("Waiting for the kernel: it is busy with another cell.")).to_be_visible()
        busy.unlink()
        expect(topic.get_by_text("Message 1 reached no subscriber")).to_be_visible()
        expect(topic.get_by_text("Waiting for the kernel")).to_be_hidden()


def test_errors_are_shown_at_their_fields(lab: Lab, lab_page: Page) -> None:
    """The panel publishes nothing while a field is wrong, and the wrong field gets the focus."""
    with running_notebook(lab_page, lab, "wrong", JOIN, PANEL):
        topic = listening(lab_page)
        topic.get_by_label("data").fill("fast")
        topic.get_by_label("Rate", exact=True).fill("500")
        topic.get_by_label("Queue size").fill("some")
        topic.get_by_role("button", name="Publish at a rate").click()
        expect(topic.get_by_text("Not published: 3 fields need a correction.")).to_be_visible()
        expect(topic.get_by_label("data")).to_be_focused()
        expect(topic.get_by_text("Give a rate from 0.1 to 100 Hz.")).to_be_visible()
        picture(topic, "topic-panel-wrong")
        assert topic.evaluate(FAINT) == []


def test_a_different_type_is_reported(lab: Lab, lab_page: Page) -> None:
    """The panel lists each publisher and each subscriber that has a different message type."""
    others = """
        talker = rospy.Publisher("/speed", String, queue_size=1, latch=True)
        talker.publish("fast")
        heard = node.subscribe("/speed", String)
    """
    with running_notebook(lab_page, lab, "types", JOIN, others.replace("        ", ""), PANEL):
        topic = listening(lab_page)
        warnings = topic.locator(".ros-warnings")
        expect(warnings).to_contain_text("/topic_test publishes std_msgs/String (MD5 992ce8a1…)")
        expect(warnings).to_contain_text("/topic_test subscribes to std_msgs/String")
        expect(topic.get_by_label("The last messages")).to_contain_text(
            "another type: std_msgs/String, 8 bytes"
        )
        assert topic.evaluate(FAINT) == []
        picture(topic, "topic-panel-types")


def test_a_panel_waits_for_its_topic(lab: Lab, lab_page: Page) -> None:
    """Without a type, the panel waits for a publisher and uses the publisher's type."""
    later = """
import threading
threading.Timer(4, lambda: globals().update(late=rospy.Publisher("/later", Float64, queue_size=1))).start()
"""
    with running_notebook(lab_page, lab, "later", JOIN, 'TopicPanel("/later")', later):
        topic = panel(lab_page, "Topic panel")
        expect(topic.get_by_text("No node publishes /later yet")).to_be_visible()
        expect(topic.get_by_label("data")).to_be_visible()
        expect(topic.locator(".ros-about")).to_contain_text("std_msgs/Float64")


def test_dark_and_narrow(lab: Lab, lab_page: Page) -> None:
    """The panel is readable in the dark theme and on a narrow page."""
    panels = 'TopicPanel("/joints", "sensor_msgs/JointState")'
    with running_notebook(lab_page, lab, "dark", JOIN, panels, theme="Dark"):
        lab_page.set_viewport_size({"width": 760, "height": 1600})
        topic = listening(lab_page)
        topic.get_by_role("button", name="Add element to position").click()
        lab_page.keyboard.press("Control+a")
        lab_page.keyboard.type("0.5")
        topic.get_by_label("Latch").check()
        topic.get_by_role("button", name="Publish", exact=True).click()
        expect(topic.get_by_label("The last messages")).to_contain_text("position [0.5]")
        expect(topic.get_by_label("Draw")).to_have_value("position[0]")
        topic.get_by_label("Rate", exact=True).fill("20")
        topic.get_by_role("button", name="Publish at a rate").click()
        expect(topic.locator("polyline")).to_be_attached()
        assert topic.evaluate(FAINT) == []
        assert topic.evaluate("element => element.scrollWidth <= element.clientWidth + 1")
        picture(topic, "topic-panel-dark-narrow")
