"""The cells that run before and after an answer of chapter 02 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import threading
import time

import rospy
from course_pkg import join
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64, String, UInt32

node = join("chapter_02")


def wait_until(condition, seconds=10.0):
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.01)
