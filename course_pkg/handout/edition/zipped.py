"""The zip file of an edition. The bytes of the zip depend only on the files in it."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping
from pathlib import Path

from course_pkg.errors import HandoutError
from course_pkg.files import write_atomically
from course_pkg.handout.edition.contents import File

MARK = b"made by course release"  # This text is the comment of the zip file.
# Each file in the zip has this time; an unchanged edition therefore gives an unchanged zip.
TIME = (2000, 1, 1, 0, 0, 0)


def zip_path(folder: Path) -> Path:
    """Return the path of the zip, which is next to the folder of the edition.

    Raises HandoutError if the zip exists and was not written by a release.
    """
    path = folder.with_name(f"{folder.name}.zip")
    if path.exists() and not _is_ours(path):
        raise HandoutError(
            f"Nothing was written, because {path} exists and `course release` did not create it. "
            "Move this file, or give another folder."
        )
    return path


def write_zip(path: Path, folder: str, files: Mapping[str, File]) -> None:
    """Write the given files to the zip at the path `path`.

    In the zip, the files are in a folder with the name `folder`; if `folder` is "", the files are not in a
    folder.
    """
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.comment = MARK
        for name, file in files.items():
            entry = zipfile.ZipInfo(f"{folder}/{name}" if folder else name, TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # The value 3 means Unix; with this value, unzip sets the permissions.
            entry.external_attr = (0o100755 if file.executable else 0o100644) << 16
            archive.writestr(entry, file.content)
    try:
        write_atomically(path, buffer.getvalue())
    except OSError as error:
        raise HandoutError(f"{path} cannot be written ({error.strerror}). Give another folder.") from error


def _is_ours(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as archive:
            return archive.comment == MARK
    except (OSError, zipfile.BadZipFile):
        return False
