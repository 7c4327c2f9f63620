"""The cells before and after an answer of chapter 16 outside of its notebook; see checking/fixtures.py."""

# %% before
import threading
import time

import actionlib
import rospy

from course_pkg import join
from course_pkg.msg import FetchAction, FetchFeedback, FetchGoal, FetchResult

node = join("chapter_16")
