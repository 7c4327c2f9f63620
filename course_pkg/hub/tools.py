"""Tools that the hub needs and that pip does not provide: the proxy program, and a test certificate."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from course_pkg.errors import HubError
from course_pkg.setup.places import Places
from course_pkg.setup.stamps import digest

DEPLOY = Path("deploy", "jupyterhub")  # This folder contains package.json and its lock file.
NPM = ("npm", "ci", "--no-audit", "--no-fund", "--loglevel=error")
CERTIFICATE_DAYS = 30


def installed_proxy(places: Places) -> Path:
    """Return the program of configurable-http-proxy. If it is missing, install it with npm first.

    Raises HubError if npm is missing or fails.
    """
    sources = [places.checkout / DEPLOY / name for name in ("package.json", "package-lock.json")]
    folder = places.tools / f"proxy-{digest(path.read_bytes() for path in sources)}"
    program = folder / "node_modules" / ".bin" / "configurable-http-proxy"
    if program.exists():
        return program
    if not shutil.which("npm"):
        raise HubError(
            "JupyterHub needs a proxy, which npm installs. As an administrator, type\n  apt-get "
            "install --no-install-recommends nodejs npm\nand start the hub again."
        )
    folder.mkdir(parents=True, exist_ok=True)
    for path in sources:
        shutil.copy(path, folder)
    _run([*NPM, "--prefix", str(folder)], "npm could not install the proxy")
    return program


def self_signed(folder: Path, address: str) -> tuple[Path, Path]:
    """Return a certificate for the address, and its key.

    If these files are missing, create them with openssl.

    Both files are in the folder `folder`.

    Raises HubError if openssl is missing or fails.
    """
    cert, key = folder / f"{digest([address])}.crt", folder / f"{digest([address])}.key"
    kind = "DNS" if address.strip(".0123456789") and ":" not in address else "IP"
    if not (cert.exists() and key.exists()):
        command = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={address}"]
        command += ["-addext", f"subjectAltName={kind}:{address}"]
        files = ["-days", str(CERTIFICATE_DAYS), "-keyout", str(key), "-out", str(cert)]
        _run([*command, *files], "openssl could not make a certificate")
        key.chmod(0o600)
    return cert, key


def _run(command: Sequence[str], failure: str) -> None:
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise HubError(
            f"{failure}: {error.strerror}. Install {command[0]}, and start the hub again."
        ) from error
    if done.returncode:
        raise HubError(f"{failure}:\n{done.stderr.strip()}")
