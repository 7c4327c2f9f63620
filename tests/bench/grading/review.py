"""Measures the time that the review page needs to show the next answer, in a browser."""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from tests.browser.chromium import chromium
from tests.grading.review.classes import TOKEN, graded, serving, write_class

STUDENTS = 300
LINES = 60  # Each answer has this number of lines.
STEPS = 200
# The function presses a key, and returns the time in ms until the browser paints the next answer.
PRESS = """
async (key) => {
  const before = document.body.dataset.shown;
  const began = performance.now();
  document.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  while (document.body.dataset.shown === before) await new Promise((resolve) => setTimeout(resolve));
  await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
  return performance.now() - began;
}
"""


def review_main() -> None:
    """Press keys one after another; print the median, the 95th percentile and the maximum time."""
    grades = [
        graded(f"s{number:03}", "\n".join(f"value_{line} = {number + line}" for line in range(LINES)))
        for number in range(STUDENTS)
    ]
    with tempfile.TemporaryDirectory(prefix="course-bench-") as folder:
        out = write_class(Path(folder), grades)
        with serving(out) as url, chromium() as browser:
            page = browser.new_page()
            page.goto(f"{url}/?token={TOKEN}")
            page.wait_for_selector("body[data-shown='0']")
            times = sorted(page.evaluate(PRESS, "n") for _ in range(STEPS))
            times_back = sorted(page.evaluate(PRESS, "N" if step % 2 == 0 else "P") for step in range(20))
    for name, values in (("next answer", times), ("other part", times_back)):
        print(
            f"{name}: median {statistics.median(values):.0f} ms, "
            f"95 % {values[int(0.95 * len(values))]:.0f} ms, maximum {values[-1]:.0f} ms"
        )
