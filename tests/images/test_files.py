"""Tests that the files of the container image agree with the files of the repository."""

from __future__ import annotations

import json
import re
from pathlib import Path

from course_pkg.setup import Places, packages

ROOT = Places.of().checkout
DOCKERFILE = ROOT / ".binder" / "Dockerfile"
DEVCONTAINER = ROOT / ".devcontainer" / "devcontainer.json"
COPY = re.compile(r"^COPY (?:--\S+ )*(\S+) \S+$", re.MULTILINE)
ARGUMENT = re.compile(r"^ARG (\w+)=(\S+)$", re.MULTILINE)
HOST = re.compile(r"\b[\w-]+(?:\.[\w-]+)*\.(?:io|com|org|net)\b")
SECRET = re.compile(r"password|secret|token|api_?key", re.IGNORECASE)


def test_the_base_is_a_distribution_that_the_course_knows(tmp_path: Path) -> None:
    """The base image has the Debian version on which the course's tests run."""
    base = dict(ARGUMENT.findall(DOCKERFILE.read_text()))["BASE"]
    release = tmp_path / "os-release"
    release.write_text("ID=debian\nVERSION_CODENAME=bookworm\n")
    name = packages.read_platform(ROOT, release).name
    assert base == name.lower().replace(" ", ":")


def test_each_copied_file_exists_and_is_not_ignored() -> None:
    """.dockerignore does not exclude any file that the Dockerfile copies by name."""
    ignored = (ROOT / ".dockerignore").read_text().split()
    copied = COPY.findall(DOCKERFILE.read_text())
    assert "." in copied
    for name in copied:
        assert (ROOT / name).exists()
        assert name.partition("/")[0] not in ignored


def test_the_devcontainer_uses_this_image() -> None:
    """devcontainer.json uses the same paths and the same user as the Dockerfile."""
    known, text = json.loads(DEVCONTAINER.read_text()), DOCKERFILE.read_text()
    build = known["build"]
    assert (DEVCONTAINER.parent / build["dockerfile"]).resolve() == DOCKERFILE
    assert (DEVCONTAINER.parent / build["context"]).resolve() == ROOT
    user = dict(ARGUMENT.findall(text))["NB_USER"]
    assert known["remoteUser"] == user
    assert f"WORKDIR {known['workspaceFolder']}".replace(f"/home/{user}", "${HOME}") in text
    assert f"target={known['workspaceFolder']}," in known["workspaceMount"]


def test_the_image_runs_as_an_ordinary_user() -> None:
    """In the Dockerfile, the last USER line contains Binder's variable NB_UID, and the last line is a CMD."""
    text = DOCKERFILE.read_text()
    assert re.findall(r"^USER (\S+)$", text, re.MULTILINE)[-1] == "${NB_UID}"
    assert text.rstrip().splitlines()[-1].startswith("CMD ")


def test_no_file_names_a_registry_or_contains_a_secret() -> None:
    """The Dockerfile, devcontainer.json and .dockerignore contain no registry address and no secret."""
    for path in (DOCKERFILE, DEVCONTAINER, ROOT / ".dockerignore"):
        assert not HOST.findall(path.read_text())
        assert not SECRET.findall(path.read_text())


def test_the_former_files_of_binder_are_gone() -> None:
    """The files postBuild and start do not exist, because repo2docker uses only the Dockerfile."""
    assert not [name for name in ("postBuild", "start") if (ROOT / name).exists()]
