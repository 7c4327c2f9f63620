"""The cells that run before and after an answer of chapter 03 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import threading
import time

import rospy
from course_pkg import join
from course_pkg.srv import DetectCustomer
from std_msgs.msg import UInt32

node = join("chapter_03")


def say_good_day(number):
    time.sleep(0.2)
