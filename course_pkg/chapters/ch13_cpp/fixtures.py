"""Code that runs before and after an answer of chapter 13 is tested alone; see checking/fixtures.py."""

# %% before
from course_pkg import join

node = join("chapter_13")
