"""The process of JupyterLab's server, as `serve.py` starts it: `python -m course_pkg.lab OPTION…`.

It can receive the first browser at once, and only then begins to load the server.
"""

from __future__ import annotations

import json
import os
import socket
import sys
from pathlib import Path

from course_pkg.lab.page import Page
from course_pkg.lab.porch import Porch
from course_pkg.lab.task import VARIABLE, Task


def main() -> None:
    """Serve until told to stop."""
    task = Task(**json.loads(os.environ.pop(VARIABLE)))  # no kernel and no terminal sees it
    listener = socket.socket(fileno=task.socket)
    listener.set_inheritable(False)
    page = Page.read(Path(task.page))
    question = f"GET {task.path}?token={task.token} HTTP/1.1\r\n".encode()
    porch = Porch(listener, question, page.response(task.token, task.notebook) if page else b"")
    from course_pkg.lab.server import serve  # takes the larger part of a second

    serve(task, porch, sys.argv[1:])


if __name__ == "__main__":
    main()
