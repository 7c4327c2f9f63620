"""`course bundle`: writes an installer for machines without internet.

The installer works only on machines with the same distribution and the same type of processor as this
machine.

The installer is a folder with `course` (the students' edition), `packages` (all .deb files that a minimal
system needs, with an index for apt), `wheels` (the Python libraries) and `install.sh`.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from course_pkg.errors import SetupError
from course_pkg.installation.edition import edition_files, students_edition
from course_pkg.setup import Places, packages
from course_pkg.setup.libraries import lock_file, pip_command
from course_pkg.setup.progress import Progress

SCRIPT = """\
#!/bin/sh
# Installs the course from this folder, without internet: sudo sh install.sh [--prefix DIR] [--bin DIR]
set -eu
here=$(cd -- "$(dirname -- "$0")" && pwd)
if [ "$(id -u)" -ne 0 ]; then
    echo "install.sh: only root can install packages. Type: sudo sh $here/install.sh" >&2
    exit 1
fi
case $here in *[[:space:]]*)
    echo "install.sh: apt cannot read $here, because the name contains a space. Move the folder." >&2
    exit 1 ;;
esac
temporary=$(mktemp -d)
trap 'rm -rf -- "$temporary"' EXIT
chmod 755 "$temporary"
mkdir -p "$temporary/lists/partial" "$temporary/archives/partial"
echo "deb [trusted=yes] file:$here/packages ./" >"$temporary/sources.list"
# The options let apt read only the packages of this folder.
offline() {
    DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -o Dir::Etc::SourceList="$temporary/sources.list" \\
        -o Dir::Etc::SourceParts=- -o Dir::State::Lists="$temporary/lists" \\
        -o Dir::Cache::Archives="$temporary/archives" -o APT::Sandbox::User=root -qq "$@"
}
offline update
offline install --yes --no-install-recommends @PACKAGES@
PIP_NO_INDEX=1 PIP_FIND_LINKS="$here/wheels" "$here/course/course" install "$@"
"""


def write_bundle(out: Path) -> int:
    """Write the installer to the folder `out`, print its size, and return 0.

    Raises SetupError if `out` contains files, or if a download fails.
    """
    places = Places.of()
    platform = packages.read_platform(places.checkout)
    out = Path(os.path.abspath(out.expanduser()))
    if out.exists() and not (out.is_dir() and not any(out.iterdir())):
        raise SetupError(f"{out} exists and is not an empty folder, so nothing was written.")
    progress = Progress()
    names = ["python3", *platform.bootstrap, *platform.course]
    try:
        out.mkdir(parents=True, exist_ok=True)
        with students_edition(places.checkout) as edition:
            _copy(edition, out / "course")
        with progress.step("wheels"):
            _download_wheels(out / "wheels")
        with progress.step("packages"):
            _download_packages(names, out / "packages")
            (out / "packages" / "Packages").write_text(package_index(out / "packages"))
    except OSError as error:
        raise SetupError(f"{error.filename or out} cannot be written ({error.strerror}).") from error
    (out / "install.sh").write_text(install_script(names))
    size = sum(path.stat().st_size for path in out.rglob("*") if path.is_file()) >> 20
    sys.stdout.write(
        f"{out} ({size} MB) installs the course on {platform.name} without internet. Copy the folder to the "
        "other machine, and type in the copied folder:\n  sudo sh install.sh\n"
    )
    return 0


def install_script(names: Sequence[str]) -> str:
    """Return the script that installs the packages `names` and then the course."""
    return SCRIPT.replace("@PACKAGES@", " ".join(names))


def package_index(folder: Path) -> str:
    """Return apt's index of the .deb files in this folder; see the Debian wiki, "DebianRepository/Format"."""
    return "\n".join(_entry(path) for path in sorted(folder.glob("*.deb")))


def _entry(path: Path) -> str:
    fields = _output(["dpkg-deb", "--field", str(path)])
    with path.open("rb") as file:
        checksum = hashlib.sha256()
        while block := file.read(1 << 20):
            checksum.update(block)
    return (
        f"{fields.rstrip()}\nFilename: ./{path.name}\nSize: {path.stat().st_size}\n"
        f"SHA256: {checksum.hexdigest()}\n"
    )


def _copy(edition: Path, folder: Path) -> None:
    for name in edition_files(edition):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(edition / name, folder / name)


def _download_wheels(folder: Path) -> None:
    for extra in ("uv", "course"):
        options = ["--quiet", "--no-deps", "--only-binary=:all:", "--require-hashes", "--dest", str(folder)]
        _output([*pip_command(), "download", *options, "-r", str(lock_file(extra))])


def _download_packages(names: Sequence[str], folder: Path) -> None:
    """Download the packages and all packages that they need on a system without any installed package."""
    (folder / "partial").mkdir(parents=True)
    with tempfile.NamedTemporaryFile(prefix="course-status-") as empty:
        options = {
            "Dir::State::status": empty.name,
            "Dir::Cache::archives": str(folder),
            "Debug::NoLocking": "1",
            "APT::Sandbox::User": "root",
        }
        given = [word for name, value in options.items() for word in ("-o", f"{name}={value}")]
        _output(
            [
                packages.APT,
                *("install", "--download-only", "--yes", "--no-install-recommends", "-qq", *given, *names),
            ]
        )
    shutil.rmtree(folder / "partial")


def _output(command: Sequence[str]) -> str:
    """Run a command and return its output; if it fails, raise SetupError with the end of its messages."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode:
        end = "\n".join(f"  {line}" for line in done.stderr.splitlines()[-8:])
        raise SetupError(f"`{Path(command[0]).name}` ended with status {done.returncode}:\n{end}")
    return done.stdout
