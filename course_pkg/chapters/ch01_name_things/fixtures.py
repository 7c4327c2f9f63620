"""If an answer runs without its notebook, these cells run before and after it; see checking/fixtures.py."""

# %% before
import rosgraph
import rosnode
import rospy
import rosservice
from course_pkg import join
from course_pkg.srv import geometry

node = join("chapter_01")
master = rosgraph.Master(node.name)
