"""A JupyterHub for a class on one machine.

The package contains `course hub`, and the classes that the hub's configuration uses.

`start.py` prepares and runs the hub. The hub loads deploy/jupyterhub/jupyterhub_config.py. This file selects
the authenticator and the spawner of this package. The spawner starts `single_user.py` as each student.
"""
