"""Make the student's own packages, in the folder `workspace` next to `notebooks`, available to a kernel."""

from __future__ import annotations

import importlib
import os
import re
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from course_pkg.errors import SetupError
from course_pkg.setup import Places

if TYPE_CHECKING:
    from IPython.core.interactiveshell import InteractiveShell

NAME = "workspace"
REMEDY = (
    "Move the course to a folder in which you can write. The path of this folder must not contain a space."
)
INSTALLED_REMEDY = (
    "Set COURSE_HOME to a folder in which you can write. The path of this folder must not contain a space."
)
MANIFEST = "package.xml"
# If the course's devel folder has no folder for generated modules, these folders are used.
MODULES = ("lib/python3/dist-packages",)
# The pattern matches the MD5 sum in a module that genpy has generated.
MD5 = re.compile(r"""^  _md5sum *= *["']([0-9a-f]{32})["']""", re.MULTILINE)
KINDS = (".srv", ".msg")  # Python packages with these endings contain only generated modules.


def own_workspace() -> Path:
    """Return the student's catkin workspace: the path in COURSE_WORKSPACE, or `workspace` beside `notebooks`.

    When notebooks are validated or graded, COURSE_WORKSPACE or COURSE_STATE is set. Therefore, each run finds
    only its own packages. If only COURSE_STATE is set, the workspace is the folder `workspace` in
    COURSE_STATE.
    """
    if given := os.environ.get("COURSE_WORKSPACE"):
        return Path(given).expanduser().resolve()
    return Path(os.environ.get("COURSE_STATE") or Places.of().own).resolve() / NAME


def make_own_workspace() -> Path:
    """Return the student's workspace; create its folder `src` if it is missing.

    Raises SetupError, and changes no file, if the tools of ROS do not work in the workspace.
    """
    root = own_workspace()
    problem = _unfit(root)
    if not problem:
        try:
            (root / "src").mkdir(parents=True, exist_ok=True)
        except OSError as error:
            problem = f"the folder cannot be created ({error.strerror})"
    if problem:
        remedy = INSTALLED_REMEDY if Places.of().installed else REMEDY
        raise SetupError(f"{root} cannot be your catkin workspace: {problem}. {remedy}")
    return root


def _unfit(root: Path) -> str:
    """Return the reason why the tools of ROS do not work in a folder, or ""."""
    if any(letter.isspace() for letter in str(root)):
        return "the path contains a space, and catkin cannot build in such a folder"
    if root.exists() and not (root / "src").is_dir() and any(root.iterdir()):
        return "the folder contains files, but no folder src"
    return ""


class OwnPackages:
    """The packages of one workspace that this process can use."""

    def __init__(self, root: Path) -> None:
        self._source = root / "src"
        self._devel = root / "devel"
        self._paths = {
            "CMAKE_PREFIX_PATH": [self._devel],
            "LD_LIBRARY_PATH": [self._devel / "lib"],
            "PYTHONPATH": [self._devel / folder for folder in _module_folders()],
        }
        # The dict maps the path of each generated file to the time of its last change in ns.
        self._seen: dict[str, int] = {}
        # These are the messages of the last refresh() about package.xml files.
        self._unreadable: set[str] = set()

    def follow_cells(self, shell: InteractiveShell | None) -> None:
        """Call refresh() now and, in a notebook, before each cell; print the message of refresh(), if any."""
        self._refresh_and_print()
        if shell is not None:
            shell.events.register("pre_run_cell", lambda _info: self._refresh_and_print())

    def refresh(self) -> str:
        """Make all built packages available to this process and to its child processes.

        The packages' folders are added at the end of each search path. Therefore, a student's package cannot
        replace a package of the course. The method returns a message if the definition of an imported type
        has changed, or if a package.xml cannot be read. Otherwise, it returns "".
        """
        for name, folders in self._paths.items():
            _append(name, folders)
        found, unreadable = _find_packages(self._source)
        others = [
            each for each in _folders("ROS_PACKAGE_PATH") if not Path(each).is_relative_to(self._source)
        ]
        os.environ["ROS_PACKAGE_PATH"] = os.pathsep.join([*others, *map(str, found)])
        messages = [text for text in unreadable if text not in self._unreadable]
        self._unreadable = set(unreadable)
        sys.path += [str(path) for path in self._paths["PYTHONPATH"] if str(path) not in sys.path]
        importlib.invalidate_caches()
        changed = [name for module in self._rewritten() for name in _follow(module)]
        return "\n".join([*messages, *([_restart_needed(sorted(changed))] if changed else [])])

    def _refresh_and_print(self) -> None:
        if message := self.refresh():
            sys.stderr.write(f"{message}\n")

    def _rewritten(self) -> Iterator[ModuleType]:
        """Yield the imported modules of this workspace with files newer than the last refresh()."""
        inside = f"{self._devel}{os.sep}"
        for module in list(sys.modules.values()):
            file = getattr(module, "__file__", None) or ""
            if file.startswith(inside):
                with suppress(OSError):  # The file was deleted, for example with `rm -r devel`.
                    written = os.stat(file).st_mtime_ns
                    if self._seen.get(file) != written:
                        self._seen[file] = written
                        yield module


def _module_folders() -> list[str]:
    """Return the folders, relative to devel, in which catkin puts generated modules."""
    devel = Places.of().workspace / "devel"
    found = devel.glob("lib/python3*/*-packages")
    return [str(path.relative_to(devel)) for path in found] or list(MODULES)


def _find_packages(source: Path) -> tuple[list[Path], list[str]]:
    """Return the folders of the packages in `source`, and a message for each unreadable package.xml.

    The tools of ROS read every package.xml on ROS_PACKAGE_PATH, and end with an error if one file is invalid.
    """
    found, messages, visited = [], [], set()
    for folder, inside, files in os.walk(source, followlinks=True):
        inside[:] = sorted(name for name in inside if not name.startswith("."))
        if "CATKIN_IGNORE" in files or (real := os.path.realpath(folder)) in visited:
            inside.clear()
            continue
        visited.add(real)
        if MANIFEST in files:
            inside.clear()
            try:
                manifest = ElementTree.parse(Path(folder, MANIFEST))  # noqa: S314 -- the student's own file
                if not (manifest.findtext("name") or "").strip():
                    raise ElementTree.ParseError("the tag name is missing")
                found.append(Path(folder))
            except (OSError, ValueError, ElementTree.ParseError) as error:
                place = Path(folder, MANIFEST).relative_to(source.parent)
                messages.append(
                    f"{place} cannot be read ({error}). This notebook cannot use the package "
                    "until you have repaired this file."
                )
    return found, messages


def _folders(name: str) -> list[str]:
    return [each for each in os.environ.get(name, "").split(os.pathsep) if each]


def _append(name: str, folders: list[Path]) -> None:
    path = _folders(name)
    os.environ[name] = os.pathsep.join([*path, *(str(each) for each in folders if str(each) not in path)])


def _follow(module: ModuleType) -> list[str]:
    """Import a package's new types; return the name of a type that has changed in `module`."""
    if module.__name__.endswith(KINDS):
        # This import can fail while a build is running or after a failed build. The student sees the error at
        # the next import of the types.
        with suppress(Exception):
            importlib.reload(module)
        return []
    classes = [each for each in vars(module).values() if getattr(each, "__module__", "") == module.__name__]
    imported = {each._md5sum for each in classes if hasattr(each, "_md5sum")}
    try:
        built = set(MD5.findall(Path(module.__file__ or "").read_text("utf-8")))
    except OSError:
        return []
    package, _, rest = module.__name__.partition(".")
    return [f"{package}/{rest.rpartition('._')[2]}"] if imported and built and imported != built else []


def _restart_needed(types: list[str]) -> str:
    names, it = ", ".join(types), "it" if len(types) == 1 else "them"
    return (
        f"The definition of {names} has changed since this kernel imported {it}. Restart the "
        "kernel to use the new build (menu Kernel, Restart Kernel)."
    )
