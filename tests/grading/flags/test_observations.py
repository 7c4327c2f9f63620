"""An answer gets a flag if it inspects other code, changes modules or reads files."""

from __future__ import annotations

import pytest

from course_pkg.checking.parts import chapters
from course_pkg.grading.flags.finding import kind_names
from course_pkg.grading.grade import Package, Submission
from course_pkg.sandbox.job import work_file
from tests.checking.answers.example_answers import every_answer
from tests.grading.flags.classes import flags_of, solutions, submission

SEARCHED = ("files", "internals", "patches")
ANSWER = """{line}


def handle_geometry(request):
    return geometryResponse(area=1.0, volume=2.0)


geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)
"""


LINES = [
    ("import inspect", "internals"),
    ("import course_pkg.checking.processes.runner", "internals"),
    ("from course_pkg import grading", "internals"),
    ("from course_pkg.checking import parts as p", "internals"),
    ("import sys; frame = sys._getframe(1)", "internals"),
    ("from sys import _getframe; frame = _getframe(1)", "internals"),
    ("import sys as s; modules = s.modules", "internals"),
    ("import os; print(os.environ)", "internals"),
    ("found = handle.__globals__", "internals"),
    ("found = getattr(rospy.spin, '__code__')", "internals"),
    ("runner = __import__('course_pkg.checking.processes.runner')", "internals"),
    ("get_ipython().events.register('pre_run_cell', print)", "internals"),
    ("eval('1')", "internals"),
    ("rospy.Service = print", "patches"),
    ("rospy.Service.__init__ = print", "patches"),
    ("import threading; threading.Lock = print", "patches"),
    ("from threading import Lock as L; L.acquire = print", "patches"),
    ("import time as t; setattr(t, 'sleep', print)", "patches"),
    ("clock = rospy.Time; clock.now = print", "patches"),
    ("import builtins; del builtins.print", "patches"),
    ("rospy.__dict__['spin'] = print", "patches"),
    ("vars(rospy)['spin'] = print", "patches"),
    ("rospy.__dict__.update(spin=print)", "patches"),
    ("rospy = print", "patches"),
    ("geometryResponse.area = 1.0", "patches"),
    ("open('notes.txt')", "files"),
    ("import os; os.listdir('..')", "files"),
    ("from pathlib import Path; Path('x').read_text()", "files"),
    ("from pathlib import Path; where = Path('x'); where.open()", "files"),
    ("import subprocess; subprocess.run(['ls'])", "files"),
    ("name = '../solutions/05_write_a_server.ipynb'", "files"),
    ("name = '/proc/1/environ'", "files"),
    ("!cat secret", "files"),
    ("%run other.py", "files"),
]
ORDINARY = [
    "import threading; lock = threading.Lock()",
    "import math, time",
    "from course_pkg.srv import AddTwoInts",
    "from course_pkg import check, predict",
    "response = geometryResponse(); response.area = 1.0",
    "class Box: pass\nbox = Box(); box.side = 1.0; Box.count = 0",
    "def words():\n    '''See the solutions/ folder and open() /proc.'''",
    "# open('/proc/1/environ')",
    "name = 'course_pkg/geometry'",
    "rospy.loginfo('%s', type(rospy).__name__)",
]


@pytest.fixture(scope="module")
def found() -> dict[str, set[str]]:
    """For each tested line, return the kinds of flags that the line causes."""
    lines = [*(line for line, _ in LINES), *ORDINARY]
    handed_in = [submission(line, {"05.1": ANSWER.format(line=line)}) for line in lines]
    flags = flags_of(SEARCHED, *handed_in)
    return {line: {flag.kind for flag in flags.get(line, ())} for line in lines}


@pytest.mark.parametrize(("line", "kind"), LINES)
def test_a_line_and_its_kind(found: dict[str, set[str]], line: str, kind: str) -> None:
    """Each tested line leads to a flag of the expected kind."""
    assert kind in found[line]


@pytest.mark.parametrize("line", ORDINARY)
def test_an_ordinary_line(found: dict[str, set[str]], line: str) -> None:
    """A line of ordinary code leads to no flag."""
    assert found[line] == set()


def test_a_flag_shows_the_line() -> None:
    """The flag contains the id of the part, the line number, and the line."""
    answer = ANSWER.format(line="\nimport inspect  # why?")
    (flag,) = flags_of(SEARCHED, submission("s01", {"05.1": answer}))["s01"]
    assert (flag.where, flag.line, flag.evidence) == ("05.1", 2, "import inspect  # why?")
    assert flag.words == "The code imports inspect."


def test_the_solutions_have_no_flags() -> None:
    """Solutions and handed-out notebooks get no flags."""
    for chapter in chapters():
        handed_in = submission("s01", solutions(chapter), chapter), submission("s02", {}, chapter)
        assert flags_of(SEARCHED, *handed_in) == {}, chapter


def test_right_example_answers() -> None:
    """Of all right example answers, only the answer with the command `rosservice find` gets a flag."""
    # Each key is a chapter and the number of a student. Each value maps parts to this student's answers.
    students: dict[tuple[str, int], dict[str, str]] = {}
    for answer in every_answer():
        if answer.right:
            chapter = answer.check.partition(".")[0]
            number = next(n for n in range(99) if answer.check not in students.get((chapter, n), {}))
            students.setdefault((chapter, number), {})[answer.check] = answer.source
    flagged = []
    for chapter in chapters():
        ours = [(number, answers) for (other, number), answers in students.items() if other == chapter]
        handed_in = [submission(f"s{number}", answers, chapter) for number, answers in ours]
        flags = [flag for each in flags_of(SEARCHED, *handed_in).values() for flag in each]
        flagged += [(flag.where, flag.words) for flag in flags]
    assert flagged == [("08.1", "The code calls subprocess.run(), which can run other programs.")]


def test_a_program_in_a_package() -> None:
    """The search also reads the Python files in a package, and the flag contains a line of the file."""
    script = work_file("scripts/spawn_turtle.py", b"#!/usr/bin/env python3\nimport ctypes\n", executable=True)
    packages = (Package("my_turtles", (script,), "s01/my_turtles"),)
    handed_in = Submission("s01", "09", b"", "s01/my_turtles", problem="No notebook.", packages=packages)
    (flag,) = flags_of(SEARCHED, handed_in)["s01"]
    assert (flag.where, flag.line) == ("my_turtles/scripts/spawn_turtle.py", 2)


def test_programs_that_are_hard_to_read() -> None:
    """The search also works for deep nesting, very long expressions and text that is not Python."""
    sources = [
        "x = " + "(" * 90 + ")" * 90,
        "x = " + "-" * 5000 + "1",
        "x" + ".x" * 5000,
        "x = 0x" + "f" * 9000,
        "x = x\n" * 3000,
        "(",
        "x = '\udc80'",
    ]
    flags_of(kind_names(), *(submission(f"s{n}", {"05.1": source}) for n, source in enumerate(sources)))


def test_a_program_that_is_too_long() -> None:
    """If a program is too long for the search, the instructor gets a message."""
    (flag,) = flags_of(SEARCHED, submission("s01", {"05.1": "x = 1\n" * 5000}))["s01"]
    assert flag.words == "The code is too long, so it was not searched for suspicious lines."
