"""The environment variables of ROS.

The set-up reads the variables of ROS once from the workspace's setup.bash, and stores the variables in a
file.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping, MutableMapping
from pathlib import Path

from course_pkg.files import write_atomically
from course_pkg.setup.places import Places

# The course does not use the user's values of these variables. The first three variables could break the
# course. The last variable would make Python compile all modules of JupyterLab at every start (2 s).
REMOVED = ("PYTHONHOME", "PYTHONPATH", "PYTHONSTARTUP", "PYTHONDONTWRITEBYTECODE")
LOOPBACK = "devel/lib/libcourse_loopback.so"  # The set-up builds this library from ros/process/loopback.c.
BY_SHELL = ("PWD", "OLDPWD", "SHLVL", "_")
NETWORK = ("ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP")


def write(places: Places) -> None:
    """Source the workspace's setup.bash in an empty shell, and store the variables that it sets."""
    script = 'source "$0" && exec env -0'
    bare = {"PATH": _system_path(places), "HOME": os.path.expanduser("~")}
    bash = [_bash(), "-c", script, str(places.workspace / "devel" / "setup.bash")]
    listing = subprocess.run(bash, env=bare, capture_output=True, text=True, check=True)
    pairs = (item.split("=", 1) for item in listing.stdout.split("\0") if item)
    variables = {name: value for name, value in pairs if name not in (*BY_SHELL, *NETWORK, "HOME", "PATH")}
    variables["PYTHONPATH"] = os.pathsep.join(python_path(places))
    if not places.conda:
        variables["VIRTUAL_ENV"] = str(places.venv)
    write_atomically(places.environment, json.dumps(variables, indent=1))


def merged(places: Places, environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment with the variables of the course, which replace the user's values.

    In PATH, the folders of the interpreter and of the system come before all other folders. ROS_MASTER_URI,
    ROS_HOSTNAME and ROS_IP keep the user's values. LD_PRELOAD contains a library of the course. With this
    library, C++ nodes listen only on 127.0.0.1 if ROS_HOSTNAME is localhost.
    """
    result = {name: value for name, value in environ.items() if name not in REMOVED}
    result.update(json.loads(places.environment.read_text()))
    first = [str(places.venv / "bin"), *_system_path(places).split(os.pathsep)]
    rest = [folder for folder in environ.get("PATH", "").split(os.pathsep) if folder not in first]
    result["PATH"] = os.pathsep.join([*dict.fromkeys(first), *filter(None, rest)])
    if not any(environ.get(name) for name in NETWORK):
        result["ROS_HOSTNAME"] = "localhost"
    library = places.workspace / LOOPBACK
    if library.exists():  # The set-up builds the library only on Linux.
        preloaded = environ.get("LD_PRELOAD", "").replace(":", " ").split()
        result["LD_PRELOAD"] = ":".join(dict.fromkeys([*preloaded, str(library)]))
    result.setdefault("ROS_LOG_DIR", str(places.own_data / "log" / "ros"))
    # rospy's messages import numpy, and numpy starts threads. These threads would receive signals that the
    # main thread blocks. Also, a process with several threads cannot enter a user namespace.
    result.setdefault("OPENBLAS_NUM_THREADS", "1")
    return result


def apply(places: Places | None = None) -> bool:
    """Apply the environment to this process; before the set-up, change nothing and return False."""
    places = places or Places.of()
    try:
        fresh = merged(places, os.environ)
    except (OSError, ValueError):
        return False
    _replace(os.environ, fresh)
    for folder in reversed(fresh["PYTHONPATH"].split(os.pathsep)):
        if folder not in sys.path:
            sys.path.insert(1, folder)
    return True


def python_path(places: Places) -> list[str]:
    """Return the folders of the course's modules and of the modules that catkin generated."""
    generated = [str(path) for path in (places.workspace / "devel").glob("lib/python3*/*-packages")]
    return [str(places.checkout), *generated]


def _replace(environ: MutableMapping[str, str], fresh: Mapping[str, str]) -> None:
    for name in set(environ) - set(fresh):
        del environ[name]
    environ.update(fresh)


def _system_path(places: Places) -> str:
    system = "/usr/bin:/bin"
    return f"{places.conda}/bin:{system}" if places.conda else system


def _bash() -> str:
    return "/bin/bash" if Path("/bin/bash").exists() else "bash"
