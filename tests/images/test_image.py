"""Tests of the container image.

The tests build the image without an existing base image, and run the quick tests of the suite in a container
of the new image.

mmdebstrap creates the base, and buildah runs the Dockerfile in a chroot, so the test needs no registry.

The image and its container need 4 GB in a temporary folder, which the tests remove at the end. The variable
COURSE_IMAGE_FOLDER selects the parent folder of this temporary folder.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pytest

from course_pkg.handout.edition.git import git
from course_pkg.setup import Places

ROOT = Places.of().checkout
USER = 1000  # the value of NB_UID in the Dockerfile
HOME = "/home/jovyan"
COURSE = f"{HOME}/ros-services-course"
LIBRARIES = (
    "python -m pip install -q --no-deps --no-compile --require-hashes -r course_pkg/setup/locks/test.txt"
)
PYTEST = "./course run pytest -q -p no:cacheprovider"
QUICK = "tests/ros/protocol tests/types tests/lab/test_by_hand.py"
STARTED = "tests/lab/test_jupyterlab.py::test_nothing_outlives_a_killed_lab"
ANSWERS = "tests/checking/answers/test_answers.py -k 'test_right_passes and (05. or 06.)' -m 'not slow'"
NEEDED = ("buildah", "mmdebstrap", "bwrap", "setpriv")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.timeout(3600),
    pytest.mark.skipif(os.geteuid() != 0, reason="only root can build an image in a chroot"),
    pytest.mark.skipif(not all(map(shutil.which, NEEDED)), reason=f"needs {', '.join(NEEDED)}"),
]


class Image:
    """A container of the course's image; all files of the container are in one folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        # The container uses the certificates and the local package indexes of the host.
        settings = [Path("/etc/ssl/certs/ca-certificates.crt"), folder / "pip.conf"]
        self._volumes = [
            f"--volume={settings[0]}:{settings[0]}:ro",
            f"--volume={settings[1]}:/etc/pip.conf:ro",
        ]
        mirrors = [path for path in Path("/opt").glob("pypi*") if path.is_dir()]
        self._volumes += [f"--volume={path}:{path}:ro" for path in mirrors]
        indexes = " ".join(f"file://{path}/simple" for path in mirrors)
        settings[1].write_text(f"[global]\ncert = {settings[0]}\nextra-index-url = {indexes}\n")

    def buildah(self, *arguments: str | Path) -> str:
        """Run buildah, which stores its files in the image's folder, and return the output of buildah."""
        storage = ["--root", self._folder / "root", "--runroot", self._folder / "run"]
        return _output(["buildah", *storage, "--storage-driver=vfs", *arguments], TMPDIR=str(self._folder))

    def build(self) -> None:
        """Create a base image, build the image from the files that git tracks, and create a container."""
        base, context = self._folder / "base.tar", self._folder / "context"
        _output(["mmdebstrap", "--variant=minbase", "--include=ca-certificates", "bookworm", base])
        for name in filter(None, git(ROOT, "ls-files", "-z").split("\0")):
            (context / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, context / name)
        empty = self.buildah("from", "scratch").strip()
        self.buildah("add", "--quiet", empty, base, "/")
        self.buildah("commit", "--quiet", empty, "base")
        options = ["--isolation=chroot", "--pull-never", "--build-arg=BASE=localhost/base", "--tag=course"]
        self.buildah("bud", *options, *self._volumes, "-f", context / ".binder" / "Dockerfile", context)
        self.container = self.buildah("from", "--pull-never", "localhost/course").strip()

    def run(self, script: str) -> str:
        """Run a script as the image's user, in a chroot that forbids namespaces."""
        options = ["--isolation=chroot", *self._volumes]
        return self.buildah("run", *options, self.container, "--", "bash", "-ec", script)

    def run_with_namespaces(self, script: str) -> str:
        """Run a script as the image's user, in a container that allows namespaces."""
        root = Path(self.buildah("mount", self.container).strip())
        for folder in (root, *root.parents):
            if folder.is_relative_to(self._folder):
                folder.chmod(folder.stat().st_mode | 0o111)
        (root / "etc" / "hosts").write_text("127.0.0.1 localhost\n")
        user = ["setpriv", f"--reuid={USER}", f"--regid={USER}", "--clear-groups"]
        places = [
            "--bind",
            root,
            "/",
            "--proc",
            "/proc",
            "--dev",
            "/dev",
            "--tmpfs",
            "/tmp",  # noqa: S108 -- a new folder of this container
            "--chdir",
            COURSE,
        ]
        own = ["--unshare-user", "--unshare-pid", "--unshare-net", "--clearenv"]
        path = f"{HOME}/.course/bin:/usr/bin:/bin"
        known = ["--setenv", "HOME", HOME, "--setenv", "PATH", path, "--setenv", "LANG", "C.UTF-8"]
        return _output([*user, "bwrap", *own, *places, *known, "bash", "-ec", script])


def _output(command: Sequence[str | Path], **variables: str) -> str:
    done = subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, **variables}, check=False
    )
    assert done.returncode == 0, f"{done.stdout[-4000:]}\n{done.stderr[-4000:]}"
    return done.stdout


@contextmanager
def _folder() -> Iterator[Path]:
    folder = Path(tempfile.mkdtemp(prefix="course-image-", dir=os.environ.get("COURSE_IMAGE_FOLDER")))
    try:
        folder.chmod(0o711)
        yield folder
    finally:
        shutil.rmtree(folder)


@pytest.fixture(scope="module")
def image() -> Iterator[Image]:
    """Build the image, and install the libraries of the tests in a container."""
    with _folder() as folder:
        made = Image(folder)
        made.build()
        made.run(LIBRARIES)
        yield made


def test_jupyterlab_and_ros_are_on_the_path_of_an_ordinary_user(image: Image) -> None:
    """In a new container, the user can import jupyterlab, and can start jupyter-lab and ROS."""
    seen = image.run(
        "id -un; command -v jupyter-lab; python3 -c 'import jupyterlab'; ./course run rosnode list"
    )
    assert seen.split() == ["jovyan", f"{HOME}/.course/bin/jupyter-lab", "/rosout"]


def test_the_course_works_without_namespaces(image: Image) -> None:
    """In a container without namespaces, ROS, types and JupyterLab work, and a notebook's checks pass."""
    with pytest.raises(AssertionError):
        image.run("unshare -Urn true")
    assert "passed" in image.run(f"{PYTEST} {QUICK} {STARTED}")
    assert "4 parts, and all of them passed." in image.run(f"{PYTEST} --nbval solutions/01_name_things.ipynb")


def test_the_course_works_with_namespaces(image: Image) -> None:
    """In a container with namespaces, the quick tests pass, and answers can be checked in the sandbox."""
    image.run_with_namespaces("unshare -Urn true")
    assert "passed" in image.run_with_namespaces(f"{PYTEST} {QUICK} {STARTED}")
    assert "passed" in image.run_with_namespaces(f"{PYTEST} {ANSWERS}")
