"""`course release`: writes the students' edition as a folder, a git repository and a zip."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote, urlencode, urlsplit

from course_pkg.checking.parts import chapters as all_chapters
from course_pkg.errors import HandoutError
from course_pkg.handout.edition.contents import edition_files, untracked_files
from course_pkg.handout.edition.folder import Release, ReleaseFolder, refuse_inside
from course_pkg.handout.edition.readme import named
from course_pkg.handout.edition.zipped import write_zip, zip_path
from course_pkg.handout.selection import chosen_chapters
from course_pkg.setup import Places


@dataclass(frozen=True)
class Options:
    """The options of the command line."""

    out: Path
    path: str = ""  # `path` is the name of a learning path.
    chapters: tuple[str, ...] = ()
    hub: str = ""  # `hub` is the address of a JupyterHub.
    repository: str = ""  # `repository` is the address of the repository for students.


def release(options: Options, hidden: Collection[str], root: Path | None = None) -> int:
    """Write the edition, print its location and how to hand it out, and return 0.

    `hidden` contains the commands that do not work in the edition. Raises HandoutError, and writes nothing,
    if an option is wrong. The same happens if the folder contains files that no release has written.
    """
    checkout = root or Places.of().checkout
    released = chosen_chapters(options.path, options.chapters)
    out = Path(options.out).expanduser().absolute()
    refuse_inside(out, checkout)
    folder, archive = ReleaseFolder(out), zip_path(out)
    files = edition_files(checkout, released, hidden)
    first = next(name for name in files if name.startswith("notebooks/"))
    repository = options.repository or folder.remote
    link = pull_link(options.hub, repository, folder.branch, first) if options.hub and repository else ""
    done = folder.write(files, f"Release {_described(released)}")
    write_zip(archive, out.name, files)
    for name in untracked_files(checkout):
        sys.stderr.write(f"This file was not released, because git does not track it: {name}\n")
    sys.stdout.write("".join(f"{line}\n" for line in _summary(folder, archive, len(files), released, done)))
    sys.stdout.write("".join(f"{line}\n" for line in _how_to_hand_out(folder, options, repository, link)))
    return 0


def _described(released: Sequence[str]) -> str:
    return "the whole course" if list(released) == all_chapters() else named(released)


def _summary(
    folder: ReleaseFolder, archive: Path, count: int, released: Sequence[str], done: Release
) -> Iterator[str]:
    yield f"The students' edition has {_described(released)}: {count} files, without solutions and tests."
    yield ""
    change = f"new commit {done.commit}, {_files(done.changed)} changed" if done.commit else "nothing changed"
    yield f"  folder and git repository  {folder.path} (branch {folder.branch}; {change})"
    yield f"  zip                        {archive}"
    yield ""


def _files(count: int) -> str:
    return "1 file" if count == 1 else f"{count} files"


def _how_to_hand_out(folder: ReleaseFolder, options: Options, repository: str, link: str) -> Iterator[str]:
    yield "Students unpack the zip or clone the repository. Then they type ./course lab in the new folder."
    yield ""
    if link:
        yield (
            "For students on a JupyterHub with nbgitpuller, push the repository, and give this link to "
            "the students:"
        )
        yield f"  git -C {shlex.quote(str(folder.path))} push {shlex.quote(repository)} {folder.branch}"
        yield f"  {link}"
        return
    missing = [] if options.hub else ["--hub https://YOUR.HUB"]
    missing += [] if repository else ["--repository https://YOUR.SERVER/COURSE.git"]
    yield (
        "For students on a JupyterHub with nbgitpuller, type the same command again with these options. The"
    )
    yield "command then prints a link for the students:"
    yield f"  {' '.join(missing)}"


def pull_link(hub: str, repository: str, branch: str, notebook: str) -> str:
    """Return a link for nbgitpuller: it copies the edition into a student's account on a JupyterHub.

    The link pulls the branch `branch` of the repository, and opens the notebook at the path `notebook` in the
    repository. `hub` is the address of the JupyterHub. The format is documented at
    https://nbgitpuller.readthedocs.io/en/latest/link.html. Raises HandoutError if an address does not begin
    with https:// or http://.
    """
    for option, address in (("--hub", hub), ("--repository", repository)):
        parts = urlsplit(address)
        if parts.scheme not in ("http", "https") or not parts.netloc:
            raise HandoutError(
                f"nbgitpuller cannot use the address {option} {address}. Write an address that "
                "begins with https://, such as https://hub.example.edu or "
                "https://git.example.edu/ros/course.git."
            )
    # nbgitpuller clones the repository into this folder.
    folder = repository.rstrip("/").rpartition("/")[2].removesuffix(".git")
    query = {"repo": repository, "urlpath": f"lab/tree/{folder}/{notebook}", "branch": branch}
    return f"{hub.rstrip('/')}/hub/user-redirect/git-pull?{urlencode(query, quote_via=quote, safe='')}"
