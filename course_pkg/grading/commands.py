"""The command-line arguments of `course grade`, `course grade-one` and `course review`."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.grading.deadlines.arguments import add_deadline_arguments
from course_pkg.grading.roster.arguments import add_roster_arguments
from course_pkg.setup.commands import UNSAFE, Command

if TYPE_CHECKING:
    from argparse import ArgumentParser

STATUSES = """exit status:
  0    every submission was graded
  1    nothing was graded, or the run could not continue; the message says why
  2    an option is wrong
  3    some submissions need a look: a submission could not be graded, a part of it was not
       examined, a check could not finish, the submission time is not known, or the submission
       has no points
  130  you stopped the run; type the same command again to continue

The reports also keep the results of submissions that a run does not select. Each run prints the
points that have changed since the last run, and writes these points into changes.csv."""
NEEDS = frozenset({"course", "grade", "libraries", "solutions"})


def _grade(options: SimpleNamespace) -> int:
    from course_pkg.grading.command import Options, grade

    given = {name: value for name, value in vars(options).items() if name != "command"}
    given |= {name: tuple(given[name]) for name in ("students", "parts", "deadlines")}
    return grade(Options(**given))


def _chapters(text: str) -> tuple[str, ...]:
    """Return the chapters in a text such as "5,06"; in the result, each chapter has two digits."""
    return tuple(part.strip().zfill(2) for part in text.split(",") if part.strip())


def _names(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _grade_arguments(parser: ArgumentParser) -> None:
    from argparse import RawDescriptionHelpFormatter

    parser.add_argument(
        "source",
        metavar="submissions",
        type=Path,
        help=(
            "a folder with the files STUDENT/NN_topic.ipynb, or a zip file of such a folder, or a download "
            "from a learning platform"
        ),
    )
    parser.add_argument(
        "--chapters", type=_chapters, default=(), metavar="05,06", help="grade only these chapters"
    )
    parser.add_argument(
        "--student",
        dest="students",
        action="append",
        default=[],
        metavar="NAME",
        help="grade only this student again, even if nothing has changed; you can repeat this option",
    )
    parser.add_argument(
        "--part",
        dest="parts",
        type=_names,
        action="extend",
        default=[],
        metavar="05.2,05.3",
        help="grade only these parts again; the results of all other parts do not change",
    )
    parser.add_argument(
        "--out", type=Path, default=Path("grades"), help="the folder for the reports (default: grades)"
    )
    add_roster_arguments(parser)
    parser.add_argument(
        "--jobs",
        type=int,
        default=0,
        help=(
            "the number of notebooks that are graded at the same time (default: two for each processor core)"
        ),
    )
    parser.add_argument(
        "--scheduler",
        default="",
        metavar="tcp://…",
        help=("the address of a dask scheduler, to grade on several machines"),
    )
    parser.add_argument(
        "--validate",
        choices=("none", "missing", "all"),
        default="missing",
        help=(
            "run nbval for feedback on the notebooks of the students who lost points (missing, the "
            "default), of all students (all), or of no student (none)"
        ),
    )
    parser.add_argument(
        "--flags",
        type=_names,
        default=(),
        metavar="KINDS",
        help=(
            "the kinds of flags to look for, such as copies,files; none looks for no flags (default: all "
            "kinds). A flag asks you to look at an answer, and changes no points"
        ),
    )
    again = parser.add_mutually_exclusive_group()
    again.add_argument(
        "--resume", dest="fresh", action="store_false", help="continue a run that was stopped (the default)"
    )
    again.add_argument(
        "--fresh", action="store_true", help="grade all selected notebooks again, even if nothing has changed"
    )
    parser.set_defaults(fresh=False)  # The default value has the same effect as --resume.
    _add_common(parser)
    add_deadline_arguments(parser)
    parser.formatter_class = RawDescriptionHelpFormatter
    parser.epilog = STATUSES


def _grade_one(options: SimpleNamespace) -> int:
    from course_pkg.grading.command import grade_one

    return grade_one(
        options.notebook,
        options.out,
        sandboxed=options.sandboxed,
        private=options.private,
        points=options.points,
    )


def _grade_one_arguments(parser: ArgumentParser) -> None:
    parser.add_argument("notebook", type=Path, help="the student's notebook")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE", help="the JSON file for the grade")
    _add_common(parser)


def _add_common(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--private",
        type=Path,
        metavar="DIR",
        help="a folder with your own private checks and points; students never see this folder",
    )
    parser.add_argument(
        "--points",
        type=Path,
        metavar="FILE",
        help=(
            "a JSON file with the points of parts and of their goals; `course points FILE` writes such a file"
        ),
    )
    parser.add_argument(
        UNSAFE, dest="sandboxed", action="store_false", help="run students' code without a sandbox"
    )


def _review(options: SimpleNamespace) -> int:
    from course_pkg.grading.review.command import review, wanted_of

    wanted = wanted_of(options.parts, flagged=options.flagged, unfinished=options.unfinished)
    return review(options.grades, wanted, options.port, browser=options.browser)


def _review_arguments(parser: ArgumentParser) -> None:
    parser.add_argument("grades", type=Path, help="the folder that `course grade` wrote")
    parser.add_argument(
        "--part",
        dest="parts",
        type=_names,
        action="extend",
        default=[],
        metavar="03.3,03.4",
        help="show only the answers to these parts",
    )
    parser.add_argument("--flagged", action="store_true", help="show only the answers with flags")
    parser.add_argument(
        "--unfinished",
        action="store_true",
        help=(
            "show only the unfinished answers: answers whose check gave no result, and answers that have "
            "changed since their review"
        ),
    )
    parser.add_argument("--port", type=int, default=0, help="the port of the page (default: a free port)")
    parser.add_argument("--no-browser", dest="browser", action="store_false", help="open no browser")


def _points(options: SimpleNamespace) -> int:
    from course_pkg.grading.points import write_points

    write_points(options.file, options.chapters)
    return 0


def _points_arguments(parser: ArgumentParser) -> None:
    parser.add_argument("file", type=Path, metavar="FILE", help="the new file, such as points.json")
    parser.add_argument(
        "--chapters",
        type=_chapters,
        default=(),
        metavar="05,06",
        help=("write only the parts of these chapters"),
    )


def _autograde(options: SimpleNamespace) -> int:
    from course_pkg.grading.autograder.run import autograde, prepare

    return prepare() if options.prepare else autograde(options.root)


def _autograde_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "root",
        type=Path,
        nargs="?",
        default=Path("/autograder"),
        help=("the folder that Gradescope provides (default: /autograder)"),
    )
    parser.add_argument(
        "--prepare",
        action="store_true",
        help=("do not grade; only make the checks and the solutions unreadable for other users"),
    )


COMMANDS = {
    "grade": Command("grade what students handed in, and write the reports", _grade, NEEDS, _grade_arguments),
    "grade-one": Command(
        "grade one notebook and write one file, for a job array on a cluster",
        _grade_one,
        NEEDS,
        _grade_one_arguments,
    ),
    "points": Command(
        "write the points of each part and goal into a file, which you can change and give to `course grade "
        "--points`",
        _points,
        NEEDS,
        _points_arguments,
    ),
    "autograde": Command(
        "grade the submission in a container of Gradescope; the zip of `course autograder` calls it",
        _autograde,
        NEEDS,
        _autograde_arguments,
    ),
    "review": Command(
        "review answers by hand: on a page, change points and write comments",
        _review,
        frozenset({"course", "libraries", "solutions"}),
        _review_arguments,
    ),
}
