"""A turtle simulator that no client can tell from the one of ROS.

`world` and `paper` know no ROS; `turtlesim_node`, `turtle_teleop_key` and `draw_square` are the programs.
"""
