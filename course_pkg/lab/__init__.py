"""JupyterLab with a ROS master: `course lab`, and `course run` for any other command."""

from course_pkg.lab.serve import serve_lab

__all__ = ["serve_lab"]
