"""Tests of the system packages for each Linux distribution."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from course_pkg.errors import SetupError
from course_pkg.setup.packages import DATA, read_platform

RELEASES = {
    "Debian 12": 'ID=debian\nVERSION_ID="12"\nVERSION_CODENAME=bookworm\n',
    "Debian 13": 'ID=debian\nVERSION_ID="13"\nVERSION_CODENAME=trixie\n',
    "Ubuntu 22.04": "ID=ubuntu\nVERSION_CODENAME=jammy\nUBUNTU_CODENAME=jammy\n",
}
MINT = 'ID=linuxmint\nVERSION_CODENAME=vanessa\nUBUNTU_CODENAME="jammy"\n'


def release(folder: Path, text: str) -> Path:
    """Write an os-release file."""
    path = folder / "os-release"
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", RELEASES)
def test_each_distribution_is_known_by_its_codename(name: str, tmp_path: Path) -> None:
    """For Debian 12, Debian 13 and Ubuntu 22.04, the course knows the packages of ROS."""
    platform = read_platform(tmp_path, release(tmp_path, RELEASES[name]))
    assert platform.name == name
    assert {"python3-rospy", "catkin", "rosbash", "ros-message-generation"} <= set(platform.course)


@pytest.mark.parametrize("name", RELEASES)
def test_each_distribution_has_the_tools_of_chapters_13_and_16(name: str, tmp_path: Path) -> None:
    """The package list of each distribution contains a compiler, roscpp and actionlib."""
    platform = read_platform(tmp_path, release(tmp_path, RELEASES[name]))
    assert {"g++", "make", "libroscpp-dev"} <= set(platform.course)
    assert {"libactionlib-msgs-dev", "ros-actionlib-msgs", "python3-actionlib"} <= set(platform.course)


def test_a_derivative_uses_the_packages_of_its_base(tmp_path: Path) -> None:
    """Linux Mint 21 uses the packages of Ubuntu 22.04."""
    assert read_platform(tmp_path, release(tmp_path, MINT)).name == "Ubuntu 22.04"


@pytest.mark.parametrize("text", ['PRETTY_NAME="Ubuntu 24.04"\nVERSION_CODENAME=noble\n', "", "nonsense"])
def test_on_other_systems_the_message_recommends_conda(text: str, tmp_path: Path) -> None:
    """If a Linux distribution is unknown, the error message contains the command for conda."""
    with pytest.raises(SetupError, match=r"conda env create -f .*environment.yml"):
        read_platform(tmp_path, release(tmp_path, text))


def test_no_package_is_named_twice() -> None:
    """The package list of each distribution is sorted, and contains no package twice."""
    data = json.loads(DATA.read_text())
    assert data["course"] == sorted(set(data["course"]))
    for entry in data["distributions"].values():
        assert not set(entry["course"]) & set(data["course"])
