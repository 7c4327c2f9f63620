"""The cells before and after an answer of chapter 13 outside of its notebook; see checking/fixtures.py."""

# %% before
from course_pkg import join

node = join("chapter_13")
