"""If an answer runs without its notebook, these cells run before and after it; see checking/fixtures.py."""

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
