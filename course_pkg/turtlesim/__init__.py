"""A turtle simulator with the same topics and services as turtlesim in ROS, and programs for its turtles.

The modules `world` and `canvas` need no ROS. `turtlesim_node`, `turtle_teleop_key` and `draw_square` are
programs.
"""
