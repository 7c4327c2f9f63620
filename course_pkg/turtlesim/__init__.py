"""A turtle simulator with the topics and services of turtlesim in ROS, and programs that drive its turtles.

The modules `world` and `canvas` need no ROS. `turtlesim_node`, `turtle_teleop_key` and `draw_square` are
programs.
"""
