"""The environment of ROS, put over the user's own."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from course_pkg.setup import Places, environment

PLACES = Places.of()
pytestmark = pytest.mark.skipif(not PLACES.environment.exists(), reason="set up by ./course only")


def test_no_python_of_the_users_comes_first() -> None:
    """A pyenv or conda at the front of PATH moves behind the course's interpreter and the system's tools."""
    fresh = environment.merged(PLACES, {"PATH": "/home/u/.pyenv/shims:/usr/bin:/opt/conda/bin"})
    assert fresh["PATH"].split(":")[:2] == [str(PLACES.venv / "bin"), "/usr/bin"]
    assert fresh["PATH"].endswith("/home/u/.pyenv/shims:/opt/conda/bin")


def test_no_module_of_the_users_gets_in() -> None:
    """PYTHONPATH is the course's, PYTHONHOME and PYTHONSTARTUP are removed, the rest is unchanged."""
    user = {"PYTHONPATH": "/x", "PYTHONHOME": "/y", "PYTHONSTARTUP": "/z", "EDITOR": "vi"}
    fresh = environment.merged(PLACES, user)
    assert "/x" not in fresh["PYTHONPATH"].split(":")
    assert not {"PYTHONHOME", "PYTHONSTARTUP"} & set(fresh)
    assert fresh["EDITOR"] == "vi"


@pytest.mark.parametrize("name", ["ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP"])
def test_a_user_who_names_a_host_is_heard(name: str) -> None:
    """ROS_HOSTNAME is localhost unless the user says where the master or this host is."""
    assert environment.merged(PLACES, {})["ROS_HOSTNAME"] == "localhost"
    assert environment.merged(PLACES, {name: "x"}).get("ROS_HOSTNAME", "") != "localhost"
    assert "ROS_MASTER_URI" not in environment.merged(PLACES, {})


def test_a_library_that_the_user_preloads_stays() -> None:
    """The course's own, with which nodes in C++ listen on 127.0.0.1 only, is added to it."""
    loopback = environment.merged(PLACES, {})["LD_PRELOAD"]
    assert loopback.endswith("/libcourse_loopback.so")
    assert (
        environment.merged(PLACES, {"LD_PRELOAD": "/a.so /b.so"})["LD_PRELOAD"] == f"/a.so:/b.so:{loopback}"
    )


def test_twice_is_as_good_as_once() -> None:
    """`course run` within `course run bash` changes nothing."""
    once = environment.merged(PLACES, {"PATH": "/a:/usr/bin"})
    assert environment.merged(PLACES, once) == once


def test_an_editor_that_knows_the_interpreter_only_can_import_all() -> None:
    """The bare interpreter imports the package, rospy and the generated types; apply() finds ROS."""
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


def test_nothing_is_applied_where_nothing_is_built(tmp_path: os.PathLike[str]) -> None:
    """apply() returns False, and changes nothing, for a checkout without a workspace."""
    before, path = dict(os.environ), list(sys.path)
    assert not environment.apply(PLACES._replace(cache=PLACES.cache / "none"))
    assert (dict(os.environ), sys.path) == (before, path)
