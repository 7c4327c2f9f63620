"""Writes the collected work of a student, in the layout that `course grade` reads.

SUBMISSIONS/<student>/NN_topic.ipynb
SUBMISSIONS/<student>/<package>/package.xml

Each notebook and each whole package is replaced in one step. A reader therefore never sees a mixture of old
and new files.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from pathlib import Path

from course_pkg.files import write_atomically
from course_pkg.handout.homes.work import WorkFile


def store(folder: Path, files: Sequence[WorkFile]) -> None:
    """Write the work of one student to the folder `folder`; each file keeps its modification time.

    Other notebooks and packages in the folder are not changed. Raises OSError if a file cannot be written.
    """
    for draft in folder.glob(".*.collecting"):  # An earlier collection was killed and left this folder.
        shutil.rmtree(draft, ignore_errors=True)
    for file in (each for each in files if not each.package):
        write_atomically(folder / file.path, file.content)
        os.utime(folder / file.path, ns=(file.modified, file.modified))
    for package in dict.fromkeys(file.package for file in files if file.package):
        _store_package(folder / package, [file for file in files if file.package == package])


def _store_package(folder: Path, files: Sequence[WorkFile]) -> None:
    draft = folder.with_name(f".{folder.name}.new.collecting")
    former = folder.with_name(f".{folder.name}.old.collecting")
    for file in files:
        path = draft / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(file.content)
        path.chmod(0o700 if file.executable else 0o600)
        os.utime(path, ns=(file.modified, file.modified))
    if folder.exists():
        folder.rename(former)
    draft.rename(folder)
    shutil.rmtree(former, ignore_errors=True)
