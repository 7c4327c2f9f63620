"""Install the Python libraries of a lock file with uv, into a virtual environment with ROS's interpreter."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from urllib.parse import urlsplit

from course_pkg.errors import SetupError
from course_pkg.setup.journal import Journal
from course_pkg.setup.places import Places
from course_pkg.setup.stamps import digest

LOCKS = Path(__file__).with_name("locks")
# A library contains this file. It would delay every start of Python by 30 ms, so the set-up deletes it.
SLOW_STARTER = "a1_coverage.pth"
PIP_TO_UV = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "trusted-host": "UV_INSECURE_HOST",
    "no-index": "UV_NO_INDEX",
    "cert": "SSL_CERT_FILE",
    "proxy": "ALL_PROXY",
}
PIP_OPTIONS = ("--quiet", "--no-deps", "--no-compile", "--only-binary=:all:", "--require-hashes")
UV_SETTINGS = {
    "UV_NO_CONFIG": "1",
    "UV_PYTHON_DOWNLOADS": "never",
    "UV_SYSTEM_CERTS": "1",
    # pip also searches all indexes for the best version. This is safe: the lock file contains hashes.
    "UV_INDEX_STRATEGY": "unsafe-best-match",
}


def lock_file(extra: str) -> Path:
    """Return the path of a lock file; `extra` is "course", "hub", "test" or "uv"."""
    return LOCKS / f"{extra}.txt"


def libraries_key(extra: str) -> str:
    """Return a hash of the lock file and the interpreter."""
    return digest([lock_file(extra).read_bytes(), base_python(), sys.version])


def environment_works(places: Places) -> bool:
    """Return whether the link to the environment's interpreter is valid."""
    return os.access(places.python, os.X_OK)


def make_environment(places: Places, extra: str, journal: Journal) -> None:
    """Create the virtual environment if it is missing, and install the libraries of the lock file `extra`.

    Libraries that the user has added to the environment are not removed. Raises SetupError if a tool fails.
    """
    uv, env = installed_uv(places, journal), uv_environment()
    if not _is_on_base(places):
        journal.run(
            [uv, "venv", "--clear", "--system-site-packages", "--python", base_python(), places.venv], env=env
        )
    # uv must not install further dependencies. The lock file lists all necessary libraries, and omits some
    # dependencies on purpose (see lock.py).
    options: list[str | Path] = ["--no-deps", "--require-hashes", "-r", lock_file(extra)]
    if env.get("UV_NO_INDEX"):  # for this setting, uv has only an option, no variable
        options.append("--no-index")
    journal.run([uv, "pip", "install", "--python", places.python, *options], env=env)
    for unwanted in places.venv.glob(f"lib/python3*/site-packages/{SLOW_STARTER}"):
        unwanted.unlink()


def uv_program(places: Places) -> Path:
    """Return the path at which uv is installed; each version of uv has its own folder."""
    return places.tools / f"uv-{digest([lock_file('uv').read_bytes()])}" / "bin" / "uv"


def installed_uv(places: Places, journal: Journal) -> Path:
    """Return the path of uv; if uv is missing, install it with pip first. Raises SetupError if pip fails."""
    uv = uv_program(places)
    if not uv.exists():
        folder = uv.parents[1]
        fresh = folder.with_name(f"{folder.name}-{places.cache.name}")
        shutil.rmtree(fresh, ignore_errors=True)
        command: list[str | Path] = [
            *pip_command(),
            "install",
            "--target",
            fresh,
            *PIP_OPTIONS,
            "-r",
            lock_file("uv"),
        ]
        journal.run(command, env=_clean_environment())
        with suppress(OSError):  # The set-up of another checkout may have installed uv in the meantime.
            fresh.rename(folder)
    return uv


def uv_environment() -> dict[str, str]:
    """Return this process's environment, with the user's pip settings as variables of uv."""
    return {**_clean_environment(), **as_uv_variables(_pip_settings(), os.environ)}


def as_uv_variables(settings: Mapping[str, list[str]], environ: Mapping[str, str]) -> dict[str, str]:
    """Convert pip's `settings` into variables of uv; omit variables that are already set in `environ`.

    uv does not read pip.conf.
    """
    variables = dict(UV_SETTINGS)
    for option, variable in PIP_TO_UV.items():
        values = [value for value in settings.get(option, []) if _exists(value)]
        if values:
            variables[variable] = ",".join(values) if option == "find-links" else " ".join(values)
    return {name: value for name, value in variables.items() if name not in environ}


def pip_command() -> list[str]:
    """Return the command that runs pip from the distribution's wheel, or from the interpreter.

    Raises SetupError if this machine has no pip.
    """
    wheels = sorted(Path("/usr/share/python-wheels").glob("pip-*.whl"))
    if wheels:
        return [sys.executable, str(wheels[-1] / "pip")]
    own = [sys.executable, "-m", "pip"]
    if subprocess.run([*own, "--version"], capture_output=True, check=False).returncode == 0:
        return own
    raise SetupError(
        f"{sys.executable} has no pip. Install the package python3-pip-whl, and start the set-up again."
    )


def _exists(place: str) -> bool:
    path = urlsplit(place).path if place.startswith("file:") else place
    return not path.startswith("/") or Path(path).exists()


def _pip_settings() -> dict[str, list[str]]:
    """Return pip's settings from its files and from the variables PIP_…; the variables have priority."""
    listing = subprocess.run(
        [*pip_command(), "config", "list"],
        capture_output=True,
        text=True,
        check=False,
        env=_clean_environment(),
    )
    settings: dict[str, list[str]] = {}
    for line in listing.stdout.splitlines():
        name, _, value = line.partition("=")
        option = name.rpartition(".")[2]
        if option in PIP_TO_UV:
            settings[option] = str(ast.literal_eval(value)).split()
    return settings


def _clean_environment() -> dict[str, str]:
    kept = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")}
    return {**kept, "PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def base_python() -> str:
    """Return the path of the interpreter that ROS was built for, the base of the virtual environment."""
    return str(os.path.realpath(sys._base_executable))  # type: ignore[attr-defined]


def _is_on_base(places: Places) -> bool:
    """Return whether the environment was created in this folder and with the current interpreter."""
    if not environment_works(places):
        return False
    program = "import os, sys; print(os.path.realpath(sys._base_executable), sys.version, sys.prefix)"
    answer = subprocess.run([places.python, "-I", "-c", program], capture_output=True, text=True, check=False)
    return answer.stdout.strip() == f"{base_python()} {sys.version} {places.venv}"
