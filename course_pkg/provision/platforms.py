"""What to install where: platforms.json, read for the machine that this runs on."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

from course_pkg.errors import SetupError

DATA = Path(__file__).with_name("platforms.json")
OS_RELEASE = Path("/etc/os-release")


class Platform(NamedTuple):
    """A distribution that has ROS 1, with the packages that it takes."""

    name: str
    bootstrap: tuple[str, ...]
    course: tuple[str, ...]
    grade: tuple[str, ...]
    test: tuple[str, ...]


def read_platform(checkout: Path, os_release: Path = OS_RELEASE) -> Platform:
    """Return the platform that `os_release` names; derivatives name the one that they are built on."""
    data = json.loads(DATA.read_text())
    release = _read_release(os_release)
    for key in ("DEBIAN_CODENAME", "UBUNTU_CODENAME", "VERSION_CODENAME"):
        entry = data["distributions"].get(release.get(key))
        if entry:
            return Platform(
                entry["name"],
                tuple(data["bootstrap"]),
                (*data["course"], *entry["course"]),
                tuple(data["grade"]),
                (*data["grade"], *entry["test"]),
            )
    names = ", ".join(entry["name"] for entry in data["distributions"].values())
    raise SetupError(
        f"ROS 1 comes with {names}; this is {release.get('PRETTY_NAME', 'another system')}. "
        "Use conda here:\n"
        f"  conda env create -f {checkout / 'environment.yml'}\n"
        "  conda activate ros-services-course\n"
        "and start again."
    )


def _read_release(path: Path) -> dict[str, str]:
    try:
        lines = path.read_text().splitlines()
    except OSError:
        return {}
    pairs = (line.split("=", 1) for line in lines if "=" in line)
    return {key: value.strip("\"'") for key, value in pairs}
