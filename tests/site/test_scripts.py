"""Tests of the JavaScript file that contains the front ends of all panels."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

from course_pkg.errors import SiteError
from course_pkg.site.bundling import ASSETS, AXE, BUILT, BUNDLE, build
from course_pkg.site.scripts import PANELS, fronts, panels_script, panels_sheet


def test_every_panel_with_a_view_has_a_front_end() -> None:
    """Each panel has a front end with the name of the panel's folder."""
    views = {path.parent.name for path in PANELS.glob("*/view.py")}
    assert set(fronts()) == views - {"image"}
    assert set(re.findall(r"(\w+): _\w+", panels_script().rpartition("coursePanels")[2])) == set(fronts())


def test_the_script_has_no_import_and_no_export() -> None:
    """The script has no import and no export, because a page in a local folder cannot load modules."""
    assert re.findall(r"^(?:import|export)\b.*", panels_script(), re.MULTILINE) == []


def test_the_script_contains_each_module_once(tmp_path: Path) -> None:
    """The script contains each module once, after the modules which this module imports."""
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


def test_the_shared_styles_come_first() -> None:
    """The shared styles are first, so that the styles of a panel can override them."""
    assert panels_sheet().startswith((PANELS / "look.css").read_text("utf-8"))


HERE = Path(__file__).parent


def test_the_stored_bundle_matches_its_sources(tmp_path: Path) -> None:
    """A new build of the script has the same bytes as the stored files."""
    if not shutil.which("npm"):
        pytest.skip("this machine has no npm, so the bundle was not built and compared")
    try:
        build(tmp_path)
    except SiteError as error:
        if "ERESOLVE" in str(error) or "EINTEGRITY" in str(error) or "npm run" in str(error):
            raise
        pytest.skip(f"npm could not install its packages, so the bundle was not compared: {error}")
    assert [name for name in BUILT if (tmp_path / name).read_bytes() != (ASSETS / name).read_bytes()] == []
    assert (tmp_path / AXE).read_bytes() == (HERE / AXE).read_bytes()


def test_every_library_is_pinned_and_named() -> None:
    """Each JavaScript library has a version, a hash and a licence."""
    package = json.loads((BUNDLE / "package.json").read_text("utf-8"))
    wanted = {**package["dependencies"], **package["devDependencies"]}
    locked = json.loads((BUNDLE / "package-lock.json").read_text("utf-8"))["packages"]
    assert {name: locked[f"node_modules/{name}"]["version"] for name in wanted} == wanted
    assert [name for name, about in locked.items() if name and not about.get("integrity")] == []
    assert [name for name, about in locked.items() if "resolved" in about] == []
    licences = (ASSETS / "LICENSES.txt").read_text("utf-8")
    assert [
        name for name, version in package["dependencies"].items() if f"{name} {version}" not in licences
    ] == []
