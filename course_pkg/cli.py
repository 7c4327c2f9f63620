"""The commands of `course`: one thin function for each.

This module is read by whatever Python the machine has, before anything is installed: it imports
the standard library alone, and each command imports what it needs when it runs.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING, NamedTuple, NoReturn

from course_pkg.errors import CourseError

if TYPE_CHECKING:
    from argparse import ArgumentParser


UNSAFE = "--unsafe-no-sandbox"
INSIDE = "COURSE_INSIDE"  # set while the course's own interpreter runs this module


class Command(NamedTuple):
    """A subcommand: what it says of itself, what has to be set up for it, and what it does."""

    summary: str
    run: Callable[[SimpleNamespace], int]
    needs: frozenset[str] = frozenset({"course"})  # and "grade", "test"; "libraries" if it imports some
    arguments: Callable[[ArgumentParser], None] | None = None
    rest: str = ""  # the words after such a command are another program's, and are handed on as they are


def lab(options: SimpleNamespace) -> int:
    """Start a master and JupyterLab."""
    from course_pkg.lab.serve import serve_lab

    return serve_lab(options.notebook, port=options.port, ip=options.ip, browser=options.browser)


def lab_arguments(parser: ArgumentParser) -> None:
    """Declare what `course lab` takes."""
    parser.add_argument("notebook", nargs="?", help="the notebook to open (the first chapter)")
    parser.add_argument("--no-browser", dest="browser", action="store_false", help="open no browser")
    parser.add_argument("--port", type=int, help="the port to listen on (8888, or the next that is free)")
    parser.add_argument("--ip", default="127.0.0.1", help="the address to listen on (127.0.0.1)")


def run(options: SimpleNamespace) -> int:
    """Run a command in the environment."""
    from course_pkg.lab.run import run_command

    return run_command(options.rest)


def test(options: SimpleNamespace) -> int:
    """Run the whole suite."""
    from course_pkg.lab.suite import run_suite

    return run_suite(options.rest)


def doctor(_options: SimpleNamespace) -> int:
    """Say what is installed, missing and stale."""
    from course_pkg.provision.doctor import examine

    return examine()


def sync(options: SimpleNamespace) -> int:
    """Derive the notebooks from the solutions."""
    from course_pkg.authoring import execute
    from course_pkg.authoring import sync as derive

    if options.execute is not None:
        execute(options.execute)
    return int(derive(check=options.check))


def sync_arguments(parser: ArgumentParser) -> None:
    """Declare what `course sync` takes."""
    parser.add_argument("--check", action="store_true", help="change nothing; say what is out of step")
    parser.add_argument(
        "--execute", nargs="*", metavar="CHAPTER", help="first run the solutions of these chapters, or all"
    )


def grade(options: SimpleNamespace) -> int:
    """Grade what was handed in."""
    from pathlib import Path

    from course_pkg.grading.command import Options
    from course_pkg.grading.command import grade as run_all

    return run_all(
        Options(
            Path(options.submissions),
            Path(options.out),
            tuple(filter(None, options.chapters.split(","))),
            options.jobs,
            options.scheduler,
            options.fresh,
            options.walls,
            Path(options.private) if options.private else None,
            Path(options.late) if options.late else None,
            options.late_policy,
            options.validate,
        )
    )


def grade_arguments(parser: ArgumentParser) -> None:
    """Declare what `course grade` takes."""
    parser.add_argument(
        "submissions", help="a folder with STUDENT/NN_topic.ipynb, or a zip, or a platform's download"
    )
    parser.add_argument("--chapters", default="", metavar="05,06", help="only these chapters")
    parser.add_argument("--out", default="grades", help="the folder for the reports (grades)")
    parser.add_argument("--jobs", type=int, default=0, help="notebooks at once (two for each core)")
    parser.add_argument(
        "--scheduler", default="", metavar="tcp://…", help="a dask scheduler, for many machines"
    )
    parser.add_argument("--late", metavar="TABLE", help="a CSV file: student,days or student,chapter,days")
    parser.add_argument("--late-policy", default="", metavar="WORDS", help="such as '10%% a day, 3 days'")
    parser.add_argument(
        "--validate",
        choices=("none", "missing", "all"),
        default="missing",
        help="whose notebooks nbval runs for feedback: those with points missing (the default), all, none",
    )
    again = parser.add_mutually_exclusive_group()
    again.add_argument(
        "--resume", dest="fresh", action="store_false", help="go on where a run stopped (the default)"
    )
    again.add_argument("--fresh", action="store_true", help="forget what was graded before")
    parser.set_defaults(fresh=False)  # or that of --resume counts
    _how_arguments(parser)


def grade_one(options: SimpleNamespace) -> int:
    """Grade one notebook."""
    from pathlib import Path

    from course_pkg.grading.command import grade_one as run_one

    private = Path(options.private) if options.private else None
    return run_one(Path(options.notebook), Path(options.out), walls=options.walls, private=private)


def grade_one_arguments(parser: ArgumentParser) -> None:
    """Declare what `course grade-one` takes."""
    parser.add_argument("notebook", help="the notebook that was handed in")
    parser.add_argument("--out", required=True, metavar="FILE", help="the JSON file for its grade")
    _how_arguments(parser)


def _how_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--private", metavar="DIR", help="further checks and other points, which students never see"
    )
    parser.add_argument(
        UNSAFE, dest="walls", action="store_false", help="run what students wrote with nothing around it"
    )


def site(options: SimpleNamespace) -> int:
    """Write the course as a static site."""
    from course_pkg.site import run_site

    return run_site(
        options.out,
        student=options.student,
        chapters=tuple(options.chapters),
        execute=options.execute,
        check=options.check,
        pdf=options.pdf,
        binder=options.binder,
    )


def site_arguments(parser: ArgumentParser) -> None:
    """Declare what `course site` takes."""
    parser.add_argument("chapters", nargs="*", metavar="CHAPTER", help="run only these if need be (all)")
    parser.add_argument("--out", metavar="DIR", help="the folder to write to (one in the cache; it is named)")
    parser.add_argument("--student", action="store_true", help="of the notebooks without answers")
    parser.add_argument("--check", action="store_true", help="then look for dead links and what lacks words")
    parser.add_argument("--pdf", action="store_true", help="then print all of it as a book, by Chromium")
    parser.add_argument("--stored", dest="execute", action="store_false", help="run nothing anew")
    parser.add_argument("--binder", metavar="URL", help="the address under which Binder opens the repository")


def lock(_options: SimpleNamespace) -> int:
    """Pin every library."""
    from course_pkg.provision import Places
    from course_pkg.provision.lock import write_locks

    for path in write_locks(Places.of()):
        sys.stdout.write(f"{path}\n")
    return 0


COMMANDS = {
    "lab": Command("start a ROS master and JupyterLab on the first chapter", lab, arguments=lab_arguments),
    "run": Command(
        "run a command in the environment, with a master of its own", run, rest="COMMAND [ARGUMENT …]"
    ),
    "test": Command(
        "run the whole suite: lint, types, spelling, tests",
        test,
        frozenset({"course", "test"}),
        rest="[PYTEST ARGUMENT …]",
    ),
    "doctor": Command(
        "say what is installed, missing and stale, and what to do about it", doctor, frozenset()
    ),
    "sync": Command(
        "derive the students' notebooks from the solutions",
        sync,
        frozenset({"course", "libraries"}),
        sync_arguments,
    ),
    "grade": Command(
        "grade what students handed in, and write the reports",
        grade,
        frozenset({"course", "grade", "libraries"}),
        grade_arguments,
    ),
    "grade-one": Command(
        "grade one notebook into one file, for a cluster's array of jobs",
        grade_one,
        frozenset({"course", "grade", "libraries"}),
        grade_one_arguments,
    ),
    "site": Command(
        "write the course as pages that need no network and no kernel",
        site,
        frozenset({"course", "libraries"}),
        site_arguments,
    ),
    "lock": Command("pin every library that pyproject.toml needs", lock),
}


def main(argv: Sequence[str] | None = None) -> NoReturn:
    """Set up what the command needs, run it, and exit with its status."""
    words = list(sys.argv[1:] if argv is None else argv)
    try:
        sys.exit(_dispatch(words))
    except CourseError as error:
        sys.exit(f"course: {error}")
    except KeyboardInterrupt:
        sys.exit(130)


def parse(words: Sequence[str]) -> SimpleNamespace:
    """Return what `words` ask for; exit with a message where they make no sense."""
    name = words[0] if words else ""
    if name in COMMANDS and COMMANDS[name].rest and words[1:2] not in (["-h"], ["--help"]):
        rest = list(words[1:])
        if not rest and not COMMANDS[name].rest.startswith("["):
            _parser().parse_args([name, "--help"])
        return SimpleNamespace(command=name, rest=rest)
    return _parser().parse_args(words, SimpleNamespace())


def _parser() -> ArgumentParser:
    from argparse import ArgumentParser  # 10 ms that `run` need not spend

    parser = ArgumentParser(
        prog="course", description="A course on ROS 1 services.", epilog="`course COMMAND --help` says more."
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, command in COMMANDS.items():
        usage = f"course {name} {command.rest}" if command.rest else None
        sub = commands.add_parser(
            name, help=command.summary, description=f"{command.summary.capitalize()}.", usage=usage
        )
        if command.arguments:
            command.arguments(sub)
    return parser


def _dispatch(words: Sequence[str]) -> int:
    options = parse(words)
    command = COMMANDS[options.command]
    if command.needs:
        _enter_environment(command, words)
    return command.run(options)


def _enter_environment(command: Command, words: Sequence[str]) -> None:
    """Set up what is missing, and put on the environment; go on in its own interpreter if need be."""
    from course_pkg.provision import Places, ensure, environment

    places = Places.of()
    if os.environ.get(INSIDE) == str(places.python):
        return
    walls = "grade" in command.needs and UNSAFE not in words
    ensure(places, grade=walls, test="test" in command.needs)
    environment.apply(places)
    if "libraries" in command.needs:
        os.environ[INSIDE] = str(places.python)
        os.execv(places.python, [str(places.python), "-m", "course_pkg.cli", *words])  # noqa: S606


if __name__ == "__main__":
    main()
