"""The cells that run before and after an answer of chapter 08 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import json
import shlex

import genpy
import rospy
import rosservice
import yaml
from course_pkg import join
from course_pkg.srv import AddTwoInts, ServiceExample
from std_srvs.srv import Empty, SetBool, SetBoolResponse, Trigger

node = join("chapter_08")
