"""From solutions, which are written and run by an author, to the notebooks that students get."""

from course_pkg.authoring.execute import execute
from course_pkg.authoring.shelf import Shelf, derived, sync
from course_pkg.authoring.validate import validate

__all__ = ["Shelf", "derived", "execute", "sync", "validate"]
