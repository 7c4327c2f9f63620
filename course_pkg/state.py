"""Where the course keeps what a student did: one folder per checkout, outside the checkout."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def state_folder() -> Path:
    """Return the folder of this checkout's state: `COURSE_STATE`, or one below the user's state home."""
    if given := os.environ.get("COURSE_STATE"):
        return Path(given)
    home = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    checkout = Path(__file__).resolve().parent.parent
    return Path(home) / "ros-services-course" / hashlib.sha256(str(checkout).encode()).hexdigest()[:12]


def write_json(path: Path, data: Mapping[str, Any]) -> None:
    """Write `data` to `path` whole or not at all, so that a reader never meets half a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        draft.write_text(json.dumps(data, indent=1, sort_keys=True, ensure_ascii=False) + "\n", "utf-8")
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
