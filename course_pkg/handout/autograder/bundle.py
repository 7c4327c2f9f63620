"""`course autograder`: writes a zip file that an instructor uploads as a Gradescope autograder.

The zip contains setup.sh, run_autograder, settings.json, the folder `course` with the tracked files that
grading needs, and an optional folder `private`.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from course_pkg.errors import HandoutError
from course_pkg.grading.autograder.settings import Settings
from course_pkg.grading.deadlines.late import late_policy
from course_pkg.grading.extras import read_extras
from course_pkg.handout.edition.contents import File, tracked_files
from course_pkg.handout.edition.folder import refuse_inside
from course_pkg.handout.edition.zipped import write_zip
from course_pkg.handout.selection import chosen_chapters
from course_pkg.setup import PACKAGE_PARTS, Places

SCRIPTS = Path(__file__).parent
NEEDED = (*PACKAGE_PARTS, "solutions", "course", "pyproject.toml", "LICENSE")
LEFT_OUT = re.compile(r"course_pkg/chapters/ch\d\d_\w+/(?:answers(?:\.py$|/)|recordings\.json$)")
SHORTEST, LONGEST = 1.0, 60.0  # The time limit is in minutes.


@dataclass(frozen=True)
class Options:
    """The options of the command line."""

    out: Path
    chapters: tuple[str, ...] = ()
    private: Path | None = None
    minutes: float = 9.0
    late_per_day: float | None = None  # The deduction is in percent.
    late_max_days: float | None = None


def write_autograder(options: Options) -> int:
    """Write the zip, print how to use it, and return 0; raise HandoutError if an option is wrong."""
    out = options.out.expanduser().absolute()
    if out.suffix != ".zip":
        raise HandoutError(f"{options.out} does not end with .zip. Give a name such as autograder.zip.")
    if not SHORTEST <= options.minutes <= LONGEST:
        raise HandoutError(
            f"--minutes {options.minutes:g} is not allowed. Give a number from {SHORTEST:g} to {LONGEST:g}."
        )
    checkout = Places.of().checkout
    refuse_inside(out, checkout)
    chapters = tuple(chosen_chapters("", options.chapters))
    settings = Settings(chapters, options.minutes, options.late_per_day, options.late_max_days)
    if settings.policy:  # Reading this property raises GradingError if a number is out of range.
        late_policy(None, options.late_per_day, options.late_max_days, ["the deadline of Gradescope"])
    files = {"settings.json": File(settings.as_json().encode())}
    for name in ("setup.sh", "run_autograder"):
        files[name] = File((SCRIPTS / name).read_bytes(), executable=True)
    if options.private:
        read_extras(options.private)
        files |= dict(_private(options.private))
    files |= {f"course/{name}": file for name, file in tracked_files(checkout, _is_needed)}
    out.parent.mkdir(parents=True, exist_ok=True)
    write_zip(out, "", files)
    sys.stdout.writelines(f"{line}\n" for line in _how_to_use(out, len(files), settings))
    return 0


def _is_needed(name: str) -> bool:
    return name.partition("/")[0] in NEEDED and not LEFT_OUT.match(name)


def _private(folder: Path) -> Iterator[tuple[str, File]]:
    for path in sorted(folder.iterdir()):
        if path.is_file() and path.suffix in (".py", ".json"):
            yield f"private/{path.name}", File(path.read_bytes())


def _how_to_use(out: Path, count: int, settings: Settings) -> Iterator[str]:
    yield f"{out} has {count} files. The autograder grades the chapters {', '.join(settings.chapters)}."
    yield "In Gradescope, create a Programming Assignment, and upload the zip under Configure Autograder."
    yield f"In Gradescope, set a time limit of more than {settings.minutes + 1:g} minutes."
    yield "The zip contains the solutions, so do not give it to students."
