"""If an answer runs without its notebook, these cells run before and after it; see checking/fixtures.py."""

# %% before
import threading
import time

import actionlib
import rospy

from course_pkg import join
from course_pkg.msg import FetchAction, FetchFeedback, FetchGoal, FetchResult

node = join("chapter_16")
