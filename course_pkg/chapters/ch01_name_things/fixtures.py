"""The cells that run before and after an answer of chapter 01 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
import rosgraph
import rosnode
import rospy
import rosservice
from course_pkg import join
from course_pkg.srv import geometry

node = join("chapter_01")
master = rosgraph.Master(node.name)
