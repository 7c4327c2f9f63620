"""The cells that run before and after an answer of chapter 06 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import threading

import rospy
from course_pkg import join
from course_pkg.srv import geometry, geometryRequest

node = join("chapter_06")

# %% 06.4 before
def ask(proxy, sides, answers):
    """Call the service, and append its response to the list."""
    answers.append(proxy(*sides))
