"""What the pages load is what its sources make."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from course_pkg.errors import SiteError
from course_pkg.site.bundling import ASSETS, AXE, BUILT, BUNDLE, build

HERE = Path(__file__).parent


def test_it_is_what_the_sources_make(tmp_path: Path) -> None:
    """Built anew from the registry, with the versions of the lock file, it is the same to the byte."""
    if not shutil.which("npm"):
        pytest.skip("npm is not on this machine, so what it builds was not compared")
    try:
        build(tmp_path)
    except SiteError as error:
        if "ERESOLVE" in str(error) or "EINTEGRITY" in str(error) or "npm run" in str(error):
            raise
        pytest.skip(f"npm could not get what it needs, so what it builds was not compared: {error}")
    assert [name for name in BUILT if (tmp_path / name).read_bytes() != (ASSETS / name).read_bytes()] == []
    assert (tmp_path / AXE).read_bytes() == (HERE / AXE).read_bytes()


def test_every_library_is_pinned_and_named() -> None:
    """In package.json by version, in the lock by hash and no address, beside the bundle by licence."""
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
