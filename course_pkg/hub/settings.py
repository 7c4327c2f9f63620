"""The JSON file with the settings that `course hub` passes to the hub and to the students' servers."""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path

from course_pkg.hub.passwords import write_private

VARIABLE = "COURSE_HUB_SETTINGS"  # This environment variable contains the path of the settings file.
# This environment variable contains a folder; in it, each student's server creates a folder for temporary
# files.
SCRATCH = "COURSE_HUB_SCRATCH"
FOLDER = "ros-course"  # the course's folder in each home folder


@dataclass(frozen=True)
class Settings:
    """The settings of one hub; `url` is the hub's address for browsers. Paths are absolute."""

    state: str  # the folder of the hub's data, readable only by the hub
    released: str  # the git repository with the released notebooks
    proxy: str  # the path of the proxy program
    url: str
    hub_port: int
    proxy_port: int
    students: tuple[str, ...]
    teacher: str
    homes: str  # the folder of the home folders if the students have no accounts, otherwise ""
    memory: int  # The memory is in MiB.
    processes: int
    class_port: int  # the port of the class view, or 0 without a class view
    cert: str = ""
    key: str = ""
    # environment variables that the hub sets in the students' servers
    environment: dict[str, str] = field(default_factory=dict)

    def write(self) -> Path:
        """Write the file, and return its path."""
        path = Path(self.state) / "settings.json"
        write_private(path, json.dumps(asdict(self), indent=1))
        return path

    @classmethod
    def read(cls) -> Settings:
        """Return the settings in the file at the path in the variable COURSE_HUB_SETTINGS."""
        data = json.loads(Path(os.environ[VARIABLE]).read_text())
        return cls(**{**data, "students": tuple(data["students"])})
