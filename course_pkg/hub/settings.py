"""What `course hub` tells the hub's configuration and the students' servers: one file of JSON."""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path

from course_pkg.hub.passwords import write_private

VARIABLE = "COURSE_HUB_SETTINGS"  # the path of the file
SCRATCH = "COURSE_HUB_SCRATCH"  # the folder in which each student's server creates one for temporary files
FOLDER = "ros-course"  # the course's folder in each home folder


@dataclass(frozen=True)
class Settings:
    """The settings of one hub; `url` is where browsers find it. Paths are absolute."""

    state: str  # the folder of the hub's data, readable only by the hub
    released: str  # the git repository with the released notebooks
    proxy: str  # the program of the proxy
    url: str
    hub_port: int
    proxy_port: int
    students: tuple[str, ...]
    teacher: str
    homes: str  # the folder of the home folders if the students have no accounts, otherwise ""
    memory: int  # MiB
    processes: int
    class_port: int  # of the class view; 0 without it
    cert: str = ""
    key: str = ""
    environment: dict[str, str] = field(default_factory=dict)  # of the students' servers

    def write(self) -> Path:
        """Write the file, and return its path."""
        path = Path(self.state) / "settings.json"
        write_private(path, json.dumps(asdict(self), indent=1))
        return path

    @classmethod
    def read(cls) -> Settings:
        """Return the settings in the file that the variable COURSE_HUB_SETTINGS names."""
        data = json.loads(Path(os.environ[VARIABLE]).read_text())
        return cls(**{**data, "students": tuple(data["students"])})
