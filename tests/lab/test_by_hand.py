"""Tests of `jupyter lab`: its server has a master and settings, as with `course lab`."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from course_pkg.ports import free_port
from course_pkg.ros import MasterClient
from course_pkg.setup import Places
from tests.lab.commands import ROOT, all_gone, below, can_connect, having
from tests.lab.test_jupyterlab import Service
from tests.support import eventually

READY = 60.0  # s


@pytest.fixture(scope="module")
def by_hand(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """Start `jupyter lab` without ROS's environment variables, as an editor or Binder does."""
    port = free_port()
    command = [Places.of().venv / "bin" / "jupyter", "lab", "--no-browser", "--allow-root"]
    options = ["--IdentityProvider.token=t", f"--ServerApp.port={port}", "--ServerApp.port_retries=0"]
    variables = {"HOME": str(tmp_path_factory.mktemp("home")), "PATH": "/usr/bin:/bin"}
    kept = {name: os.environ[name] for name in ("XDG_CACHE_HOME", "CONDA_PREFIX") if name in os.environ}
    kept.setdefault("XDG_CACHE_HOME", str(Places.of().cache.parents[1]))
    log = tmp_path_factory.mktemp("log") / "server.log"
    with (
        log.open("wb") as output,
        subprocess.Popen(
            [*command, *options], cwd=ROOT, env={**variables, **kept}, stdout=output, stderr=output, text=True
        ) as process,
    ):
        try:
            eventually(lambda: can_connect(port), READY)
            yield Service(process, f"http://127.0.0.1:{port}/lab?token=t")
        finally:
            family = below(process)
            process.terminate()
            assert all_gone([process.pid, *family])


def environment_of(service: Service, pattern: bytes) -> dict[str, str]:
    """Return the environment of the server's child process that has the pattern in its command line."""
    found = eventually(lambda: having(pattern, below(service.process)), READY)
    return psutil.Process(found[0]).environ()


def test_kernels_and_terminals_share_ros_and_a_master(by_hand: Service) -> None:
    """A kernel and a terminal find the ROS packages, and both use the same running master."""
    by_hand.post("/api/kernels")
    by_hand.post("/api/terminals")
    kernel = environment_of(by_hand, b"ipykernel_launcher")
    terminal = environment_of(by_hand, b"bash\0--rcfile\0")
    for name in ("ROS_MASTER_URI", "ROS_PACKAGE_PATH", "PYTHONPATH"):
        assert kernel[name] == terminal[name]
    assert kernel["ROS_HOSTNAME"] == "localhost"
    assert str(Places.of().workspace / "src") in kernel["ROS_PACKAGE_PATH"]
    master = MasterClient(kernel["ROS_MASTER_URI"])
    assert eventually(lambda: "/rosout" in master.system_state().nodes, READY)


def test_the_settings_are_those_of_course_lab(by_hand: Service) -> None:
    """The file browser hides the course's own files, and JupyterLab uses the course's settings."""
    names = {entry["name"] for entry in by_hand.get("/api/contents")["content"]}
    assert "notebooks" in names
    assert not {"course_pkg", "setup.py"} & names
    settings = {entry["id"]: entry for entry in by_hand.get("/lab/api/settings")["settings"]}
    defaults = settings["@jupyterlab/apputils-extension:notification"]["schema"]["properties"]
    assert defaults["checkForUpdates"]["default"] is False


def test_the_course_enables_its_extension() -> None:
    """A configuration file in the virtual environment enables the server extension of the course."""
    enabled = Places.of().venv / "etc" / "jupyter" / "jupyter_server_config.d" / "course_pkg.json"
    assert '"course_pkg.lab.extension": true' in Path(enabled).read_text()
