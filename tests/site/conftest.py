"""Fixtures that build each site once for the tests in this folder."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest

from course_pkg.site.build import Settings, write_site
from tests.authoring.books import code, text
from tests.site.notebook_stores import runs, store

PANELS = [
    "from course_pkg import *; import time; node = join('chapter_00'); "
    "server = node.run('course_pkg', 'server'); server.wait_for_service('/getGeometry', timeout=20); "
    "simulator = node.run('turtlesim', 'turtlesim_node'); simulator.wait_for_service('/spawn', timeout=20)",
    "turtles = TurtlePanel(); turtles",
    "graph = GraphPanel(); graph",
    "form = ServicePanel('/getGeometry'); form",
    "form.record([{'length': 1.0, 'width': 2.0, 'height': 3.0}, {'length': 4.0}])",
    "ServicePanel('/getGeometry')",
    "from course_pkg.srv import geometry\n"
    "with node.record() as recording: node.call('/getGeometry', geometry, 1, 2, 3)",
    "Timeline(recording)",
    "TopicPanel('/turtle1/pose')",
    "TypeBrowser('std_srvs/SetBool')",
    "WireView('/getGeometry', length=1.0, width=2.0, height=3.0)",
    "BreakIt()",
    "import matplotlib.pyplot as plt\nplt.plot([0, 1], [1, 3])\nplt.xlabel('time (s)')\n"
    "plt.ylabel('delay (ms)')\nplt.title('A line')\nplt.show()",
    "question = predict('00.panels', 'What will it be?', ['this', 'that']); question",
    "question.compare('that')",
    "predictions('00')",
    "1 / 0",
    "turtles._keep()",
    "graph.shown(); graph.received('choose', {'noise': True, 'show_own': True}); graph.hidden()",
]


@pytest.fixture(scope="session")
def course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the site of the whole course from the outputs that the notebooks contain, without panels."""
    folder = tmp_path_factory.mktemp("course")
    write_site(Settings(folder / "site", execute=False, book=True), runs=runs(folder / "cache"))
    return folder / "site"


@pytest.fixture(scope="session")
def panels(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run a chapter that contains every kind of panel, and build a site with this chapter."""
    folder = tmp_path_factory.mktemp("panels")
    cells = [code(source, id=f"c{number}") for number, source in enumerate(PANELS)]
    cells[PANELS.index("1 / 0")]["metadata"]["tags"] = ["raises-exception"]
    cells.insert(0, text("## Every kind of panel"))
    troubles = write_site(
        Settings(folder / "site", book=True), store(folder, _00_panels=cells), runs(folder / "cache")
    )
    assert troubles == []
    return folder / "site"


@pytest.fixture(scope="session")
def served(course: Path, panels: Path) -> Iterator[dict[Path, str]]:
    """Serve the site of the course and the site of the panels on 127.0.0.1, and return their addresses."""
    servers = {}
    for site in (course, panels):
        handler = partial(_Quiet, directory=str(site))
        servers[site] = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        Thread(target=servers[site].serve_forever, daemon=True).start()
    yield {site: f"http://127.0.0.1:{server.server_port}" for site, server in servers.items()}
    for server in servers.values():
        server.shutdown()
        server.server_close()


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_: object) -> None:
        """Write no log."""
