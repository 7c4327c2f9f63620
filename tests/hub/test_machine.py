"""Tests of a hub on a machine without private networks, free disk space or a student's home folder."""

from __future__ import annotations

import os
import pwd
import socket
import ssl
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.hub.accounts import home_problems
from course_pkg.hub.start import data_folder, reached_at
from course_pkg.hub.tools import self_signed
from course_pkg.installed import RECORD
from course_pkg.setup import Places
from tests.hub.running import hub, passwords
from tests.hub.student import Student
from tests.support import terminal

# This script runs in new namespaces, so it does not change the limits and mounts of the machine.
POOR = """
echo 0 > /proc/sys/user/max_user_namespaces
echo 0 > /proc/sys/user/max_net_namespaces
mkdir -p "$HOMES/full" && mount -t tmpfs -o size=10m none "$HOMES/full" || exit
exec "$0" "$@"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the hub."""
    return tmp_path_factory.mktemp("hub")


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    """Run a hub with TLS on a machine that forbids namespaces.

    The disk of one student's home folder is full.
    """
    if problem := terminal("unshare", "-Urm", "true").stderr:
        pytest.skip(f"this machine allows no user namespaces: {problem}")
    cert, key = self_signed(folder, "127.0.0.1")
    (folder / "hub.pem").symlink_to(cert)
    before = ("env", f"HOMES={folder / 'homes'}", "unshare", "-Urm", "sh", "-c", POOR)
    files = ("--cert", str(cert), "--key", str(key))
    with hub(folder, ["anna", "full"], *files, before=before) as (process, address):
        yield address
        process.kill()


def test_a_server_starts_where_namespaces_are_forbidden(address: str, folder: Path) -> None:
    """The student can work, and the log says that other users can reach the student's nodes.

    The address of the hub begins with https://.
    """
    assert address.startswith("https://")
    with Student(address, "anna", folder / "hub.pem") as anna:
        assert anna.log_in(passwords(folder)["anna"])
        anna.start_server()
    log = (folder / "hub" / "private" / "hub.log").read_text()
    assert "This computer allows no private network" in log


def test_a_full_disk_is_named_on_the_students_page(address: str, folder: Path) -> None:
    """The server of a student without disk space does not start, and the page shows the reason."""
    with Student(address, "full", folder / "hub.pem") as student:
        assert student.log_in(passwords(folder)["full"])
        page = student.refused_server()
    assert f"the disk of {folder / 'homes' / 'full'} is full" in page


def test_a_missing_home_is_reported_for_this_student_only() -> None:
    """If an account has no home folder, such as `nobody` on Debian, the program reports a problem.

    The account that runs this test has a home folder, so the program does not report this account.
    """
    missing = next(each for each in pwd.getpwall() if not os.path.exists(each.pw_dir))
    own = pwd.getpwuid(os.getuid()).pw_name
    (problem,) = home_problems([own, missing.pw_name])
    assert f"The student {missing.pw_name} cannot use the hub" in problem


def test_a_shared_installation_keeps_the_passwords(tmp_path: Path) -> None:
    """The hub's folder is outside the version folders, because an upgrade deletes the old version folder."""
    version = tmp_path / "versions" / "1"
    version.mkdir(parents=True)
    (version / RECORD).touch()
    places = Places.of(version / "course")
    assert data_folder(places, None) == tmp_path / "hub"


def test_a_certificate_is_for_the_name_that_students_type(tmp_path: Path) -> None:
    """The certificate contains the machine's name as a subjectAltName.

    If a hub listens on 0.0.0.0, students use the machine's name in the hub's URL.
    """
    assert reached_at("127.0.0.1") == "127.0.0.1"
    assert reached_at("0.0.0.0") == socket.getfqdn()  # noqa: S104 -- no server listens here
    cert, key = self_signed(tmp_path, "hub.example")
    ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(cert, key)
    assert "DNS:hub.example" in terminal("openssl", "x509", "-noout", "-text", "-in", str(cert)).stdout
