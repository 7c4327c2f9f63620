"""What plain rospy needs in a notebook: cells that run again, programs of the terminal, readable errors."""
