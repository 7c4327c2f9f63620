"""The solutions themselves, graded: `course run python tests/bench/grading_reference.py [RUNS]`.

Every chapter's solution is handed in RUNS times (20), and graded as all submissions are, several at once.
Every part must pass every time: a check that fails a right answer now and then takes points from somebody.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections import Counter
from pathlib import Path

from course_pkg.authoring.shelf import Shelf
from tests.bench.grading_kill import grade
from tests.grading.submitted import hand_in


def main() -> None:
    """Grade, and print what was lost."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    lost: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        here = Path(folder)
        for number in range(runs):
            for path in Shelf().solutions():
                target = hand_in(here / "in", f"s{number:02}", path.name[:2])
                notebook = json.loads(target.read_text("utf-8"))
                notebook["cells"][0]["source"] += f"\n{number}"  # or all would be one, and graded once
                target.write_text(json.dumps(notebook), "utf-8")
        grade(here / "in", here / "out")
        graded = 0
        for record in sorted((here / "out" / "results").rglob("*.json")):
            for report in json.loads(record.read_text("utf-8"))["reports"]:
                graded += 1
                if report["verdict"] != "passed":
                    lost[report["check"]] += 1
                    print(
                        record.parent.name,
                        report["check"],
                        report["verdict"],
                        report["note"],
                        [r for r in report["rules"] if not r["holds"]],
                    )
    print(f"{graded - sum(lost.values())} of {graded} parts passed (bar: all); lost: {dict(lost)}")
    sys.exit(bool(lost))


if __name__ == "__main__":
    main()
