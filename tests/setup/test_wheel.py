"""Tests of the course's wheel."""

from __future__ import annotations

import subprocess
import sys
import venv
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel without access to a network."""
    folder = tmp_path_factory.mktemp("wheel")
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, names.split("\0")):
        copy = folder / "source" / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_file():
            copy.write_bytes((ROOT / name).read_bytes())
    program = "from setuptools.build_meta import build_wheel; build_wheel('..')"
    subprocess.run([sys.executable, "-c", program], cwd=folder / "source", check=True, capture_output=True)
    [built] = folder.glob("*.whl")
    return built


def test_the_wheel_contains_all_data_files(wheel: Path) -> None:
    """The wheel contains all data files and service definitions."""
    names = ZipFile(wheel).namelist()
    beside = [
        str(path.relative_to(ROOT))
        for path in (ROOT / "course_pkg").glob("**/*")
        if path.is_file() and "__pycache__" not in path.parts and path.name != "answers.py"
    ]
    assert not set(beside) - set(names)
    assert [name for name in names if name.endswith("share/course_pkg/srv/geometry.srv")]
    assert not [name for name in names if name.endswith((".pyc", "answers.py"))]


def test_the_installed_package_can_be_imported(wheel: Path, tmp_path: Path) -> None:
    """The installed wheel can be imported without the checkout."""
    venv.create(tmp_path / "v", system_site_packages=True, symlinks=True)
    [packages] = (tmp_path / "v" / "lib").glob("python3*/site-packages")
    ZipFile(wheel).extractall(packages)
    python = tmp_path / "v" / "bin" / "python"
    program = "import course_pkg.cli, course_pkg.setup.doctor as it; print(it.__file__)"
    answer = subprocess.run([python, "-E", "-c", program], cwd=tmp_path, capture_output=True, text=True)
    assert answer.stdout.startswith(str(packages)), answer.stderr
