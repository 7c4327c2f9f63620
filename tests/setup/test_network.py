"""Tests of what `course doctor` prints about private networks."""

from __future__ import annotations

from pathlib import Path

import pytest

from course_pkg.setup import network


def fake(folder: Path, name: str, script: str) -> None:
    """Create a program."""
    (folder / name).write_text(f"#!/bin/sh\n{script}\n")
    (folder / name).chmod(0o755)


@pytest.fixture
def kernel(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Imitate a Linux kernel that refuses namespaces; return the folder of the kernel's settings."""
    fake(tmp_path, "unshare", "echo 'unshare failed: Operation not permitted' >&2; exit 1")
    fake(tmp_path, "nsenter", "exit 1")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(network, "KERNEL", tmp_path)
    return tmp_path


@pytest.mark.parametrize(("name", "forbids", "_allows"), network.SETTINGS)
def test_a_setting_that_forbids_namespaces_is_named(
    kernel: Path, name: str, forbids: str, _allows: str
) -> None:
    """If a kernel setting forbids namespaces, the advice contains the command that changes this setting."""
    setting = kernel / name.replace(".", "/")
    setting.parent.mkdir()
    setting.write_text(f"{forbids}\n")
    problem, advice = network.network_problem()
    assert problem == f"{name} is {forbids} (unshare failed: Operation not permitted)"
    assert f"sysctl -w {name}=" in advice


def test_other_reasons_are_quoted(kernel: Path) -> None:
    """If no kernel setting forbids namespaces, the message contains the error message of `unshare`."""
    assert network.network_problem()[0] == "unshare failed: Operation not permitted"


def test_what_outgoing_connections_need(kernel: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message names what is missing: the program slirp4netns, its device, or a reachable name server."""
    assert "slirp4netns is not installed" in network.outgoing_problem()[0]
    fake(kernel, "slirp4netns", "exit 0")
    monkeypatch.setattr(network, "DEVICE", str(kernel / "none"))
    assert "none cannot be opened" in network.outgoing_problem()[0]
    monkeypatch.setattr(network, "DEVICE", str(kernel))
    resolver = kernel / "resolv.conf"
    monkeypatch.setattr(network, "RESOLVER", resolver)
    resolver.write_text("nameserver 127.0.0.53\n")
    assert "contains only 127.0.0.53" in network.outgoing_problem()[0]
    resolver.write_text("nameserver 192.0.2.1\n")
    assert network.outgoing_problem() == ("", "")
