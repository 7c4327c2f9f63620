"""Measures the grading of submissions, the flags for copies, partial credit, and the review page.

usage: ./course run python -m tests.bench.grading SUBCOMMAND [OPTION …]

- `speed` compares `course grade` with nbgrader.
- `kill` kills `course grade` again and again.
- `reference` grades the solutions many times.
- `answers` checks answers by authors who knew only the goals.
- `copies` measures how well the flags find copies.
- `credit` measures the points of wrong answers.
- `review` measures the time that the review page needs to show the next answer.
"""

from __future__ import annotations

from tests.bench.commands import run_command
from tests.bench.grading.answers import answers_main
from tests.bench.grading.copying import copies_main
from tests.bench.grading.credit import credit_main
from tests.bench.grading.review import review_main
from tests.bench.grading.speed import kill_main, reference_main, speed_main

if __name__ == "__main__":
    run_command(
        {
            "speed": speed_main,
            "kill": kill_main,
            "reference": reference_main,
            "answers": answers_main,
            "copies": copies_main,
            "credit": credit_main,
            "review": review_main,
        }
    )
