"""A turtle simulator that no client can tell from the one of ROS, and programs that drive its turtles.

`world` and `paper` know no ROS; `turtlesim_node`, `turtle_teleop_key` and `draw_square` are programs.
"""

from typing import TYPE_CHECKING

from course_pkg.lazy import lazily

if TYPE_CHECKING:
    from course_pkg.turtlesim.driving import Toggling, drive

__all__ = ["Toggling", "drive"]

__getattr__ = lazily(__name__, {"driving": "Toggling drive"})
