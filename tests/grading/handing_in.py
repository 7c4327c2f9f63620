"""Makes submissions from the course's notebooks, in the layouts of all platforms."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Mapping
from pathlib import Path

from course_pkg.authoring.cells import Notebook
from course_pkg.authoring.notebook_store import NotebookStore, derived, read

NAMES = {"05": "05_write_a_server.ipynb", "06": "06_write_a_client.ipynb"}


def reference(chapter: str = "05") -> Notebook:
    """Return the solution of a chapter."""
    return read(NotebookStore().solutions([chapter])[0])


def handed_out(chapter: str = "05") -> Notebook:
    """Return the students' notebook of a chapter."""
    return json.loads(json.dumps(derived(reference(chapter))))


def raw(notebook: Notebook) -> bytes:
    """Return the bytes of a notebook file."""
    return json.dumps(notebook).encode()


def folder(root: Path, files: Mapping[str, bytes]) -> Path:
    """Write files into a folder; `files` maps the path of each file to its content."""
    for path, content in files.items():
        target = root / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
    return root


def zipped(path: Path, files: Mapping[str, bytes], **changes: int | str | bytes) -> Path:
    """Write files into a zip file. `changes` contains attributes that are set in each ZipInfo."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            member = zipfile.ZipInfo("placeholder", (2026, 1, 1, 0, 0, 0))
            member.filename = name
            member.compress_type = zipfile.ZIP_DEFLATED
            for key, value in changes.items():
                setattr(member, key, value)
            archive.writestr(member, content)
    return path
