"""Checks answers by authors who knew only the goals of the parts.

Arguments: `FOLDER [FILE …] [--alone]`. FILE is the name of a file in FOLDER, without the ending `.py`. A file
contains answers in percent format. A line `# --- next cell` separates cells:

    # %% 05.1 right: TITLE
    # %% 05.1 wrong: TITLE | why: WHAT IS WRONG, for a person who reads the report

The program prints the report of each wrong answer. The program also prints the report of an answer if the
result of the check differs from the answer's header. At the end, the program prints the median time of a
check, and the slowest checks of refused answers. With `--alone`, only one check runs at a time, so other
checks do not increase these times.
"""

from __future__ import annotations

import os
import random
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from statistics import median

from course_pkg.checking.fixtures import around, percent_cells
from course_pkg.checking.parts import Part, every_part
from course_pkg.checking.report import Verdict
from course_pkg.sandbox.job import PartJob
from tests.checking.answers.workers import WorkerPool

WRITTEN = re.compile(
    r"# %% (?P<check>\d\d\.\d+) (?P<kind>right|wrong): (?P<title>[^|]+?)(?:\s*\| why: (?P<why>.+))?$"
)

# The program prints the times of this number of slow checks.
LONGEST = 5


def answers_main() -> int:
    """Check the answers. Return the number of answers for which the result differs from the header."""
    alone = "--alone" in sys.argv
    folder, *wanted = [each for each in sys.argv[1:] if each != "--alone"]
    paths = [path for path in sorted(Path(folder).glob("*.py")) if not wanted or path.stem in wanted]
    written = [answer for path in paths for answer in _written(path)]
    parts = {part.check: part for part in every_part()}
    count: Counter[tuple[str, str]] = Counter()
    times: list[tuple[float, str, str]] = []
    with WorkerPool(1 if alone else 2 * (os.cpu_count() or 1)) as pool:
        jobs = [(answer, _job_of(answer, source, parts)) for answer, source in written]
        pool.submit(job for _, job in jobs)
        for answer, job in jobs:
            outcome = pool.result(job)
            verdict = outcome.report.verdict if outcome.report else None
            judged = {Verdict.PASSED: "right", Verdict.FAILED: "wrong"}.get(
                verdict, f"not judged ({outcome.ending})"
            )
            count[answer["kind"], judged] += 1
            times.append((outcome.took, judged, f"{answer['check']} {answer['title']}"))
            print(f"{answer['check']} {answer['kind']}: {answer['title']}")
            if judged != answer["kind"]:
                print(f"  JUDGED {judged}: {outcome.report}", *outcome.messages, sep="\n    ")
            elif judged == "wrong":
                print(f"  why: {answer['why']}\n  report: {outcome.report}", sep="\n    ")
    for (kind, judged), number in sorted(count.items()):
        print(f"{kind}, judged {judged}: {number}")
    print(f"median time of a check, with its cells: {median(took for took, _, _ in times):.2f} s")
    for took, _, title in sorted(each for each in times if each[1] == "wrong")[: -1 - LONGEST : -1]:
        print(f"a long refusal: {took:.1f} s, {title}")
    return sum(number for (kind, judged), number in count.items() if kind != judged)


def _written(path: Path) -> Iterator[tuple[dict[str, str], str]]:
    for header, source, line in percent_cells(path.read_text("utf-8")):
        found = WRITTEN.match(header)
        if not found:
            raise SystemExit(f"{path}, line {line}: {header!r} is not a header of an answer")
        yield found.groupdict(default=""), source


def _job_of(answer: dict[str, str], source: str, parts: dict[str, Part]) -> PartJob:
    before, after = around(answer["check"])
    cells = tuple(cell.strip("\n") + "\n" for cell in source.split("# --- next cell\n"))
    part = parts[answer["check"]]
    seed = random.getrandbits(32)
    return PartJob(part.check, before, cells, after, seed, part.deadline, hidden=part.hidden)
