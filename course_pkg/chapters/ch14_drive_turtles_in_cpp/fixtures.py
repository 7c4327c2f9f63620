"""The cells that run before and after an answer of chapter 14 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
from pathlib import Path

from course_pkg import join

node = join("chapter_14")
Path("src/my_turtles_cpp/src").mkdir(parents=True, exist_ok=True)
Path("src/my_turtles_cpp/launch").mkdir(parents=True, exist_ok=True)
