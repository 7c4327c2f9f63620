"""The step that builds the catkin workspace around links to the checkout."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

from course_pkg.provision import environment
from course_pkg.provision.journal import Journal
from course_pkg.provision.places import CATKIN_FOLDERS, Places
from course_pkg.provision.stamps import digest, replace_text

BUILT_FROM = ("CMakeLists.txt", "package.xml", "setup.py", *(f"{folder}/*" for folder in CATKIN_FOLDERS))
SYSTEM_PATH = "/usr/bin:/bin"


def workspace_key(places: Places) -> str:
    """Return a hash of all that the workspace is built from."""
    here = Path(__file__).parent
    code = [path.read_bytes() for path in (here / "workspace.py", here / "environment.py")]
    return digest([*_inputs(places), *code, str(places.python), sys.version])


def workspace_intact(places: Places) -> bool:
    """Say whether what the build leaves is still there."""
    return places.environment.exists() and (places.workspace / "devel" / "setup.bash").exists()


def build_workspace(places: Places, journal: Journal) -> None:
    """Build the workspace from nothing, so that no generated module outlives its definition."""
    source = places.workspace / "src"
    shutil.rmtree(places.workspace, ignore_errors=True)
    source.mkdir(parents=True)
    for name, folder in _linked_packages(places):
        (source / name).symlink_to(folder)
    build: list[str | Path] = [
        *(_tool(places, "catkin_make"), "-C", places.workspace),
        *(f"-DPYTHON_EXECUTABLE={places.python}", "-DCATKIN_ENABLE_TESTING=OFF"),
    ]
    journal.run(build, env=_build_environment(places))
    environment.write(places)
    _tell_the_interpreter(places)


def _linked_packages(places: Places) -> Iterator[tuple[str, Path]]:
    yield "course_pkg", places.checkout
    turtlesim = places.checkout / "course_pkg" / "turtlesim"
    real = [Path("/usr/share/turtlesim"), *([places.conda / "share" / "turtlesim"] if places.conda else [])]
    if (turtlesim / "package.xml").exists() and not any(path.exists() for path in real):
        yield "turtlesim", turtlesim


def _inputs(places: Places) -> Iterator[str | bytes]:
    for name, folder in _linked_packages(places):
        yield name
        for path in sorted(path for pattern in BUILT_FROM for path in folder.glob(pattern) if path.is_file()):
            yield str(path.relative_to(folder))
            yield path.read_bytes()
    nodes = places.checkout / "course_pkg" / "nodes"
    yield (nodes / "executable.in").read_bytes()
    yield from sorted(path.name for path in nodes.glob("[a-z]*.py"))


def _tool(places: Places, name: str) -> Path:
    return (places.conda or Path("/usr")) / "bin" / name


def _build_environment(places: Places) -> dict[str, str]:
    """Return an environment in which nothing of the user's can lead the build astray."""
    if places.conda:  # the compilers are found through variables that `conda activate` sets
        return {**os.environ, "PATH": f"{places.conda}/bin:{SYSTEM_PATH}"}
    return {"PATH": SYSTEM_PATH, "HOME": os.path.expanduser("~"), "LANG": "C.UTF-8"}


def _tell_the_interpreter(places: Places) -> None:
    """Let whoever only knows the interpreter (an editor, Binder) import the package and its types."""
    for packages in places.venv.glob("lib/python3*/site-packages"):
        paths = environment.python_path(places)
        replace_text(packages / "course_pkg.pth", "".join(f"{path}\n" for path in paths))
