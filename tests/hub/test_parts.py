"""Tests of functions of the hub that need no running hub."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from traitlets.config import Config

from course_pkg.errors import HubError
from course_pkg.hub import accounts, limits
from course_pkg.hub.delivery import GIT_SETTINGS, write_repository
from course_pkg.hub.passwords import Passwords
from course_pkg.hub.single_user import pull
from course_pkg.setup import Places

LIMITS = limits.Limits(memory=300, processes=50)


def test_a_password_is_accepted_once(tmp_path: Path) -> None:
    """A wrong password does not make the right password invalid, and a new password replaces the old one."""
    record = Passwords(tmp_path / "passwords.json")
    password = record.issue(["anna"])["anna"]
    assert record.issue(["anna"]) == {}
    assert not record.use("anna", "wrong")
    assert not record.use("ben", password)
    assert record.use("anna", f" {password.upper()} ")
    assert not record.use("anna", password)
    assert not record.use("anna", "")
    assert record.use("anna", record.issue(["anna"], again=True)["anna"])
    assert password not in (tmp_path / "passwords.json").read_text()


@pytest.mark.parametrize("name", ["Anna", "anna berg", "../anna", "-anna", "1anna", "a" * 33, "anna\n", ""])
def test_unusual_names_are_refused(name: str) -> None:
    """A name that is not valid for an account leads to an error message."""
    with pytest.raises(HubError, match="cannot be names of accounts"):
        accounts.check_names(["ben", name])


def test_an_account_of_the_system_is_refused() -> None:
    """A roster cannot contain a system account such as `daemon`."""
    with pytest.raises(HubError, match="account of the system"):
        accounts.make_accounts(["daemon"])


def test_a_missing_or_foreign_home_is_a_problem(tmp_path: Path) -> None:
    """If a home folder cannot be used, the returned text contains the reason."""
    assert "does not exist" in accounts.home_problem(tmp_path / "none", os.getuid())
    assert "another user" in accounts.home_problem(tmp_path, os.getuid() + 1)
    assert accounts.home_problem(tmp_path, os.getuid()) == ""


def test_a_control_group_gets_the_limits(tmp_path: Path) -> None:
    """The limits of memory and of the number of processes are written to the files of cgroup v2.

    The names and units are from Documentation/admin-guide/cgroup-v2.rst of Linux.
    """
    (tmp_path / "cgroup.controllers").write_text("cpuset cpu io memory pids")
    hub = limits.group_of_hub(tmp_path)
    assert hub
    group = limits.make_group(hub, "anna", LIMITS)
    assert (group / "memory.max").read_text() == str(300 << 20)
    assert (group / "pids.max").read_text() == "50"
    assert "control groups" in limits.describe(LIMITS, hub, own_account=True)


def test_without_control_groups_rlimits_hold(tmp_path: Path) -> None:
    """Without control groups, describe() mentions rlimits, and an allocation above the limit fails."""
    assert limits.group_of_hub(tmp_path) is None
    assert "rlimits" in limits.describe(LIMITS, None, own_account=True)
    program = "from tests.hub.test_parts import *; limits.set_rlimits(LIMITS, True); bytearray(400 << 20)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert "MemoryError" in done.stderr
    assert resource.getrlimit(resource.RLIMIT_DATA)[0] != 300 << 20


def test_a_new_release_keeps_the_students_work(tmp_path: Path) -> None:
    """The program nbgitpuller downloads new notebooks, and does not overwrite changed notebooks."""
    course, home = tmp_path / "course", tmp_path / "home" / "ros-course"
    for name in ("notebooks", "figures"):
        (course / name).mkdir(parents=True)
    (course / "notebooks" / "00_a.ipynb").write_text("released\n")
    repository = tmp_path / "released" / "ros-course"
    assert write_repository(Places(course, tmp_path), repository)
    assert not write_repository(Places(course, tmp_path), repository)
    assert str(repository) in (repository.parent / GIT_SETTINGS).read_text()
    pull(str(repository), home)
    (home / "notebooks" / "00_a.ipynb").write_text("my work\n")
    (course / "notebooks" / "00_a.ipynb").write_text("released again\n")
    (course / "notebooks" / "01_b.ipynb").write_text("new\n")
    assert write_repository(Places(course, tmp_path), repository)
    pull(str(repository), home)
    assert (home / "notebooks" / "00_a.ipynb").read_text() == "my work\n"
    assert (home / "notebooks" / "01_b.ipynb").read_text() == "new\n"


def test_a_release_is_merged_into_a_folder_without_git(tmp_path: Path) -> None:
    """In a folder from `course lab`, the merge updates old files, and does not change the student's files."""
    course, home = tmp_path / "course", tmp_path / "home" / "ros-course"
    for name in ("notebooks", "figures"):
        (course / name).mkdir(parents=True)
    own = home / "notebooks"
    own.mkdir(parents=True)
    repository = tmp_path / "released" / "ros-course"
    for text in ("first release\n", "second release\n"):
        for name in ("00_a.ipynb", "01_b.ipynb", "02_c.ipynb"):
            (course / "notebooks" / name).write_text(text)
        write_repository(Places(course, tmp_path), repository)
    for name, text in {
        "00_a.ipynb": "first release\n",
        "01_b.ipynb": "my work\n",
        "mine.txt": "mine\n",
    }.items():
        (own / name).write_text(text)
    pull(str(repository), home)
    texts = {path.name: path.read_text() for path in own.iterdir()}
    assert texts == {
        "00_a.ipynb": "second release\n",
        "01_b.ipynb": "my work\n",
        "02_c.ipynb": "second release\n",
        "mine.txt": "mine\n",
    }


def test_the_proxy_is_pinned() -> None:
    """The lock file of the JupyterHub proxy contains no address of a package registry."""
    lock = Path(__file__).parents[2] / "deploy" / "jupyterhub" / "package-lock.json"
    assert "configurable-http-proxy" in lock.read_text()
    assert "resolved" not in lock.read_text()


def test_the_files_for_containers_can_be_read() -> None:
    """The files for Kubernetes and Docker set a memory limit and start JupyterLab.

    This test only reads the files, and starts no container.
    """
    deploy = Path(__file__).parents[2] / "deploy"
    values = yaml.safe_load((deploy / "kubernetes" / "values.yaml").read_text())
    assert values["singleuser"]["memory"]["limit"] == "1G"
    config = Config()
    source = (deploy / "docker" / "jupyterhub_config.py").read_text()
    exec(compile(source, "jupyterhub_config.py", "exec"), {"get_config": lambda: config})  # noqa: S102
    assert config.DockerSpawner.mem_limit == "1G"
    assert config.Spawner.default_url == values["singleuser"]["defaultUrl"]
