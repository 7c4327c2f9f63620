"""uv, which installs the libraries: how it comes here, and how it hears of the user's settings for pip."""

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
from course_pkg.provision.journal import Journal
from course_pkg.provision.places import Places
from course_pkg.provision.python import lock_file
from course_pkg.provision.stamps import digest

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
    "UV_INDEX_STRATEGY": "unsafe-best-match",  # as pip does; the hashes of the lock keep it safe
}


def uv_program(places: Places) -> Path:
    """Return where uv lies once it is installed; each version has a folder of its own."""
    return places.tools / f"uv-{digest([lock_file('uv').read_bytes()])}" / "bin" / "uv"


def installed_uv(places: Places, journal: Journal) -> Path:
    """Return uv, installed by pip if it is not there yet."""
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
        with suppress(OSError):  # the set-up of another checkout may have been first
            fresh.rename(folder)
    return uv


def uv_environment() -> dict[str, str]:
    """Return this process's environment, with the user's settings for pip in the words of uv."""
    return {**_clean_environment(), **in_words_of_uv(_pip_settings(), os.environ)}


def in_words_of_uv(settings: Mapping[str, list[str]], environ: Mapping[str, str]) -> dict[str, str]:
    """Return variables that give uv pip's `settings`: it reads no pip.conf. What `environ` sets stands."""
    words = dict(UV_SETTINGS)
    for option, variable in PIP_TO_UV.items():
        values = [value for value in settings.get(option, []) if _exists(value)]
        if values:
            words[variable] = ",".join(values) if option == "find-links" else " ".join(values)
    return {name: value for name, value in words.items() if name not in environ}


def pip_command() -> list[str]:
    """Return a pip that needs no installing: the distribution's wheel of it, or the interpreter's own."""
    wheels = sorted(Path("/usr/share/python-wheels").glob("pip-*.whl"))
    if wheels:
        return [sys.executable, str(wheels[-1] / "pip")]
    own = [sys.executable, "-m", "pip"]
    if subprocess.run([*own, "--version"], capture_output=True, check=False).returncode == 0:
        return own
    raise SetupError(f"{sys.executable} has no pip. Install the package python3-pip-whl, and start again.")


def _exists(place: str) -> bool:
    path = urlsplit(place).path if place.startswith("file:") else place
    return not path.startswith("/") or Path(path).exists()


def _pip_settings() -> dict[str, list[str]]:
    """Return pip's settings, from its files and from PIP_… alike; the latter come last and win."""
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
