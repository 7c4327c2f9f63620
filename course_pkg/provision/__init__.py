"""Sets up whatever is missing: distribution packages, virtual environment, catkin workspace.

It runs before any of these is there, hence on the standard library alone.
"""

from course_pkg.provision import environment
from course_pkg.provision.places import CATKIN_FOLDERS, Places
from course_pkg.provision.setup import ensure

__all__ = ["CATKIN_FOLDERS", "Places", "ensure", "environment"]
