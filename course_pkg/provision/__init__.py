"""Sets up whatever is missing: distribution packages, virtual environment, catkin workspace.

It runs before any of these is there, hence on the standard library alone.
"""

from course_pkg.provision import environment
from course_pkg.provision.places import Places
from course_pkg.provision.setup import ensure

__all__ = ["Places", "ensure", "environment"]
