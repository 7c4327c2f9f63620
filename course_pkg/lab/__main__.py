"""Starts the stock JupyterLab: `python -m course_pkg.lab OPTION…` does what `jupyter lab OPTION…` does.

If node is installed, it starts half a second faster. When jupyterlab is imported, it runs node to read the
address of the npm registry from Yarn's configuration. Only a build of the front end needs that address, and
without node on PATH jupyterlab uses the default.
"""

from __future__ import annotations

import os


def main() -> None:
    """Import jupyterlab while no program can be found, then run it in the usual environment."""
    path = os.environ.get("PATH", os.defpath)
    os.environ["PATH"] = os.devnull
    from jupyterlab.labapp import main as run

    os.environ["PATH"] = path
    run()


if __name__ == "__main__":
    main()
