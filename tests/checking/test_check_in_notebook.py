"""Tests of `check()` in a notebook's kernel with different mistakes of students."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.ros import PrivateMaster
from tests.notebook_kernel import NotebookKernel, Shown
from tests.support import eventually

SETUP = """
import rospy
from std_srvs.srv import SetBool, Trigger
from course_pkg import check, join
from course_pkg.srv import AddTwoInts, geometry
node = join("student")
"""
HANDLER = """
def handle_geometry(request):
    area = request.width * request.length
    return area, area * request.height
"""
SERVICE = "service = rospy.Service('/getGeometry', geometry, handle_geometry)"
SWITCH = """
class Switch:
    def __init__(self):
        self.on = False
        self.service = rospy.Service("/switch", SetBool, self.handle_switch)

    def handle_switch(self, request):
        moved, self.on = request.data != self.on, request.data
        return moved, "on" if self.on else "off"
"""


@pytest.fixture
def notebook(master: PrivateMaster, tmp_path: Path) -> Iterator[NotebookKernel]:
    """Return a kernel that runs a node and has its own record of results."""
    with NotebookKernel({"COURSE_STATE": str(tmp_path)}) as kernel:
        assert not kernel.run(SETUP, "setup").ename
        yield kernel


def report(notebook: NotebookKernel, part: str = "05.1") -> str:
    """Return the text of the report on a part."""
    shown = notebook.run(f"check({part!r})", f"check {part}")
    assert not shown.ename, shown
    return shown.results[0]


def test_class_that_serves_in_init(notebook: NotebookKernel) -> None:
    """A class that creates its service in __init__ passes; after the check, the student's object responds."""
    notebook.run(SWITCH, "class")
    notebook.run("switch = Switch()", "object")
    for _ in range(2):
        assert report(notebook, "05.4").startswith("05.4 passed")
    response = "response = rospy.ServiceProxy('/switch', SetBool)(True)\n(response.success, switch.on)"
    assert notebook.run(response).results == ["(True, True)"]


def test_syntax_error_in_the_new_version(notebook: NotebookKernel) -> None:
    """After a syntax error, the report says that the old handler still runs."""
    notebook.run(HANDLER, "handler")
    notebook.run(SERVICE, "service")
    assert report(notebook).startswith("05.1 passed")
    assert notebook.run(HANDLER.replace("return", "return return"), "handler").ename == "SyntaxError"
    assert " ".join(report(notebook).split()) == (
        "05.1 not examined handle_geometry is older than the last run of its cell, which ended with "
        "SyntaxError. Correct and run that cell, and then run this cell again."
    )
    notebook.run(HANDLER, "handler")
    notebook.run(SERVICE, "service")
    assert report(notebook).startswith("05.1 passed")


def test_service_with_the_former_handler(notebook: NotebookKernel) -> None:
    """If the service still uses the handler from an earlier run, the report says so."""
    notebook.run(HANDLER, "handler")
    notebook.run(SERVICE, "service")
    notebook.run(HANDLER.replace("area *", "2 * area *"), "handler")
    text = " ".join(report(notebook).split())
    assert text == (
        "05.1 not examined The service /getGeometry uses a version of handle_geometry that is older than "
        "the last run of its cell. Run the cell that creates the service, and then run this cell "
        "again."
    )
    notebook.run(SERVICE, "service")
    assert report(notebook).startswith("05.1 not yet")


def test_handler_that_did_not_change(notebook: NotebookKernel) -> None:
    """If the running handler did not change, the report does not mention an older version."""
    notebook.run(HANDLER, "handler")
    notebook.run(SERVICE, "service")
    notebook.run(HANDLER + "print('ready')", "handler")
    assert report(notebook).startswith("05.1 passed")


def test_function_that_its_cell_no_longer_defines(notebook: NotebookKernel) -> None:
    """If the student renames a function, the report says that the old name is from an earlier run."""
    notebook.run(HANDLER, "handler")
    notebook.run(HANDLER.replace("handle_geometry", "handle_box"), "handler")
    assert "because this run did not define handle_geometry." in " ".join(report(notebook).split())


ENDLESS = """
def measure():
    while True:
        try:
            rospy.sleep(0.01)
        except:
            pass

def count_missed(topic, pause):
    measure()
"""


def test_function_that_never_ends(notebook: NotebookKernel) -> None:
    """The time limit ends a function with a loop and a bare `except`."""
    notebook.run(ENDLESS, "count_missed")
    started = time.monotonic()
    text = report(notebook, "00.3")
    assert text.startswith("00.3 not yet")
    assert "TimesUp" in text
    assert time.monotonic() - started < 20


def test_stop_button_during_such_a_function(notebook: NotebookKernel, tmp_path: Path) -> None:
    """The Stop button ends the check, and the kernel continues to work."""
    begun = tmp_path / "begun"
    notebook.run(
        ENDLESS.replace("    measure(", f"    open({str(begun)!r}, 'w').close()\n    measure("),
        "count_missed",
    )
    number = notebook.begin("check('00.3')", "check")
    eventually(begun.exists, 20)
    notebook.manager.interrupt_kernel()
    shown = notebook.shown(number, timeout=10)
    assert shown.ename == "KeyboardInterrupt"
    assert notebook.run("node.name").results == ["'/student'"]


def test_errors_of_a_handler_are_in_the_report(notebook: NotebookKernel) -> None:
    """If a handler raises an error, the report contains this error."""
    notebook.run(HANDLER.replace("request.width *", "request.wide *"), "handler")
    notebook.run(SERVICE, "service")
    shown = notebook.run("result = check('05.1')\nresult.printed")
    assert shown.err == ""
    assert "has no attribute 'wide'" in shown.results[0]
    assert "area = request.wide * request.length" in shown.results[0]


def test_check_leaves_nothing(notebook: NotebookKernel) -> None:
    """After a check, the nodes, topics and services that the check created no longer exist."""
    notebook.run(SWITCH, "class")
    notebook.run("switch = Switch()", "object")
    shown = notebook.run("passed = check('05.4')", "check")
    assert shown == Shown()
