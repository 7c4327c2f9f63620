"""Where types are found: the texts on ROS_PACKAGE_PATH and the classes on Python's path."""

from __future__ import annotations

import difflib
import importlib
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

import rospkg

from course_pkg.errors import UnknownType

Half = Literal["srv", "msg"]


def split(name: str) -> tuple[str, str]:
    """Return package and short name of a full type name. Raises UnknownType for any other name."""
    package, slash, short = name.partition("/")
    if not (package and slash and short) or "/" in short:
        raise UnknownType(name, f"{name!r} is not the full name of a type; write it as package/Type")
    return package, short


def built_class(name: str, half: Half) -> Any:  # noqa: ANN401 - a generated class
    """Return the generated class of a type, None where none is built or can be imported."""
    package, short = split(name)
    if not short.isidentifier() or not package.isidentifier():
        return None
    # The type's own module and not the package's: it is found even where it was built after the
    # package's was imported, and genpy.message would remember that it once was not there.
    name = f"{package}.{half}._{short}"
    return getattr(sys.modules.get(name) or _import(name), short, None)


def _import(name: str) -> ModuleType | None:
    importlib.invalidate_caches()
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and f"{name}.".startswith(f"{error.name}."):
            return None
        raise


def definition_file(name: str, half: Half, finder: rospkg.RosPack | None = None) -> Path | None:
    """Return the .srv or .msg file of a type, None where ROS_PACKAGE_PATH holds none."""
    package, short = split(name)
    for _, folder in _each_folder(half, [package], finder):
        # A look through the folder, since some file systems do not tell upper from lower case.
        for file in folder.iterdir():
            if file.name == f"{short}.{half}":
                return file
    return None


def read_definition(file: Path) -> str:
    """Return the text of a definition; a byte that is no UTF-8 becomes a mark, as in old comments."""
    return file.read_text(encoding="utf-8", errors="replace")


def list_service_types(package: str | None = None) -> list[str]:
    """Return the names of all service types on ROS_PACKAGE_PATH, or of one package's, sorted."""
    return list_types("srv", package)


def list_message_types(package: str | None = None) -> list[str]:
    """Return the names of all message types on ROS_PACKAGE_PATH, or of one package's, sorted."""
    return list_types("msg", package)


def list_types(half: Half, package: str | None = None) -> list[str]:
    """Return the names of all types of one half, sorted; of a package that is not there, none."""
    packages = [package] if package is not None else rospkg.RosPack().list()
    return sorted(
        {
            f"{each}/{file.stem}"
            for each, folder in _each_folder(half, packages)
            for file in folder.glob(f"*.{half}")
        }
    )


def unknown(name: str, half: Half) -> UnknownType:
    """Return the error that says what may have been meant by a name that is not a type's."""
    package, short = split(name)
    what = "service" if half == "srv" else "message"
    known = list_types(half)
    of_package = [each.rpartition("/")[2] for each in known if each.startswith(f"{package}/")]
    if close := closest(name, known):
        advice = f"did you mean {' or '.join(close)}?"
    elif of_package:
        advice = f"{package} has {', '.join(of_package[:8])}{', …' if len(of_package) > 8 else ''}"
    elif package in rospkg.RosPack().list():
        advice = f"the package {package} has no {half}/{short}.{half}"
    else:
        advice = (
            f"no package {package} is on ROS_PACKAGE_PATH; is it spelt so, built, and its setup.bash sourced?"
        )
    same = [each for each in known if each.lower() == name.lower()]
    problem = "upper and lower case differ" if same else f"no {what} type has this name"
    return UnknownType(name, f"{name}: {problem}; {advice}")


def closest(name: str, known: Iterable[str], count: int = 2) -> list[str]:
    """Return the names most like `name`: the same but for case, of another package, or nearly the same."""
    names = list(known)
    short = name.rpartition("/")[2].lower()
    for likeness in (
        [each for each in names if each.lower() == name.lower()],
        [each for each in names if each.rpartition("/")[2].lower() == short],
    ):
        if likeness:
            return sorted(likeness)[:count]
    lower = {each.lower(): each for each in names}
    # A long name of a package makes all its types alike; what counts is the type's own.
    alike = [each for each in lower if _likeness(short, each.rpartition("/")[2]) >= 0.65]
    if "/" not in name:
        shorts = {each.rpartition("/")[2]: lower[each] for each in alike}
        return [shorts[each] for each in difflib.get_close_matches(short, shorts, n=count, cutoff=0.75)]
    return [lower[each] for each in difflib.get_close_matches(name.lower(), alike, n=count, cutoff=0.75)]


def _likeness(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, one, other).ratio()


def _each_folder(
    half: Half, packages: Iterable[str], finder: rospkg.RosPack | None = None
) -> Iterator[tuple[str, Path]]:
    # A finder remembers where packages are, and costs some ms: a new one for each question sees new packages.
    finder = finder or rospkg.RosPack()
    for package in packages:
        try:
            folder = Path(finder.get_path(package)) / half
        except rospkg.ResourceNotFound:
            continue
        if folder.is_dir():
            yield package, folder
