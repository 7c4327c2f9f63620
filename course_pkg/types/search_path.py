"""Find types: the definitions on ROS_PACKAGE_PATH and the classes on Python's path."""

from __future__ import annotations

import difflib
import importlib
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Literal

import rospkg

from course_pkg.errors import UnknownType
from course_pkg.types.fields import MessageClass, ServiceClass

DefinitionKind = Literal["srv", "msg"]


def split_type_name(name: str) -> tuple[str, str]:
    """Return the package and the short name of a full type name.

    Raises UnknownType if `name` is not a full type name.
    """
    package, slash, short = name.partition("/")
    if not (package and slash and short) or "/" in short:
        raise UnknownType(name, f"{name!r} is not the full name of a type; write it as package/Type")
    return package, short


def built_message(name: str) -> MessageClass | None:
    """Return the generated class of a message type, or None if the class is missing or cannot be imported."""
    return getattr(_built_module(name, "msg"), name.rpartition("/")[2], None)


def built_service(name: str) -> ServiceClass | None:
    """Return the generated class of a service type, or None if the class is missing or cannot be imported."""
    return getattr(_built_module(name, "srv"), name.rpartition("/")[2], None)


def _built_module(name: str, kind: DefinitionKind) -> ModuleType | None:
    package, short = split_type_name(name)
    if not short.isidentifier() or not package.isidentifier():
        return None
    # This line imports the module of a type, not its package. genpy.message would import the package. It
    # would then not find a type that was built after this import.
    module = f"{package}.{kind}._{short}"
    return sys.modules.get(module) or _import(module)


def _import(name: str) -> ModuleType | None:
    importlib.invalidate_caches()
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and f"{name}.".startswith(f"{error.name}."):
            return None
        raise


def definition_file(name: str, kind: DefinitionKind, finder: rospkg.RosPack | None = None) -> Path | None:
    """Return the .srv or .msg file of a type, or None if no package on ROS_PACKAGE_PATH contains it."""
    package, short = split_type_name(name)
    for _, folder in _each_folder(kind, [package], finder):
        # Some file systems ignore the case of letters, so compare the name with each file name in the folder.
        for file in folder.iterdir():
            if file.name == f"{short}.{kind}":
                return file
    return None


def read_definition(file: Path) -> str:
    """Return the text of a definition; invalid UTF-8 (as in old comments) is replaced."""
    return file.read_text(encoding="utf-8", errors="replace")


def list_service_types(package: str | None = None) -> list[str]:
    """Return the sorted names of all service types on ROS_PACKAGE_PATH, or in one package."""
    return list_types("srv", package)


def list_message_types(package: str | None = None) -> list[str]:
    """Return the sorted names of all message types on ROS_PACKAGE_PATH, or in one package."""
    return list_types("msg", package)


def list_types(kind: DefinitionKind, package: str | None = None) -> list[str]:
    """Return the sorted names of all types of one kind; the list is empty for an unknown package."""
    packages = [package] if package is not None else rospkg.RosPack().list()
    return sorted(
        {
            f"{each}/{file.stem}"
            for each, folder in _each_folder(kind, packages)
            for file in folder.glob(f"*.{kind}")
        }
    )


def unknown_type(name: str, kind: DefinitionKind) -> UnknownType:
    """Return the error for an unknown type name; it suggests similar names."""
    package, short = split_type_name(name)
    what = "service" if kind == "srv" else "message"
    known = list_types(kind)
    of_package = [each.rpartition("/")[2] for each in known if each.startswith(f"{package}/")]
    if close := closest(name, known):
        advice = f"did you mean {' or '.join(close)}?"
    elif of_package:
        advice = f"{package} has {', '.join(of_package[:8])}{', …' if len(of_package) > 8 else ''}"
    elif package in rospkg.RosPack().list():
        advice = f"the package {package} contains no {kind}/{short}.{kind}"
    else:
        advice = (
            f"no package {package} is on ROS_PACKAGE_PATH; check its name, build the package, and source the "
            "setup.bash of its workspace"
        )
    same = [each for each in known if each.lower() == name.lower()]
    problem = "upper and lower case are different" if same else f"no {what} type has this name"
    return UnknownType(name, f"{name}: {problem}; {advice}")


def closest(name: str, known: Iterable[str], count: int = 2) -> list[str]:
    """Return the names most similar to `name`: the same short name, or a similar spelling."""
    names = list(known)
    short = name.rpartition("/")[2].lower()
    for similar in (
        [each for each in names if each.lower() == name.lower()],
        [each for each in names if each.rpartition("/")[2].lower() == short],
    ):
        if similar:
            return sorted(similar)[:count]
    lower = {each.lower(): each for each in names}
    # Only the short names are compared, because full names with the same long package name are always
    # similar.
    similar = [each for each in lower if _similarity(short, each.rpartition("/")[2]) >= 0.65]
    if "/" not in name:
        shorts = {each.rpartition("/")[2]: lower[each] for each in similar}
        return [shorts[each] for each in difflib.get_close_matches(short, shorts, n=count, cutoff=0.75)]
    return [lower[each] for each in difflib.get_close_matches(name.lower(), similar, n=count, cutoff=0.75)]


def _similarity(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, one, other).ratio()


def _each_folder(
    kind: DefinitionKind, packages: Iterable[str], finder: rospkg.RosPack | None = None
) -> Iterator[tuple[str, Path]]:
    # A RosPack object caches the paths of packages. Therefore, each search creates a new object, which takes
    # a few milliseconds.
    finder = finder or rospkg.RosPack()
    for package in packages:
        try:
            folder = Path(finder.get_path(package)) / kind
        except rospkg.ResourceNotFound:
            continue
        if folder.is_dir():
            yield package, folder
