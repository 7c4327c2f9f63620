"""Set up what is missing: the distribution's packages, the virtual environment, the catkin workspace.

The other libraries are installed by the set-up, so this package uses only the standard library.
"""

from course_pkg.setup import environment
from course_pkg.setup.places import CATKIN_FOLDERS, PACKAGE_PARTS, Places
from course_pkg.setup.steps import ensure

__all__ = ["CATKIN_FOLDERS", "PACKAGE_PARTS", "Places", "ensure", "environment"]
