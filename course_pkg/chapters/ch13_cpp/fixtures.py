"""The cells that run before and after an answer of chapter 13 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
from course_pkg import join

node = join("chapter_13")
