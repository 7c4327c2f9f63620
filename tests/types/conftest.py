"""Makes two packages for these tests: a built package, and a package that is not built."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from genpy.generate_initpy import write_modules
from genpy.generator import MsgGenerator, SrvGenerator

MANIFEST = "<package format='2'><name>{}</name><version>1.0.0</version></package>"

PART = "float32 size  # in metres\nstring label\n"
EVERYTHING = """\
# All at once.
Header header
bool on
byte[] signed
uint8[] data
char[2] pair
float32 ratio
int64 whole
# What it is called.
string name
string[] names
time[] times
duration waited
geometry_msgs/Point point
odd_pkg/Part[] parts
uint8 RED=1
string WORD= two words # and this
---
float64[3] sums
"""
SCALARS = "float32 a\nint8 b\nbool c\nstring d\nuint64 e\n---\nstring told\n"


def package(folder: Path, name: str, **files: str) -> Path:
    """Write a package; `Part_msg` is the text of msg/Part.msg."""
    root = folder / name
    root.mkdir(parents=True)
    (root / "package.xml").write_text(MANIFEST.format(name))
    for key, text in files.items():
        short, _, half = key.rpartition("_")
        (root / half).mkdir(exist_ok=True)
        (root / half / f"{short}.{half}").write_text(text)
    return root


def build(root: Path, into: Path) -> None:
    """Generate the package's modules with genpy, as generate_messages() does."""
    search = {each: [f"/usr/share/{each}/msg"] for each in ("std_msgs", "geometry_msgs")}
    search[root.name] = [str(root / "msg")]
    (into / root.name).mkdir(parents=True)
    (into / root.name / "__init__.py").touch()
    for generator, half in ((MsgGenerator(), "msg"), (SrvGenerator(), "srv")):
        target = into / root.name / half
        assert not generator.generate_messages(
            root.name, sorted(map(str, (root / half).iterdir())), str(target), search
        )
        write_modules(str(target))


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Create the built package `odd_pkg`, and the package `raw_pkg`, which is not built."""
    folder = tmp_path_factory.mktemp("packages")
    odd = package(folder, "odd_pkg", Part_msg=PART, Everything_srv=EVERYTHING, Scalars_srv=SCALARS)
    package(folder, "raw_pkg", Crate_msg="odd_pkg/Part[] parts\n", Pack_srv="Crate crate\n---\nbool packed\n")
    build(odd, folder / "python")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_PACKAGE_PATH", str(folder), prepend=":")
        patch.syspath_prepend(str(folder / "python"))
        patch.setenv("PYTHONPATH", str(folder / "python"), prepend=":")
        yield folder
    for name in [each for each in sys.modules if each.partition(".")[0] == "odd_pkg"]:
        del sys.modules[name]
