"""The configuration of JupyterHub 5 for a class on one machine. `course hub` starts the hub with this file.

`course hub` writes the values of `settings` from its options. Change or add any other option of JupyterHub in
this file.
"""

import sys

from course_pkg.hub.settings import Settings

c = get_config()  # noqa: F821 -- JupyterHub defines this function
settings = Settings.read()

# Browsers reach the proxy at `url`. The hub and the proxy's control port listen only on 127.0.0.1.
c.JupyterHub.bind_url = settings.url
c.JupyterHub.ssl_cert = settings.cert
c.JupyterHub.ssl_key = settings.key
c.JupyterHub.hub_bind_url = f"http://127.0.0.1:{settings.hub_port}"
c.ConfigurableHTTPProxy.api_url = f"http://127.0.0.1:{settings.proxy_port}"
c.ConfigurableHTTPProxy.command = [settings.proxy]
c.ConfigurableHTTPProxy.pid_file = f"{settings.state}/proxy.pid"

# The hub stores its own data in these files. Cookies stay valid when the hub starts again, because the secret
# is stored.
c.JupyterHub.db_url = f"sqlite:///{settings.state}/hub.sqlite"
c.JupyterHub.cookie_secret_file = f"{settings.state}/cookie_secret"
c.JupyterHub.cleanup_servers = True

c.JupyterHub.authenticator_class = "course_pkg.hub.authenticator.OneTimeAuthenticator"
c.OneTimeAuthenticator.passwords = f"{settings.state}/passwords.json"
c.Authenticator.allowed_users = set(settings.students)
c.Authenticator.admin_users = {settings.teacher} if settings.teacher else set()

c.JupyterHub.spawner_class = "course_pkg.hub.spawner.CourseSpawner"
c.CourseSpawner.homes = settings.homes
c.CourseSpawner.memory = settings.memory  # MiB
c.CourseSpawner.processes = settings.processes
c.Spawner.environment = settings.environment
c.Spawner.env_keep = ["LANG", "LC_ALL", "TZ"]
c.Spawner.default_url = "/lab"
# If all students start at the same time, a server on a small machine needs minutes instead of 3 s to start.
c.Spawner.start_timeout = 300
c.Spawner.http_timeout = 300

# Only the teacher can open the page of the class view. The students' servers send the results of checks to
# the class view.
if settings.class_port:
    c.JupyterHub.services = [
        {
            "name": "class",
            "url": f"http://127.0.0.1:{settings.class_port}",
            "command": [sys.executable, "-m", "course_pkg.cli", "class", "--data", f"{settings.state}/class"],
            "oauth_no_confirm": True,
        }
    ]
    teacher = {"name": "teacher", "scopes": ["self", "access:services!service=class"]}
    c.JupyterHub.load_roles = [{**teacher, "users": [settings.teacher]}] if settings.teacher else []
    address = f"http://127.0.0.1:{settings.class_port}/services/class/"
    c.Spawner.environment = {**settings.environment, "COURSE_CLASS_URL": address}
