"""Create what is missing: the distribution's packages, the virtual environment, and the catkin workspace.

This package uses only the standard library: it installs all other libraries itself.
"""

from course_pkg.setup import environment
from course_pkg.setup.places import CATKIN_FOLDERS, PACKAGE_PARTS, Places
from course_pkg.setup.steps import ensure

__all__ = ["CATKIN_FOLDERS", "PACKAGE_PARTS", "Places", "ensure", "environment"]
