"""If an answer runs without its notebook, these cells run before and after it; see checking/fixtures.py."""

# %% before
import rospy
from course_pkg import join
from course_pkg.srv import geometry, geometryResponse
from std_srvs.srv import Empty, EmptyResponse, SetBool, SetBoolResponse, Trigger, TriggerResponse

node = join("chapter_05")
