"""If an answer runs without its notebook, these cells run before and after it; see checking/fixtures.py."""

# %% before
from pathlib import Path

from course_pkg import join

node = join("chapter_14")
Path("src/my_turtles_cpp/src").mkdir(parents=True, exist_ok=True)
Path("src/my_turtles_cpp/launch").mkdir(parents=True, exist_ok=True)
