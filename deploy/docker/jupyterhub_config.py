"""The configuration of a hub that starts one Docker container for each student.

This file is untested, because no image registry was available.

Build the image from the course's Dockerfile as `ros-services-course`, and install dockerspawner 14 in
JupyterHub's environment. Each container has a separate network namespace, so the ROS graph of a container is
private.
"""

c = get_config()  # noqa: F821 -- JupyterHub defines this function

c.JupyterHub.spawner_class = "dockerspawner.DockerSpawner"
c.JupyterHub.hub_ip = "0.0.0.0"  # noqa: S104 -- the containers connect to the hub
c.DockerSpawner.image = "ros-services-course"
c.DockerSpawner.remove = True
c.DockerSpawner.network_name = "ros-course"
c.DockerSpawner.volumes = {"ros-course-{username}": "/home/jovyan/work"}
c.DockerSpawner.mem_limit = "1G"
c.DockerSpawner.cpu_limit = 1.0
c.DockerSpawner.extra_host_config = {
    "pids_limit": 500,
    "cap_drop": ["ALL"],
    "security_opt": ["no-new-privileges"],
}
c.Spawner.default_url = "/lab"
