"""The step that makes the virtual environment, on the interpreter that ROS was built for."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

from course_pkg.errors import SetupError
from course_pkg.provision.journal import Journal
from course_pkg.provision.places import Places
from course_pkg.provision.stamps import digest

LOCKS = Path(__file__).with_name("locks")
PIP_TO_UV = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "trusted-host": "UV_INSECURE_HOST",
    "no-index": "UV_NO_INDEX",
    "cert": "SSL_CERT_FILE",
    "proxy": "ALL_PROXY",
}


def lock_file(extra: str) -> Path:
    """Return the pinned requirements of `extra`: "course", "test" or "uv"."""
    return LOCKS / f"{extra}.txt"


def python_key(extra: str) -> str:
    """Return what the environment is made from: the lock, and the interpreter under it."""
    base = os.path.realpath(sys._base_executable)  # type: ignore[attr-defined]
    return digest([lock_file(extra).read_bytes(), base, sys.version])


def python_intact(places: Places) -> bool:
    """Say whether the environment's interpreter still leads to one that exists."""
    return os.access(places.python, os.X_OK)


def make_environment(places: Places, extra: str, journal: Journal) -> None:
    """Make the virtual environment where it is missing, and install what the lock of `extra` names."""
    uv = _installed_uv(places, journal)
    env = uv_environment(_pip_settings(_pip_command()))
    if not places.conda and not _same_base(places):
        base = sys._base_executable  # type: ignore[attr-defined]
        journal.run([uv, "venv", "--clear", "--system-site-packages", "--python", base, places.venv], env=env)
    journal.run(
        [uv, "pip", "install", "--python", places.python, "--require-hashes", "-r", lock_file(extra)], env=env
    )


def uv_environment(settings: dict[str, list[str]]) -> dict[str, str]:
    """Return this process's environment with pip's `settings` in the words of uv, which reads no pip.conf."""
    env = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")}
    env.setdefault("UV_PYTHON_DOWNLOADS", "never")
    env.setdefault("UV_NO_CONFIG", "1")
    env.setdefault("UV_LINK_MODE", "hardlink")
    env.setdefault("UV_SYSTEM_CERTS", "1")
    env.setdefault("UV_INDEX_STRATEGY", "unsafe-best-match")  # as pip does; the hashes keep it safe
    for option, variable in PIP_TO_UV.items():
        values = [value for value in settings.get(option, []) if _reachable(value)]
        if values and variable not in env:
            env[variable] = ",".join(values) if option == "find-links" else " ".join(values)
    return env


def _reachable(place: str) -> bool:
    path = urlsplit(place).path if place.startswith("file:") else place
    return not path.startswith("/") or Path(path).exists()


def _same_base(places: Places) -> bool:
    if not python_intact(places):
        return False
    question = "import sys; print(sys._base_executable, sys.version, sys.prefix)"
    answer = subprocess.run([places.python, "-I", "-c", question], capture_output=True, text=True, check=False)
    base = sys._base_executable  # type: ignore[attr-defined]
    return answer.stdout.strip() == f"{base} {sys.version} {places.venv}"


def uv_program(places: Places) -> Path:
    """Return where uv lies once it is installed; each version has a folder of its own."""
    return places.tools / f"uv-{digest([lock_file('uv').read_bytes()])}" / "bin" / "uv"


def _installed_uv(places: Places, journal: Journal) -> Path:
    uv = uv_program(places)
    if not uv.exists():
        folder = uv.parents[1]
        fresh = folder.with_name(f"{folder.name}.{os.getpid()}")
        options = ["--target", fresh, "--no-deps", "--only-binary=:all:", "--require-hashes", "--no-compile"]
        journal.run([*_pip_command(), "install", "--quiet", *options, "-r", lock_file("uv")], env=_clean_environment())
        fresh.rename(folder)
    return uv


def _pip_command() -> list[str]:
    """Return a pip that needs no installing: the interpreter's own, or the distribution's wheel of it."""
    wheels = sorted(Path("/usr/share/python-wheels").glob("pip-*.whl"))
    if wheels:
        return [sys.executable, str(wheels[-1] / "pip")]
    own = [sys.executable, "-m", "pip"]
    if subprocess.run([*own, "--version"], capture_output=True, check=False).returncode == 0:
        return own
    raise SetupError(f"{sys.executable} has no pip. Install the package python3-pip-whl, and start again.")


def _pip_settings(pip: list[str]) -> dict[str, list[str]]:
    """Return pip's settings, from its files and from PIP_… alike; the latter come last and win."""
    listing = subprocess.run(
        [*pip, "config", "list"], capture_output=True, text=True, check=False, env=_clean_environment()
    )
    settings: dict[str, list[str]] = {}
    for line in listing.stdout.splitlines():
        name, _, value = line.partition("=")
        option = name.rpartition(".")[2]
        if option in PIP_TO_UV:
            settings[option] = str(ast.literal_eval(value)).split()
    return settings


def _clean_environment() -> dict[str, str]:
    return {
        **{name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")},
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
    }
