"""The cells that run before and after an answer of chapter 05 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import rospy
from course_pkg import join
from course_pkg.srv import geometry, geometryResponse
from std_srvs.srv import Empty, EmptyResponse, SetBool, SetBoolResponse, Trigger, TriggerResponse

node = join("chapter_05")
