"""Make rospy usable in a notebook: cells can run again and start programs, and error messages are short."""
