"""The front end's files, joined."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import course_pkg.panels
from course_pkg.panels.assets import module, sheet

PANELS = Path(course_pkg.panels.__file__).parent
ENTRIES = sorted(path for path in PANELS.glob("*/*.js") if "export default" in path.read_text())


def test_imports_are_written_in_once(tmp_path: Path) -> None:
    """A module that two others import stands in the joined text once, before both."""
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
    """Every panel joins into a text with one default export, and with no name declared twice."""
    joined = module(entry)
    assert joined.count("export ") == 1
    assert "\nimport {" not in joined
    declared = re.findall(r"^(?:async )?(?:function|const|let|class) (\w+)", joined, re.MULTILINE)
    assert len(declared) == len(set(declared))


def test_there_are_panels_to_join() -> None:
    """The parametrised test above looks at every panel."""
    panels = {"choices", "graph", "plot", "prediction", "service", "timeline", "topic", "turtles"}
    assert panels <= {entry.stem for entry in ENTRIES}


def test_sheets_stand_in_the_order_given(tmp_path: Path) -> None:
    """What all panels share comes first, so that a panel may differ."""
    (tmp_path / "a.css").write_text("a {}")
    (tmp_path / "b.css").write_text("b {}")
    assert sheet(tmp_path / "a.css", tmp_path / "b.css") == "a {}\nb {}"
