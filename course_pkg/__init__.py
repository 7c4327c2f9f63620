"""A course on ROS 1 services."""

from pkgutil import extend_path

# catkin generates `course_pkg.srv` into another folder; without this, the checkout hides it.
__path__ = extend_path(__path__, __name__)
