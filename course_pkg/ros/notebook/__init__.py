"""Make rospy usable in a notebook: run cells again, start programs, and show short error messages."""
