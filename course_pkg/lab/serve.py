"""Provisional."""
from __future__ import annotations
import os
import subprocess, sys
from pathlib import Path
from course_pkg.lab.master import master_of_this_command

def serve_lab(notebook, *, port, ip, browser):
    root = Path(__file__).parents[2]
    with master_of_this_command():
        return subprocess.call([sys.executable, "-m", "jupyterlab", f"--ServerApp.root_dir={root}", f"--ip={ip}", f"--port={port or 8888}", *([] if browser else ["--no-browser"]), *(["--allow-root"] if os.getuid() == 0 else [])])
