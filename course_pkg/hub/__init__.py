"""A JupyterHub for a class on one machine: `course hub`, and the classes that the hub's configuration uses.

`start.py` prepares and runs the hub. The hub loads deploy/jupyterhub/jupyterhub_config.py, which names the
authenticator and the spawner of this package. The spawner starts `single_user.py` as each student.
"""
