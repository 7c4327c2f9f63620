"""Make rospy usable in a notebook: cells can run again, cells start programs, and errors are short."""
