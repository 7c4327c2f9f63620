"""Finds answers that read files or run programs although the exercise does not need this."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from course_pkg.grading.flags.observations import Observation, Program, unusual
from course_pkg.grading.flags.syntax import docstrings, dotted
from course_pkg.grading.flags.work import Found, Group

TITLE = "Code that reads other files"
MODULES = [
    "codecs.open",
    "fileinput.",
    "glob.",
    "importlib.resources.",
    "io.open",
    "io.FileIO",
    "linecache.",
    "mmap.",
    "pickle.load",
    "pkgutil.get_data",
    "runpy.",
    "shelve.",
    "shutil.",
    "sqlite3.",
    "tarfile.",
    "tokenize.open",
    "zipfile.",
    "rospkg.",
]
SYSTEM = frozenset(
    [
        "os.open",
        "os.fdopen",
        "os.read",
        "os.listdir",
        "os.scandir",
        "os.walk",
        "os.fwalk",
        "os.stat",
        "os.readlink",
        "os.link",
        "os.symlink",
        "os.chdir",
        "os.chmod",
        "os.chown",
        "os.rename",
        "os.replace",
        "os.remove",
        "os.unlink",
        "os.popen",
        "os.system",
        "os.memfd_create",
        "os.path.exists",
        "os.path.isfile",
        "os.path.isdir",
    ]
)
PROGRAMS = ("subprocess.", "os.exec", "os.spawn", "os.posix_spawn", "os.fork", "pty.", "multiprocessing.")
# Only pathlib.Path objects have the methods in METHODS.
METHODS = frozenset(["read_text", "read_bytes", "iterdir", "rglob"])
PATH_METHODS = frozenset(
    [
        "exists",
        "glob",
        "hardlink_to",
        "is_dir",
        "is_file",
        "open",
        "owner",
        "readlink",
        "stat",
        "symlink_to",
        "walk",
    ]
)
PATHS = frozenset(["pathlib.Path", "pathlib.PosixPath"])
# get_ipython() returns an object with the methods in `SHELL`, which run commands of the shell or of IPython.
SHELL = frozenset(["system", "getoutput", "run_line_magic", "run_cell_magic"])
PLACES = re.compile(
    r"(^|[/.])solutions?([/.]|$)|/proc\b|/etc/|/home/|/root/|\.ipynb\b|site-packages|\.grading\b|grades/"
    r"|\banswers\.py|\bchecks?\.py|\bprivate_\d\d|course_pkg/(chapters|grading|checking|sandbox|solutions)"
)


def find(group: Group) -> Iterator[Found]:
    """Yield a flag for each call in an answer that uses files or runs other programs.

    Calls that also occur in the course's own code are not flagged.
    """
    yield from unusual(group, "files", _observe, whole_notebook=False)


def _observe(program: Program) -> Iterator[Observation]:
    ignored = docstrings(program.module)
    for node in ast.walk(program.module):
        if isinstance(node, ast.Call):
            yield from _called(node, program)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in ignored:
            for place in PLACES.finditer(node.value):
                words = "The code contains a path to a place outside the exercise's folder."
                yield Observation(f"names {place[0]}", node.lineno, words)


def _called(node: ast.Call, program: Program) -> Iterator[Observation]:
    function = node.func
    name = dotted(function, program.names)
    if isinstance(function, ast.Name) and function.id == "open" and not name:
        yield Observation("open", node.lineno, "The code opens a file.")
    elif name in SYSTEM or any(name.startswith(each) for each in MODULES):
        yield Observation(name, node.lineno, f"The code calls {name}(), which reads or changes files.")
    elif name.startswith(PROGRAMS):
        yield Observation(name, node.lineno, f"The code calls {name}(), which can run other programs.")
    elif isinstance(function, ast.Attribute):
        yield from _method(function, node, program)


def _method(function: ast.Attribute, node: ast.Call, program: Program) -> Iterator[Observation]:
    called = function.value.func if isinstance(function.value, ast.Call) else None
    owner = dotted(called or function.value, program.names)
    if isinstance(called, ast.Name) and called.id == "get_ipython" and function.attr in SHELL:
        words = [each.value for each in node.args if isinstance(each, ast.Constant)]
        command = " ".join(str(word) for word in words).split(" ")[0]
        yield Observation(
            f"shell {command}", node.lineno, "The code runs a command of the shell or of IPython."
        )
    elif function.attr in METHODS or (owner in PATHS and function.attr in PATH_METHODS):
        yield Observation(
            function.attr,
            node.lineno,
            f"The code calls {function.attr}(), which is a method of pathlib.Path objects.",
        )
