"""Copy the notebooks of a shared installation to a user's own folder without overwriting the user's work."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.files import write_atomically
from course_pkg.setup.places import Places
from course_pkg.setup.stamps import digest

FOLDERS = ("notebooks", "figures")
# For each delivered file, this file contains the hash of the newest version that the user has received.
DELIVERED = "delivered.json"


def make_own_files(places: Places) -> None:
    """Create the user's own folder, or add the new files of an upgrade; do nothing in a checkout.

    A file that the user has not changed is replaced with the new version. A file that the user has changed is
    not replaced; a message contains the name of this file. A file that the user has deleted is copied again.
    Raises SetupError if the folder cannot be written.
    """
    if not places.installed:
        return
    record = places.own_data / DELIVERED
    try:
        before = _read(record)
        delivered = dict(before)
        kept = [path for path in _released(places.checkout) if not _deliver(places, path, delivered)]
        if delivered != before:
            write_atomically(record, json.dumps(delivered, indent=1))
    except OSError as error:
        raise SetupError(
            f"The course cannot write to your folder {places.own} ({error.strerror}). Delete files if your "
            "disk is full. If you have no home folder, set COURSE_HOME to a folder that you can write to."
        ) from error
    if kept:
        sys.stderr.write(
            f"There is a new version of {', '.join(kept)}. Your version contains your work, so the file was "
            "not changed. To get the new version, rename your version, and start the course again.\n"
        )


def _released(checkout: Path) -> list[str]:
    found = (path for folder in FOLDERS for path in (checkout / folder).rglob("*") if path.is_file())
    return sorted(str(path.relative_to(checkout)) for path in found)


def _deliver(places: Places, name: str, delivered: dict[str, str]) -> bool:
    """Copy the file `name` if the user has no changed copy.

    If the user has changed the file and there is a new version, return False; the caller then shows a
    message.
    """
    content, own = (places.checkout / name).read_bytes(), places.own / name
    fresh, last = digest([content]), delivered.get(name)
    present = digest([own.read_bytes()]) if own.exists() else None
    delivered[name] = fresh
    if present in (None, last) and present != fresh:
        write_atomically(own, content)
        return True
    return present == fresh or last == fresh


def _read(record: Path) -> dict[str, str]:
    try:
        found = json.loads(record.read_text())
    except (FileNotFoundError, ValueError):
        return {}
    return {str(name): str(value) for name, value in found.items()} if isinstance(found, dict) else {}
