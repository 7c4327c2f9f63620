"""The cells that run before and after an answer of chapter 16 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import threading
import time

import actionlib
import rospy

from course_pkg import join
from course_pkg.msg import FetchAction, FetchFeedback, FetchGoal, FetchResult

node = join("chapter_16")
