"""Notebooks as students hand them in, made from the real ones, and folders and zips of them."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from course_pkg.authoring import Shelf
from course_pkg.authoring.shelf import derived, read

NAMES = {"05": "05_write_a_server.ipynb", "06": "06_write_a_client.ipynb"}


def reference(chapter: str = "05") -> dict[str, Any]:
    """Return the solution of a chapter."""
    return read(Shelf().solutions([chapter])[0])


def handed_out(chapter: str = "05") -> dict[str, Any]:
    """Return the notebook that students begin with."""
    return json.loads(json.dumps(derived(reference(chapter))))


def raw(notebook: Mapping[str, Any]) -> bytes:
    """Return a notebook as a file holds it."""
    return json.dumps(notebook).encode()


def folder(root: Path, files: Mapping[str, bytes]) -> Path:
    """Write `files` below `root`."""
    for path, content in files.items():
        target = root / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
    return root


def zipped(path: Path, files: Mapping[str, bytes], **changes: Any) -> Path:  # noqa: ANN401 -- of a ZipInfo
    """Write `files` into a zip; `changes` are attributes of each member."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            member = zipfile.ZipInfo("placeholder", (2026, 1, 1, 0, 0, 0))
            member.filename = name
            member.compress_type = zipfile.ZIP_DEFLATED
            for key, value in changes.items():
                setattr(member, key, value)
            archive.writestr(member, content)
    return path
