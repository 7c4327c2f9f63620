"""Starts a ROS master, and then JupyterLab (`course lab`) or any other command (`course run`)."""
