"""Tests of the environment for ROS."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from course_pkg.setup import Places, environment

PLACES = Places.of()
pytestmark = pytest.mark.skipif(not PLACES.environment.exists(), reason="only ./course creates it")


def test_the_courses_python_comes_first_on_path() -> None:
    """In PATH, the course's interpreter comes before the user's pyenv or conda."""
    fresh = environment.merged(PLACES, {"PATH": "/home/u/.pyenv/shims:/usr/bin:/opt/conda/bin"})
    assert fresh["PATH"].split(":")[:2] == [str(PLACES.venv / "bin"), "/usr/bin"]
    assert fresh["PATH"].endswith("/home/u/.pyenv/shims:/opt/conda/bin")


def test_the_users_python_variables_are_removed() -> None:
    """In the course's environment, PYTHONPATH has a new value; PYTHONHOME and PYTHONSTARTUP are removed."""
    user = {"PYTHONPATH": "/x", "PYTHONHOME": "/y", "PYTHONSTARTUP": "/z", "EDITOR": "vi"}
    fresh = environment.merged(PLACES, user)
    assert "/x" not in fresh["PYTHONPATH"].split(":")
    assert not {"PYTHONHOME", "PYTHONSTARTUP"} & set(fresh)
    assert fresh["EDITOR"] == "vi"


@pytest.mark.parametrize("name", ["ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP"])
def test_the_users_ros_variables_are_kept(name: str) -> None:
    """ROS_HOSTNAME is localhost unless the user sets ROS_MASTER_URI, ROS_HOSTNAME or ROS_IP."""
    assert environment.merged(PLACES, {})["ROS_HOSTNAME"] == "localhost"
    assert environment.merged(PLACES, {name: "x"}).get("ROS_HOSTNAME", "") != "localhost"
    assert "ROS_MASTER_URI" not in environment.merged(PLACES, {})


def test_the_users_preloaded_libraries_are_kept() -> None:
    """LD_PRELOAD contains the user's libraries and the course's library."""
    loopback = environment.merged(PLACES, {})["LD_PRELOAD"]
    assert loopback.endswith("/libcourse_loopback.so")
    assert (
        environment.merged(PLACES, {"LD_PRELOAD": "/a.so /b.so"})["LD_PRELOAD"] == f"/a.so:/b.so:{loopback}"
    )


def test_applying_the_environment_twice_changes_nothing() -> None:
    """If the environment already contains the course's variables, merged() does not change it."""
    once = environment.merged(PLACES, {"PATH": "/a:/usr/bin"})
    assert environment.merged(PLACES, once) == once


def test_an_editor_with_only_the_interpreter_can_import_everything() -> None:
    """Without ROS's environment variables, the course's Python can import course_pkg, rospy and types."""
    program = (
        "import os, course_pkg.srv, rospy, std_srvs.srv, anywidget\n"
        "from course_pkg.setup import environment\n"
        "assert environment.apply()\n"
        "import rospkg; print(rospkg.RosPack().get_path('course_pkg'), os.environ['ROS_HOSTNAME'])\n"
    )
    bare = {"PATH": "/usr/bin:/bin", "HOME": os.path.expanduser("~")}
    for name in ("XDG_CACHE_HOME", "CONDA_PREFIX"):
        if name in os.environ:
            bare[name] = os.environ[name]
    answer = subprocess.run([PLACES.python, "-c", program], cwd="/", env=bare, capture_output=True, text=True)
    assert answer.stdout.split() == [str(PLACES.workspace / "src" / "course_pkg"), "localhost"], answer.stderr


def test_apply_changes_nothing_without_a_workspace(tmp_path: os.PathLike[str]) -> None:
    """If a checkout has no workspace, apply() returns False."""
    before, path = dict(os.environ), list(sys.path)
    assert not environment.apply(PLACES._replace(cache=PLACES.cache / "none"))
    assert (dict(os.environ), sys.path) == (before, path)
