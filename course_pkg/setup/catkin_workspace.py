"""The step that builds the catkin workspace, with links to the checkout."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

from course_pkg.files import write_atomically
from course_pkg.setup import environment
from course_pkg.setup.journal import Journal
from course_pkg.setup.libraries import base_python
from course_pkg.setup.places import CATKIN_FOLDERS, PACKAGE_PARTS, Places
from course_pkg.setup.stamps import digest

BUILT_FROM = ("CMakeLists.txt", "package.xml", "setup.py", *(f"{folder}/*" for folder in CATKIN_FOLDERS))
SYSTEM_PATH = "/usr/bin:/bin"


def workspace_key(places: Places) -> str:
    """Return a hash of all inputs of the workspace's build."""
    here = Path(__file__).parent
    code = [path.read_bytes() for path in (here / "catkin_workspace.py", here / "environment.py")]
    return digest([*_inputs(places), *code, str(places.python), sys.version])


def workspace_intact(places: Places) -> bool:
    """Return whether the files that the build made still exist."""
    return places.environment.exists() and (places.workspace / "devel" / "setup.bash").exists()


def build_workspace(places: Places, journal: Journal) -> None:
    """Build the workspace in an empty folder; raises SetupError if the build fails.

    The folder of an earlier build would still contain the generated modules of deleted definitions.
    """
    source = places.workspace / "src"
    shutil.rmtree(places.workspace, ignore_errors=True)
    source.mkdir(parents=True)
    for name, folder in _linked_packages(places):
        _link(source / name, folder)
    build: list[str | Path] = [
        *(_tool(places, "catkin_make"), "-C", places.workspace),
        *(f"-DPYTHON_EXECUTABLE={places.python}", f"-DNODE_PYTHON={base_python()}"),
        "-DCATKIN_ENABLE_TESTING=OFF",
    ]
    journal.run(build, env=_build_environment(places))
    environment.write(places)
    _write_path_file(places)
    _enable_extension(places)


def _linked_packages(places: Places) -> Iterator[tuple[str, Path]]:
    yield "course_pkg", places.checkout
    turtlesim = places.checkout / "course_pkg" / "turtlesim"
    real = [Path("/usr/share/turtlesim"), *([places.conda / "share" / "turtlesim"] if places.conda else [])]
    if (turtlesim / "package.xml").exists() and not any(path.exists() for path in real):
        yield "turtlesim", turtlesim


def _link(package: Path, folder: Path) -> None:
    """Create the catkin package `package` from links to the files in the folder `folder`.

    rosrun searches a package's whole folder for a program, and follows links. With a link to the whole
    checkout, rosrun would also find the programs in the student's own packages.
    """
    if (folder / "course_pkg").is_dir():
        package.mkdir()
        for name in PACKAGE_PARTS:
            if (folder / name).exists():
                (package / name).symlink_to(folder / name)
    else:
        package.symlink_to(folder)


def _inputs(places: Places) -> Iterator[str | bytes]:
    for name, folder in _linked_packages(places):
        yield name
        for path in sorted(path for pattern in BUILT_FROM for path in folder.glob(pattern) if path.is_file()):
            yield str(path.relative_to(folder))
            yield path.read_bytes()
    package = places.checkout / "course_pkg"
    for name in ("nodes/executable.in", "ros/process/loopback.c"):
        yield (package / name).read_bytes()
    for pattern in ("nodes/[a-z]*.py", "chapters/*/programs/[a-z]*.py"):
        yield from sorted(str(path.relative_to(package)) for path in package.glob(pattern))


def _tool(places: Places, name: str) -> Path:
    return (places.conda or Path("/usr")) / "bin" / name


def _build_environment(places: Places) -> dict[str, str]:
    """Return the environment without the user's settings that could break the build."""
    if places.conda:  # catkin finds the compilers through variables of `conda activate`.
        return {**os.environ, "PATH": f"{places.conda}/bin:{SYSTEM_PATH}"}
    return {"PATH": SYSTEM_PATH, "HOME": os.path.expanduser("~"), "LANG": "C.UTF-8"}


def _write_path_file(places: Places) -> None:
    """Write a .pth file; other programs, such as editors, then find the package and its types."""
    for packages in places.venv.glob("lib/python3*/site-packages"):
        paths = environment.python_path(places)
        write_atomically(packages / "course_pkg.pth", "".join(f"{path}\n" for path in paths))


def _enable_extension(places: Places) -> None:
    """Enable the course's extension for each Jupyter server that is started in the environment."""
    enabled = places.venv / "etc" / "jupyter" / "jupyter_server_config.d" / "course_pkg.json"
    enabled.parent.mkdir(parents=True, exist_ok=True)
    extensions = {"course_pkg.lab.extension": True}
    write_atomically(enabled, json.dumps({"ServerApp": {"jpserver_extensions": extensions}}) + "\n")
