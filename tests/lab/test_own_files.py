"""Tests of the folder that each user of a shared installation has."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.errors import SetupError
from course_pkg.installed import DATA, RECORD
from course_pkg.lab.own_files import make_own_files
from course_pkg.setup import Places
from tests.installation.installations import asked, make_version


@pytest.fixture
def places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Places:
    """Return the folders of an installation with two notebooks; the user's own folder does not exist."""
    notebooks = tmp_path / "version" / "course" / "notebooks"
    notebooks.mkdir(parents=True)
    (tmp_path / "version" / RECORD).write_text("{}")
    for name in ("05", "06"):
        (notebooks / f"{name}.ipynb").write_text("first")
    monkeypatch.setenv("COURSE_HOME", str(tmp_path / "own"))
    return Places.of(notebooks.parent)


def test_an_upgrade_adds_notebooks_and_never_overwrites_the_users_work(
    places: Places, capsys: pytest.CaptureFixture[str]
) -> None:
    """An upgrade adds new notebooks, and replaces notebooks that the user has not changed.

    If the user has changed a notebook, the upgrade prints one message and keeps the user's version.
    """
    make_own_files(places)
    (places.own / "notebooks" / "05.ipynb").write_text("my work")
    for name in ("05", "06", "07"):
        (places.checkout / "notebooks" / f"{name}.ipynb").write_text("second")
    make_own_files(places)
    assert "There is a new version of notebooks/05.ipynb." in capsys.readouterr().err
    make_own_files(places)
    assert capsys.readouterr().err == ""
    texts = {path.name: path.read_text() for path in (places.own / "notebooks").iterdir()}
    assert texts == {"05.ipynb": "my work", "06.ipynb": "second", "07.ipynb": "second"}


def test_a_deleted_notebook_is_copied_again(places: Places) -> None:
    """If the user deletes a notebook, the course copies the original notebook again."""
    make_own_files(places)
    (places.own / "notebooks" / "05.ipynb").unlink()
    make_own_files(places)
    assert (places.own / "notebooks" / "05.ipynb").read_text() == "first"


def test_a_folder_that_cannot_be_created_is_one_message(
    places: Places, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If the user's folder cannot be written, the error message says how to select another folder."""
    monkeypatch.setenv("COURSE_HOME", "/proc/none/ros-course")
    with pytest.raises(
        SetupError, match=r"cannot write to your folder /proc/none/ros-course \(.*set COURSE_HOME to"
    ):
        make_own_files(places)


def test_a_checkout_stays_as_it_is() -> None:
    """In a checkout, the user's own folder is the checkout."""
    places = Places.of()
    assert not places.installed
    assert (places.own, places.own_data) == (places.checkout, places.cache)


@pytest.mark.parametrize("name", ["jörg", "o'neil", "$(id)", "two words"])
def test_results_and_workspace_are_in_the_users_own_folder(tmp_path: Path, name: str) -> None:
    """Even for an unusual user name, an installed package writes all its files to ~/ros-course."""
    version = make_version(tmp_path / "prefix")
    home = tmp_path / name
    program = (
        "from course_pkg.state import state_folder\n"
        "from course_pkg.workspace.own_packages import own_workspace\n"
        "from course_pkg.setup import Places\n"
        "places = Places.of()\n"
        "print(state_folder(), own_workspace(), places.own_data, places.cache, sep='\\n')"
    )
    own = home / "ros-course"
    expected = [own / DATA / "state", own / "workspace", own / DATA, version / "env"]
    assert asked(version, program, HOME=str(home)).splitlines() == [str(path) for path in expected]
