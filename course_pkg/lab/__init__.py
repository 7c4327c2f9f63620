"""JupyterLab with a ROS master (`course lab`), and any other command with a master (`course run`)."""
