"""Tests of `course hub`: a student logs in and works in a hub, and no process remains at the end."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from course_pkg.hub.settings import SCRATCH
from tests.hub.running import arguments, hub, passwords, refusal
from tests.hub.student import Student
from tests.lab.commands import all_gone, below

RIGHT = """
def handle_geometry(request):
    return geometryResponse(
        area=request.width * request.length, volume=request.width * request.length * request.height
    )
rospy.Service("/getGeometry", geometry, handle_geometry)
"""
IMPORTS = """
import rospy
from course_pkg import check, join
from course_pkg.srv import geometry, geometryResponse
join("chapter_05")
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the hub."""
    return tmp_path_factory.mktemp("hub")


def temporary_folder(folder: Path) -> Path:
    """Return the folder for temporary files of a hub."""
    settings = json.loads((folder / "hub" / "private" / "settings.json").read_text())
    return Path(settings["environment"][SCRATCH])


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    """Run a hub for the tests of this module. Then kill the hub, and assert that no process remains."""
    with hub(folder, ["anna", "ben"]) as (process, address):
        yield address
        family = below(process)
        temporary = temporary_folder(folder)
        assert temporary.is_dir()
        process.kill()
        assert family
        assert all_gone(family)
        assert not temporary.exists()


def test_a_student_logs_in_once_and_passes_a_check(address: str, folder: Path) -> None:
    """The password can be used only once; the server has the released notebooks.

    In a kernel of the student's server, a check passes.
    """
    password = passwords(folder)["anna"]
    with Student(address, "anna") as anna:
        assert not anna.log_in("wrong")
        assert anna.log_in(password)
        anna.start_server()
        notebook = anna.open_notebook("notebooks/05_write_a_server.ipynb")
        assert any("Write a server" in "".join(cell["source"]) for cell in notebook["cells"])
        anna.run(IMPORTS)
        anna.run(RIGHT)
        assert "05.1 passed" in anna.run('check("05.1")')[0]
    with Student(address, "anna") as other:
        assert not other.log_in(password)


def test_passwords_are_for_the_teacher_only(address: str, folder: Path) -> None:
    """Only the hub's owner can read the folder with the passwords."""
    private = folder / "hub" / "private"
    assert private.stat().st_mode & 0o777 == 0o700
    assert (private / "passwords.csv").stat().st_mode & 0o777 == 0o600


def test_a_second_hub_is_refused(address: str, folder: Path) -> None:
    """Two hubs cannot use the same folder for their data."""
    assert "Another hub" in refusal(*arguments(folder, ["anna"])[1:])


@pytest.mark.parametrize(
    ("names", "options", "message"),
    [
        (["Zoë"], [], "'Zoë'"),
        (["anna.berg"], [], "These names cannot be names of accounts"),
        (["anna"], ["--cert", "missing.pem"], "The options --cert and --key belong together"),
        (["anna"], ["--ip", "somewhere"], "is not an IP address"),
    ],
)
def test_wrong_options_are_refused(
    tmp_path: Path, names: list[str], options: list[str], message: str
) -> None:
    """A wrong option causes one error message with the reason, and no hub starts."""
    assert message in refusal(*arguments(tmp_path, names)[1:], *options)
