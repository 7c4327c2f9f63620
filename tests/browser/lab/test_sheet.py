"""A student works through chapter 07 in JupyterLab's terminal."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Page

from course_pkg.authoring.cells import exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, read
from tests.browser.jupyter import Lab, running_lab
from tests.browser.pages import READY, no_errors
from tests.support import eventually

pytestmark = [pytest.mark.slow, pytest.mark.timeout(900)]

# One block of commands may take up to this time in s.
BUILDING = 240.0
LAST = "## 13."  # From this section on, the student works without a lab sheet.
SERVER = "rosrun my_geometry server.py"
SERVED = "until rosservice list | grep -q getGeometry; do sleep 0.2; done"
# These functions run in the page. The functions open a terminal and return the text of the terminal.
OPEN = """async () => {
  const main = await window.jupyterapp.commands.execute("terminal:create-new");
  await main.content.ready;
  window.labSheet = [...(window.labSheet ?? []), main];
}"""
SHOW = "(number) => window.jupyterapp.shell.activateById(window.labSheet[number].id)"
TEXT = """(number) => {
  const buffer = window.labSheet[number].content._term.buffer.active;
  return Array.from({ length: buffer.length }, (_, row) => {
    const line = buffer.getLine(row);
    return (line.isWrapped ? "" : "\\n") + line.translateToString(true);
  }).join("");
}"""


class Terminal:
    """A terminal of JupyterLab that the test uses with the keyboard."""

    def __init__(self, page: Page, number: int) -> None:
        self._page, self._number, self._typed = page, number, 0
        page.evaluate(OPEN)
        self.run("cd ..")

    @property
    def text(self) -> str:
        """The whole text of the terminal, not only the visible lines."""
        text: str = self._page.evaluate(TEXT, self._number)
        return text

    def type(self, commands: str) -> None:
        """Type each command and press Enter."""
        self._page.evaluate(SHOW, self._number)
        for line in commands.splitlines():
            self._page.keyboard.type(line)
            self._page.keyboard.press("Enter")

    def run(self, commands: str) -> str:
        """Type the commands, wait until the last command has finished, and return the new output."""
        before = len(self.text.rstrip())
        self._typed += 1
        self.type(f"{commands}\necho done-{self._typed} $?")
        ended = re.compile(rf"^done-{self._typed} (\d+)", re.MULTILINE)
        eventually(lambda: ended.search(self.text), timeout=BUILDING)
        return self.text[before:]


@pytest.fixture
def lab(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Lab]:
    """Start JupyterLab; its root is an empty folder."""
    for name, value in {
        "ROS_PARALLEL_JOBS": "-j2",
        "GIT_AUTHOR_NAME": "You",
        "GIT_AUTHOR_EMAIL": "you@example.com",
        "GIT_COMMITTER_NAME": "You",
        "GIT_COMMITTER_EMAIL": "you@example.com",
        "GIT_PAGER": "cat",
    }.items():
        monkeypatch.setenv(name, value)
    with running_lab(tmp_path) as lab:
        yield lab


def steps() -> Iterator[tuple[str, str]]:
    """Yield the steps of the chapter in order, as ("type", commands) or ("write", exercise cell)."""
    for cell in read(NotebookStore().solutions(["07"])[0])["cells"]:
        source = cell["source"]
        if source.startswith(LAST):
            return
        if cell["cell_type"] == "markdown":
            for block in re.findall(r"^```bash\n(.*?)^```", source, re.DOTALL | re.MULTILINE):
                yield "type", block
        elif exercise_of(cell):
            yield "write", source
        elif source.startswith(("!chmod", "!mkdir -p src")) and "catkin_make" not in source:
            yield "type", source.replace("!", "")


def test_the_lab_sheet_leads_to_both_outputs(context: BrowserContext, lab: Lab) -> None:
    """A student types the commands of the lab sheet, and the terminal shows the area and the volume."""
    page = context.new_page()
    page.goto(f"{lab.url}/lab?reset")
    page.wait_for_function("window.jupyterapp", timeout=READY)
    page.evaluate("window.jupyterapp.restored")
    workspace = lab.folder.parent / "workspace"
    with no_errors(page):
        terminal = Terminal(page, 0)
        seen = ""
        for kind, text in steps():
            if kind == "write":
                first, _, body = text.partition("\n")
                file = workspace / first.split()[1]
                assert file.parent.is_dir(), terminal.text
                file.write_text(body)
            elif text.strip() == SERVER:
                terminal.type(text)
                terminal = Terminal(page, 1)
                terminal.run(f". {workspace}/devel/setup.bash")
                terminal.run(SERVED)
            else:
                seen += terminal.run(text)
    page.close()
    assert "package 'my_geometry' not found" in seen or "Unknown srv type" in seen
    assert "float32 volume" in seen
    assert re.search(r"^area: 6\.24\d*\s*\nvolume: 55\.5[34]", seen, re.MULTILINE)
    assert re.search(r"^area: 6\.24\s*\nvolume: 55\.54\s*$", seen, re.MULTILINE)
    assert re.search(r"^scripts/server\.py\s*$", seen, re.MULTILINE)
    assert (workspace / "src" / "my_geometry" / ".git").is_dir()
