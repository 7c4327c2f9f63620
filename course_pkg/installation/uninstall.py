"""`course uninstall`: removes a shared installation, but keeps the users' own folders."""

from __future__ import annotations

import sys
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.installation.prefix import Prefix, users_of
from course_pkg.setup import Places


def uninstall(path: Path | None, *, force: bool) -> int:
    """Remove the installation in the prefix `path`, or the installation that contains this module; return 0.

    Raises SetupError, and changes nothing, if `path` contains no installation. The same happens if users work
    with it and `force` is False.
    """
    places = Places.of()
    prefix = Prefix(path or (places.checkout.parents[2] if places.installed else None))
    if not prefix.is_ours:
        raise SetupError(
            f"{prefix.path} contains no installation. With --prefix, give the folder that "
            "`course install` used."
        )
    busy = sorted(users_of(prefix.versions))
    if busy and not force:
        raise SetupError(
            f"Users work with {prefix.path} (processes {', '.join(map(str, busy))}), so "
            "nothing was removed. Wait until these users have ended `course lab`, or add "
            "--force."
        )
    try:
        prefix.remove()
    except OSError as error:
        raise SetupError(
            f"{error.filename or prefix.path} cannot be removed ({error.strerror}). Type the "
            "command with sudo."
        ) from error
    sys.stdout.write(
        f"{prefix.path} is removed. The users' own folders, such as ~/ros-course, were not removed.\n"
    )
    return 0
