"""If an answer runs without its notebook, these cells run before and after it; see checking/fixtures.py."""

# %% before
from course_pkg import join

node = join("chapter_13")
