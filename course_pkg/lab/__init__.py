"""Starts a ROS master, and with it JupyterLab (`course lab`) or any other command (`course run`)."""
