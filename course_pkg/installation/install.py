"""`course install`: installs the course for all users of this machine."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

from course_pkg.errors import SetupError
from course_pkg.files import write_atomically
from course_pkg.installation.edition import edition_files, students_edition
from course_pkg.installation.prefix import COMPLETION, Prefix
from course_pkg.installed import RECORD
from course_pkg.setup import Places, ensure
from course_pkg.setup.libraries import base_python
from course_pkg.setup.places import BUILT
from course_pkg.setup.progress import Progress
from course_pkg.setup.stamps import digest, locked


def install(path: Path | None, bin_folder: Path | None) -> int:
    """Install this course in the prefix `path`, make it the current version, and return 0.

    Versions that no process uses are removed, except the previous version. Raises SetupError if the
    installation fails; in this case, the current version does not change.
    """
    source = Places.of()
    if source.conda:
        raise SetupError(
            "`course install` needs ROS from Debian or Ubuntu. First leave the conda "
            "environment with `conda deactivate`."
        )
    os.umask(0o022)  # all users must be able to read the files
    prefix = Prefix(path, bin_folder)
    try:
        prefix.claim()
        with locked(
            prefix.path / "lock",
            lambda: _say(
                "Another installation is running. This installation waits until the other installation ends."
            ),
        ):
            with students_edition(source.checkout) as edition:
                version = prefix.versions / _version_id(edition)
                if version not in prefix.complete():
                    _make(version, edition)
            last = prefix.current.resolve()
            prefix.switch(version)
            busy = prefix.remove_unused({version, last})
    except OSError as error:
        raise _explained(error, prefix) from error
    _report(prefix, version, busy)
    return 0


def _version_id(edition: Path) -> str:
    """Return a name that depends on the edition's files and on the interpreter."""
    number = ElementTree.parse(edition / "package.xml").findtext("version")  # noqa: S314 -- our own file
    contents = [each for name in edition_files(edition) for each in (name, (edition / name).read_bytes())]
    return f"{number}-{digest([*contents, base_python(), sys.version])[:8]}"


def _make(version: Path, edition: Path) -> None:
    """Build a version.

    The file installation.json is written last. If the build fails, everything except the log is deleted.
    """
    places = Places(version / "course", version / BUILT)
    shutil.rmtree(version, ignore_errors=True)
    # uv has to copy files. If uv made hard links to its cache, the owner of the cache could change the
    # installation.
    os.environ["UV_LINK_MODE"] = "copy"
    try:
        for name in edition_files(edition):
            (places.checkout / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(edition / name, places.checkout / name)
        ensure(places)
        with Progress().step("compiled Python files"):
            _compile(places)
        completion = subprocess.run(
            [places.checkout / "course", "completion"], stdout=subprocess.PIPE, check=True
        )
        write_atomically(version / COMPLETION, completion.stdout)
        shutil.rmtree(places.tools, ignore_errors=True)
        subprocess.run(["chmod", "-R", "a+rX,go-w", version], check=True)
        write_atomically(version / RECORD, json.dumps({"python": sys.version}))
    except BaseException:
        for folder in (places.checkout, places.venv, places.workspace, places.tools):
            shutil.rmtree(folder, ignore_errors=True)
        raise


def _compile(places: Places) -> None:
    """Compile all modules.

    Users cannot write to the installation, so Python could not store compiled modules and would compile them
    at each start.
    """
    folders = [places.checkout / "course_pkg", places.venv / "lib", places.workspace / "devel" / "lib"]
    # The exit status of compileall is ignored, because some libraries contain files that this version of
    # Python cannot compile.
    subprocess.run([places.python, "-m", "compileall", "-qq", "-j", "0", *folders], check=False)


def _explained(error: OSError, prefix: Prefix) -> SetupError:
    if error.errno == errno.ENOSPC:
        return SetupError(
            f"The disk of {prefix.path} is full. Delete files that you do not need, and start again."
        )
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return SetupError(
            f"{error.filename or prefix.path} cannot be written ({error.strerror}). Use sudo,"
            " or give --prefix and --bin folders that you can write to."
        )
    return SetupError(f"The installation stopped: {error}. Correct the cause, and start again.")


def _say(text: str) -> None:
    sys.stderr.write(f"{text}\n")


def _report(prefix: Prefix, version: Path, busy: list[Path]) -> None:
    sys.stdout.write(
        f"Version {version.name} is installed in {prefix.path}.\n"
        f"Every user of this machine can type `course lab` ({prefix.bin / 'course'}).\n"
    )
    closed = [each for each in (prefix.path, *prefix.path.parents) if not each.stat().st_mode & 0o001]
    if closed:
        sys.stdout.write(f"Other users cannot open {closed[-1]}, so only you can use this installation.\n")
    if str(prefix.bin) not in os.environ.get("PATH", "").split(os.pathsep):
        sys.stdout.write(f"Add the folder {prefix.bin} to your PATH.\n")
    for old in busy:
        sys.stdout.write(
            f"Version {old.name} is still in use. The next `course install` removes this version.\n"
        )
