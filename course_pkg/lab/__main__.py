"""Starts the unchanged JupyterLab: `python -m course_pkg.lab OPTION…` is the same as `jupyter lab OPTION…`.

If Node.js is installed, JupyterLab starts half a second faster with this module. During its import,
jupyterlab runs `node` to read the address of the npm registry from Yarn's configuration. Only a build of the
front end needs this address. Therefore, main() hides `node`; jupyterlab then uses the default address.
"""

from __future__ import annotations

import os


def main() -> None:
    """Remove all programs from PATH, import jupyterlab, restore PATH, and run jupyterlab."""
    path = os.environ.get("PATH", os.defpath)
    os.environ["PATH"] = os.devnull
    from jupyterlab.labapp import main as run

    os.environ["PATH"] = path
    run()


if __name__ == "__main__":
    main()
