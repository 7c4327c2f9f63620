"""The front ends of the panels as one script."""

from __future__ import annotations

import re
from pathlib import Path

from course_pkg.site.scripts import PANELS, fronts, panels_script, panels_sheet


def test_every_panel_with_a_view_has_a_front_end() -> None:
    """The page finds each by the name of its folder; a picture is HTML and needs none."""
    views = {path.parent.name for path in PANELS.glob("*/view.py")}
    assert set(fronts()) == views - {"image"}
    assert set(re.findall(r"(\w+): _\w+", panels_script().rpartition("coursePanels")[2])) == set(fronts())


def test_no_module_is_left_over() -> None:
    """A page in a folder can load none, so nothing is imported or exported any more."""
    assert re.findall(r"^(?:import|export)\b.*", panels_script(), re.MULTILINE) == []


def test_each_module_stands_there_once(tmp_path: Path) -> None:
    """After what it imports, under whatever name."""
    (tmp_path / "kit.js").write_text("export function h() {}\n")
    (tmp_path / "one").mkdir()
    (tmp_path / "one" / "part.js").write_text('import { h } from "../kit.js";\nexport const part = h;\n')
    (tmp_path / "one" / "one.js").write_text(
        'import { h as make } from "../kit.js";\nimport { part } from "./part.js";\n'
        "function render() { make(part); }\nexport default { render };\n"
    )
    script = panels_script(tmp_path)
    assert script.count("function h()") == 1
    assert script.index("const _kit =") < script.index("const _one_part =") < script.index("const _one_one =")
    assert "const { h: make } = _kit;" in script
    assert "globalThis.coursePanels = { one: _one_one };" in script


def test_what_panels_share_comes_first() -> None:
    """A panel's own rules stand below those that they refine."""
    assert panels_sheet().startswith((PANELS / "look.css").read_text("utf-8"))
