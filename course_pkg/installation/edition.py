"""The students' edition that is installed: the files of this checkout, or the files of a new release."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.setup.edition import RECORD


@contextmanager
def students_edition(checkout: Path) -> Iterator[Path]:
    """Yield a folder with the students' edition: `checkout`, or a temporary folder made by `course release`.

    Raises SetupError if `course release` fails.
    """
    if (checkout / RECORD).is_file():
        yield checkout
        return
    with tempfile.TemporaryDirectory(prefix="course-edition-") as folder:
        edition = Path(folder) / "course"
        command = [str(checkout / "course"), "release", str(edition)]
        if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode:
            raise SetupError(
                "`course release` could not write the students' edition. Read the messages above."
            )
        yield edition


def edition_files(edition: Path) -> list[str]:
    """Return the paths of all files of the students' edition, relative to the folder `edition`."""
    return [str(name) for name in json.loads((edition / RECORD).read_text("utf-8"))["files"]]
