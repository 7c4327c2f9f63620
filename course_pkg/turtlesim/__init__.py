"""A turtle simulator with the interface of the one in ROS, and programs that drive its turtles.

`world` and `canvas` need no ROS; `turtlesim_node`, `turtle_teleop_key` and `draw_square` are programs.
"""
