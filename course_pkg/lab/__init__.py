"""JupyterLab with a ROS master: `course lab`; and `course run`, for any other command with a master."""
