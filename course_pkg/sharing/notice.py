"""The notice in the notebook which says that the teacher receives the results of checks."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import urlsplit

from course_pkg.state import state_folder, write_json

ADDRESS = "COURSE_CLASS_URL"
FILE = "class.json"
SHOWN = "COURSE_CLASS_NOTICE_SHOWN"  # a variable of the kernel's environment, set after the notice was shown


def address() -> str:
    """Return the address of the class service, without a slash at its end, or "" if sharing is off."""
    return os.environ.get(ADDRESS, "").strip().rstrip("/")


def keep_about(folder: Path, url: str, about: Mapping[str, object]) -> None:
    """Store the data for the notice in the folder `folder`; `about` is the response of the service at `url`.

    Raises OSError if the file cannot be written.
    """
    teacher, days = about.get("teacher"), about.get("days")
    write_json(folder / FILE, {"url": url, "teacher": str(teacher)[:100], "days": days})


def notice() -> str:
    """At the first call in this process, return the notice; later, return "".

    If sharing is off, return "".
    """
    url = address()
    if not url or os.environ.get(SHOWN) == str(os.getpid()):
        return ""
    os.environ[SHOWN] = str(os.getpid())
    about = _about(url)
    teacher = about.get("teacher") or "your teacher"
    days = about.get("days")
    deleted = (
        f" The results are deleted {days:g} days after your last result."
        if isinstance(days, (int, float))
        else ""
    )
    return (
        f"The results of your checks are shared with {teacher} ({urlsplit(url).hostname}): the "
        "part, the result, the time and the hint, but not your code. The results are never a "
        f"grade.{deleted}"
    )


def _about(url: str) -> dict[str, object]:
    try:
        data = json.loads((state_folder() / FILE).read_text("utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return data if isinstance(data, dict) and data.get("url") == url else {}
