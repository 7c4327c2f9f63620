"""Measures how well the flags find copies in a class of 300 students.

Arguments: `[SEED …]`. The benchmark writes the submissions of a class for chapter 05. Each of 280 students
gets independently written answers in a random style. The other 20 students copy a student's answers. To
disguise the copies, these students change names, order and comments. Ten of these 20 students copy all four
exercises, and the other ten copy only two exercises.
"""

from __future__ import annotations

import json
import random
import sys
import time
from pathlib import Path

from course_pkg.authoring.cells import code_cells, exercise_of
from course_pkg.authoring.notebook_store import NotebookStore, derived, read
from course_pkg.checking.fixtures import percent_cells
from course_pkg.checking.parts import folder_of
from course_pkg.grading.flags.finding import with_flags
from course_pkg.grading.flags.fingerprints import fingerprint
from course_pkg.grading.flags.similarity import STATEMENTS
from course_pkg.grading.flags.work import Answer
from course_pkg.grading.grade import Grade, Submission
from tests.bench.grading.disguises import Rule, a_style, disguised, in_style
from tests.checking.answers.example_answers import read_answers

CHAPTER = "05"
STUDENTS, COPIES = 300, 20
SECONDS, FALSE_ALARMS, WRITTEN = 20.0, 2, 60
HANDLERS = {"handle_count", "handle_reset", "handle_switch", "handle_checked_geometry"}
SERVICES = {"count_service", "reset_service", "switch_service", "checked_service"}
KEPT = {"Counter", "Switch", "counter", "switch", *HANDLERS, *SERVICES}
Answers = dict[str, str]  # This type maps the id of a part to the source of the student's answer.


def copies_main() -> int:
    """Print one line for each seed, and return the number of limits that are not met."""
    written = independent_answers()
    count = sum(map(len, written.values()))
    print(f"{count} independently written answers of at least {STATEMENTS} statements (bar {WRITTEN})")
    missed = int(count < WRITTEN)
    for seed in map(int, sys.argv[1:] or ["1"]):
        missed += not measured(written, seed)
    return missed


def measured(written: dict[str, list[str]], seed: int) -> bool:
    """Print the result of the flags for the class with this seed.

    Return whether the result meets its limits.
    """
    students, pairs = a_class(written, random.Random(seed))  # noqa: S311 -- a class that can be repeated
    submissions = [handed_in(number, answers) for number, answers in enumerate(students)]
    grades = [Grade(each.student, CHAPTER, (), origin=each.origin) for each in submissions]
    began = time.monotonic()
    flagged = with_flags(grades, submissions, ["copies"])
    took = time.monotonic() - began
    found = {
        frozenset((grade.student, other))
        for grade in flagged
        for flag in grade.flags
        for other in flag.others
    }
    planted = {frozenset(map(name_of, pair)) for pair in pairs}
    false = found - planted
    print(
        f"seed {seed}: {len(planted & found)} of {len(planted)} copies found (bar: all), {len(false)} false "
        f"alarms (bar {FALSE_ALARMS}), {took:.1f} s for {len(submissions)} submissions (bar {SECONDS:g})"
    )
    return planted <= found and len(false) <= FALSE_ALARMS and took <= SECONDS


def independent_answers() -> dict[str, list[str]]:
    """Return the independent answers to each part, without very short answers."""
    found: dict[str, list[str]] = {}
    own = Path(__file__).with_name("independent_05.txt").read_text("utf-8")
    for header, source, _ in percent_cells(own):
        found.setdefault(header.removeprefix("# %% "), []).append(source)
    for answer in read_answers(folder_of(CHAPTER) / "answers.py"):
        if answer.right and answer.check in found:
            found[answer.check].append(answer.source)
    return {
        part: [source for source in sources if fingerprint(Answer(part, source)).statements >= STATEMENTS]
        for part, sources in found.items()
    }


def a_class(
    written: dict[str, list[str]], draw: random.Random
) -> tuple[list[Answers], list[tuple[int, int]]]:
    """Return the answers of all students, and the pairs of student numbers (original, copy)."""
    students: list[Answers] = []
    for _ in range(STUDENTS - COPIES):
        style = a_style(draw)
        students.append(
            {part: styled(draw.choice(sources), style, draw) for part, sources in written.items()}
        )
    pairs = []
    for number, original in enumerate(draw.sample(range(len(students)), COPIES)):
        style = a_style(draw)
        parts = sorted(written)
        copied = parts if number % 2 else draw.sample(parts, 2)
        answers = {part: styled(draw.choice(written[part]), style, draw) for part in parts}
        answers |= {part: disguised(students[original][part], KEPT, draw) for part in copied}
        pairs.append((original, len(students)))
        students.append(answers)
    return students, pairs


def styled(source: str, style: list[Rule], draw: random.Random) -> str:
    """Return an answer in the style of a student."""
    return in_style(source, style, draw)


def handed_in(number: int, answers: Answers) -> Submission:
    """Return a submission: the notebook of chapter 05 with the answers of one student."""
    notebook = json.loads(json.dumps(derived(read(NotebookStore().solutions([CHAPTER])[0]))))
    for cell in code_cells(notebook):
        cell["source"] = answers.get(exercise_of(cell), cell["source"])
    name = name_of(number)
    return Submission(name, CHAPTER, json.dumps(notebook).encode(), f"{name}/{CHAPTER}.ipynb")


def name_of(number: int) -> str:
    """Return the name of a student."""
    return f"s{number:03}"
