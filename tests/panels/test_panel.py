"""Tests of the functions that all panels use."""

from __future__ import annotations

import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

import course_pkg.panels
from course_pkg.errors import GraphError
from course_pkg.faults import caused
from course_pkg.panels import GraphPanel, ServicePanel, TypeBrowser, WireView
from course_pkg.panels.assets import module, sheet
from course_pkg.panels.panel import Panel
from course_pkg.panels.poller import Poller
from course_pkg.ros import PrivateMaster
from tests.support import eventually

PANELS = Path(course_pkg.panels.__file__).parent
ENTRIES = sorted(path for path in PANELS.glob("*/*.js") if "export default" in path.read_text())
MODELS = [
    "service.model",
    "graph.model",
    "breakit.model",
    "choices.model",
    "graph.drawing",
    "prediction.model",
    "timeline.model",
    "timeline.waits",
    "topic.model",
    "types.model",
]


@pytest.fixture
def nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Set ROS_MASTER_URI to the address of a master that does not exist."""
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")


@pytest.mark.parametrize("kind", [GraphPanel, ServicePanel, TypeBrowser], ids=lambda kind: kind.__name__)
def test_a_graph_that_cannot_be_read_is_explained(nowhere: None, kind: type[Panel]) -> None:
    """A panel that cannot read the graph shows the error message and an explanation."""
    panel = kind()
    assert "No ROS master" in panel.trouble
    assert panel.explained["cause"].startswith("No master answers")
    assert panel.explained["remedy"]
    assert panel.explained["taught"].startswith("chapter 12")
    panel.close()


def test_an_error_of_a_panel_itself_is_explained_if_it_is_known(nowhere: None) -> None:
    """A known error has an explanation, and an unknown error has no explanation."""
    panel = TypeBrowser()
    panel.complain(GraphError("ServiceException: service [/x] unavailable"))
    assert "No node provides" in panel.explained["cause"]
    panel.complain(KeyError("sprocket"))
    assert panel.explained == {}
    panel.publish(notice="", trouble="")
    assert panel.explained == {}
    panel.close()


def test_the_error_of_a_call_that_was_captured_is_explained(master: PrivateMaster) -> None:
    """After a failed call, the panel WireView shows the error message and an explanation."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_MASTER_URI", master.uri)
        with caused("returns_none"):
            view = WireView("/lab/door", data=True)
    assert "service handler returned None" in view.exchange["outcome"]
    assert "reached its end without a return" in view.explained["cause"]
    view.close()


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda path: path.stem)
def test_each_panel_is_framed(entry: Path) -> None:
    """The script of each panel exports framed(render), and declares no name twice."""
    joined = module(entry, PANELS / "explained.js")
    assert joined.count("export default { render: framed(render) };") == 1
    assert joined.count("export ") == 1
    declared = re.findall(r"^(?:async )?(?:function|const|let|class) (\w+)", joined, re.MULTILINE)
    assert len(declared) == len(set(declared))


class Polled:
    """A value, a poller that reads the value, and a list of everything that the poller reports."""

    def __init__(self) -> None:
        self.now: object = 1
        self.reads = 0
        self.seen: list[object] = []
        self.failed: list[str] = []
        self.poller = Poller(
            self.read, self.seen.append, lambda error: self.failed.append(str(error)), every=0.001
        )

    def read(self) -> object:
        """Return the value."""
        self.reads += 1
        if isinstance(self.now, Exception):
            raise self.now
        return self.now

    def read_again(self) -> bool:
        """Wait until the poller has read the value three more times; return True."""
        before = self.reads
        return eventually(lambda: self.reads > before + 2)


@pytest.fixture
def polled() -> Iterator[Polled]:
    """Yield a Polled object, and stop its poller after the test."""
    polled = Polled()
    yield polled
    polled.poller.stop()
    eventually(lambda: not pollers())


def pollers() -> list[threading.Thread]:
    """Return the threads of pollers."""
    return [thread for thread in threading.enumerate() if thread.name == "panel-poller"]


def test_a_value_is_reported_once(polled: Polled) -> None:
    """The poller does not report an unchanged value again."""
    polled.poller.start()
    eventually(lambda: polled.seen)
    assert polled.read_again()
    polled.now = 2
    eventually(lambda: len(polled.seen) == 2)
    assert polled.seen == [1, 2]


def test_an_error_is_reported_once_and_recovery_is_reported(polled: Polled) -> None:
    """The poller reports a repeated error only once, and reports the first value after the error."""
    polled.now = OSError("gone")
    polled.poller.start()
    eventually(lambda: polled.failed)
    assert polled.read_again()
    polled.now = 1
    eventually(lambda: polled.seen)
    assert polled.failed == ["gone"]


def test_an_error_in_the_callback_does_not_end_the_thread(polled: Polled) -> None:
    """After an error in the callback, the poller reports the next change."""
    values: list[object] = []

    def changed(value: object) -> None:
        values.append(value)
        raise ValueError("callback")

    polled.poller = Poller(polled.read, changed, lambda error: polled.failed.append(str(error)), every=0.001)
    polled.poller.start()
    eventually(lambda: polled.failed)
    polled.now = 2
    eventually(lambda: 2 in values)


def test_stop_ends_the_thread(polled: Polled) -> None:
    """stop() ends the poller's thread, and start() starts a new thread."""
    polled.poller.start()
    polled.poller.start()
    eventually(lambda: polled.seen)
    assert len(pollers()) == 1
    polled.poller.stop()
    eventually(lambda: not pollers())
    polled.poller.start()
    eventually(lambda: len(polled.seen) == 2)


def test_each_import_is_inserted_once(tmp_path: Path) -> None:
    """If two modules import a third module, the script contains the third module once."""
    (tmp_path / "kit.js").write_text("export const one = 1;\n")
    (tmp_path / "a.js").write_text(
        'import { one } from "./kit.js";\nexport function two() { return one + one; }\n'
    )
    (tmp_path / "b.js").write_text(
        'import { one } from "./kit.js";\n'
        'import { two } from "./a.js";\n'
        "export default { three: one + two() };\n"
    )
    joined = module(tmp_path / "b.js")
    assert joined.count("const one = 1;") == 1
    assert joined.index("const one") < joined.index("function two") < joined.index("export default")
    assert "import" not in joined


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda path: path.stem)
def test_each_panel_is_one_module_without_imports(entry: Path) -> None:
    """The script of each panel has one default export and no imports."""
    joined = module(entry)
    assert joined.count("export ") == 1
    assert "\nimport {" not in joined
    declared = re.findall(r"^(?:async )?(?:function|const|let|class) (\w+)", joined, re.MULTILINE)
    assert len(declared) == len(set(declared))


def test_there_are_panels_to_join() -> None:
    """The build of the panels' scripts finds each panel."""
    panels = {"choices", "graph", "prediction", "service", "timeline", "topic", "turtles"}
    assert panels <= {entry.stem for entry in ENTRIES}


def test_style_sheets_are_in_the_given_order(tmp_path: Path) -> None:
    """The common styles come before the styles of a panel."""
    (tmp_path / "a.css").write_text("a {}")
    (tmp_path / "b.css").write_text("b {}")
    assert sheet(tmp_path / "a.css", tmp_path / "b.css") == "a {}\nb {}"


@pytest.mark.parametrize("model", MODELS)
def test_a_model_needs_no_kernel_and_no_ros_node(model: str) -> None:
    """A panel's model does not import rospy, IPython or ipywidgets."""
    names = "{'rospy', 'IPython', 'ipywidgets'} & set(sys.modules)"
    code = f"import sys, course_pkg.panels.{model}; print(sorted({names}))"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout.strip() == "[]"


def test_no_name_of_the_course_imports_matplotlib() -> None:
    """Importing all names of the course does not import Matplotlib."""
    names = "[getattr(course_pkg, name) for name in course_pkg.__all__]"
    code = f"import sys, course_pkg; {names}; print('matplotlib' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.strip() == "False"
