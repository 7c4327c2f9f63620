"""The files of the students' edition: the files that the course needs to run, and the students' notebooks.

The edition does not contain solutions, tests, example answers, grading fixtures, private checks, or the
site's recordings. The edition contains the checks, because `check()` runs on the student's computer. The
source code of the checks is packed, because it contains answers.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from course_pkg.authoring.normalise import tidy
from course_pkg.authoring.notebook_store import NotebookStore, derived, read, text_of
from course_pkg.checking.packed import pack
from course_pkg.checking.parts import chapters as all_chapters
from course_pkg.errors import HandoutError
from course_pkg.handout.edition.git import git
from course_pkg.handout.edition.readme import student_readme, unlinked
from course_pkg.setup.edition import RECORD

README = "README.md"
FOLDERS = (".binder", ".devcontainer", "action", "course_pkg", "deploy", "figures", "launch", "msg", "srv")
FILES = (
    *(".dockerignore", ".gitignore", "CMakeLists.txt", "LICENSE", "course", "environment.yml", "package.xml"),
    *("pyproject.toml", "setup.py"),
)
# The files that match this pattern are not in the edition: example answers, grading fixtures, the site's
# recordings, and private checks.
LEFT_OUT = re.compile(
    r"course_pkg/chapters/(?:ch\d\d_\w+/(?:(?:answers|fixtures)(?:\.py$|/)|recordings\.json$)|private_)"
)
CHECKS = re.compile(r"course_pkg/chapters/ch\d\d_\w+/checks(?:/.*)?\.py")
WRITTEN_BY_TOOLS = re.compile(r"(?:^|/)(?:__pycache__|\.[^/]+|[^/]+\.egg-info)(?:/|$)|\.pyc$|~$")


@dataclass(frozen=True)
class File:
    """A file of the edition."""

    content: bytes
    executable: bool = False


def edition_files(root: Path, released: Sequence[str], hidden: Collection[str]) -> dict[str, File]:
    """Return the files of an edition with the chapters `released`, sorted by path.

    `root` is the checkout with the solutions. The edition's README does not list the commands in `hidden`.
    Raises AuthoringError if a solution cannot be used, and HandoutError if a file cannot be read.
    """
    found = {name: _file(root / name, packed=bool(CHECKS.fullmatch(name))) for name in _released_paths(root)}
    readme = (root / README).read_text("utf-8")
    found[README] = File(student_readme(readme, released, all_chapters(), hidden).encode())
    for path in NotebookStore(root).solutions(released):
        found[f"notebooks/{path.name}"] = File(_notebook(path, released).encode())
    found[RECORD] = File(_record(released, [*found, RECORD]).encode())
    return dict(sorted(found.items()))


def untracked_files(root: Path) -> list[str]:
    """Return the files of the package that git does not track; they are not in the edition."""
    listed = _git_listing(root, "--others", "--exclude-standard") or []
    return [name for name in listed if is_released(name)]


def _notebook(solution: Path, released: Collection[str]) -> str:
    notebook = read(solution)
    tidy(notebook)
    handed_out = derived(notebook)
    for cell in handed_out["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = unlinked(cell["source"], released)
    return text_of(handed_out)


def _record(released: Sequence[str], files: Sequence[str]) -> str:
    about = "The students' edition of the course, made by `course release`."
    return json.dumps({"about": about, "chapters": list(released), "files": sorted(files)}, indent=1) + "\n"


def tracked_files(root: Path, is_wanted: Callable[[str], bool]) -> Iterator[tuple[str, File]]:
    """Yield the path and the content of each file that git tracks and that `is_wanted` accepts.

    Raises HandoutError if `root` is not a git repository.
    """
    listed = _git_listing(root, "--cached")
    if listed is None:
        raise HandoutError(f"{root} is not a git repository. Clone the course with git.")
    for name in filter(is_wanted, sorted(listed)):
        if (root / name).is_file() and not (root / name).is_symlink():
            yield name, _file(root / name, packed=False)


def _released_paths(root: Path) -> Iterator[str]:
    listed = _git_listing(root, "--cached")
    if listed is None:  # `listed` is None if the checkout was downloaded without git's data.
        listed = [
            f"{folder}/{path.relative_to(root / folder)}"
            for folder in FOLDERS
            for path in (root / folder).rglob("*")
            if not WRITTEN_BY_TOOLS.search(str(path.relative_to(root / folder)))
        ]
        listed += FILES
    for name in listed:
        path = root / name
        if is_released(name) and path.is_file() and not path.is_symlink():
            yield name


def is_released(name: str) -> bool:
    """Return whether the edition contains a copy of the checkout's file `name`."""
    return (name in FILES or name.partition("/")[0] in FOLDERS) and not LEFT_OUT.match(name)


def _git_listing(root: Path, *options: str) -> list[str] | None:
    """Return the files that git lists, or None if `root` is not the top folder of a git repository."""
    if not (root / ".git").exists():
        return None
    return list(filter(None, git(root, "ls-files", "-z", *options).split("\0")))


def _file(path: Path, *, packed: bool) -> File:
    try:
        content = pack(path.read_text("utf-8")).encode() if packed else path.read_bytes()
        return File(content, bool(path.stat().st_mode & 0o100))
    except OSError as error:
        raise HandoutError(
            f"{path} cannot be read ({error.strerror}). Correct the permissions of this file, and "
            "type the command again."
        ) from error
