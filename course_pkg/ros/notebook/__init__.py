"""Make rospy usable in a notebook: a cell can run again or start programs, and error messages are short."""
