"""The command-line arguments of `course release` and `course collect`."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser

# These commands do not work in the students' edition.
NO_COMMANDS = frozenset(
    (
        *("release", "collect", "site", "sync", "test"),
        *("grade", "grade-one", "points", "review", "autograder", "autograde"),
    )
)


def _release(options: SimpleNamespace) -> int:
    from course_pkg.handout.release import Options, release

    chosen = Options(options.out, options.path, options.chapters, options.hub, options.repository)
    return release(chosen, NO_COMMANDS)


def _chapters(text: str) -> tuple[str, ...]:
    return tuple(word.strip().zfill(2) for word in text.split(",") if word.strip())


def _release_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "out",
        metavar="DIR",
        type=Path,
        help=(
            "the folder for the release: a new folder, or the git repository of an earlier release. The zip "
            "file is DIR.zip"
        ),
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--path",
        default="",
        metavar="NAME",
        help=('only the notebooks of a path through the course, such as "The lab session"'),
    )
    which.add_argument(
        "--chapters", type=_chapters, default=(), metavar="05,06", help="only the notebooks of these chapters"
    )
    parser.add_argument(
        "--hub", default="", metavar="URL", help="the address of a JupyterHub, for a link with nbgitpuller"
    )
    parser.add_argument(
        "--repository",
        default="",
        metavar="URL",
        help="the address from which students get the repository, for the same link (default: the address of "
        "the remote `origin` of DIR)",
    )


def _collect(options: SimpleNamespace) -> int:
    from course_pkg.handout.collect import Options, collect

    return collect(Options(options.folder, options.out, options.homes, options.students, options.chapters))


def _collect_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "folder",
        metavar="FOLDER",
        help="the course's folder in each home folder, such as ros-course or work/ros-course",
    )
    parser.add_argument(
        "out",
        metavar="SUBMISSIONS",
        type=Path,
        help=("the folder for the copied work: a new folder, or a folder that this command wrote earlier"),
    )
    parser.add_argument(
        "--homes",
        type=Path,
        default=Path("/home"),
        metavar="DIR",
        help="the folder that contains the home folders (default: /home)",
    )
    parser.add_argument(
        "--students",
        type=Path,
        metavar="FILE",
        help=(
            "copy only the work of these students: a text file with one user name in each line, or a CSV "
            "file with a column `username` (default: all folders in DIR)"
        ),
    )
    parser.add_argument(
        "--chapters",
        type=_chapters,
        default=(),
        metavar="05,06",
        help=("copy only the work for these chapters"),
    )


def _autograder(options: SimpleNamespace) -> int:
    from course_pkg.handout.autograder.bundle import Options, write_autograder

    given = {name: value for name, value in vars(options).items() if name != "command"}
    return write_autograder(Options(**given))


def _autograder_arguments(parser: ArgumentParser) -> None:
    parser.add_argument("out", metavar="OUT.zip", type=Path, help="the name of the new zip file")
    parser.add_argument(
        "--chapters",
        type=_chapters,
        default=(),
        metavar="05,06",
        help=("the chapters of the assignment (default: all)"),
    )
    parser.add_argument(
        "--private", type=Path, metavar="DIR", help="a folder with your own private checks and points"
    )
    parser.add_argument(
        "--minutes",
        type=float,
        default=9.0,
        help=(
            "the time limit of a run, in minutes (default: 9). It must be shorter than Gradescope's own "
            "time limit"
        ),
    )
    parser.add_argument(
        "--late-per-day",
        type=float,
        metavar="PERCENT",
        help=(
            "the percentage of the points that is deducted for each late day. A day that has begun counts "
            "as a whole day"
        ),
    )
    parser.add_argument(
        "--late-max-days",
        type=float,
        metavar="N",
        help="the number of late days after which no points are left",
    )


COMMANDS = {
    "release": Command(
        "write the students' edition, without solutions: a folder, a git repository and a zip",
        _release,
        frozenset({"course", "libraries", "solutions"}),
        _release_arguments,
    ),
    "collect": Command(
        "copy students' work from their home folders; each folder is read with the rights of its student",
        _collect,
        frozenset({"course", "libraries"}),
        _collect_arguments,
    ),
    "autograder": Command(
        "write the zip of an autograder for Gradescope",
        _autograder,
        frozenset({"course", "libraries", "solutions"}),
        _autograder_arguments,
    ),
}
