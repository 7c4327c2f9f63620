"""The requirements of a private network for a graph on this computer."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

FORWARDER = "slirp4netns"  # This program connects a private network with other computers.
DEVICE = "/dev/net/tun"  # slirp4netns uses this device.
RESOLVER = Path("/etc/resolv.conf")
KERNEL = Path("/proc/sys")
# Each item is a kernel setting, a value that forbids namespaces for ordinary users, and a value that allows
# them.
SETTINGS = (
    ("kernel.unprivileged_userns_clone", "0", "1"),
    ("kernel.apparmor_restrict_unprivileged_userns", "1", "0"),
    ("user.max_user_namespaces", "0", "15000"),
    ("user.max_net_namespaces", "0", "15000"),
)


def network_problem(account: str | None = None) -> tuple[str, str]:
    """Return why this computer allows no private network, and what to do.

    Both returned strings are empty if this computer allows a private network. Without `account`, the function
    examines the user of this process. Only root can examine another account.
    """
    if not shutil.which("unshare") or not shutil.which("nsenter"):
        return "unshare or nsenter is missing", "As an administrator, type: apt-get install util-linux"
    user = ["--user"] if account or os.geteuid() else []
    answer = subprocess.run(
        ["unshare", *user, "--net", "true"],
        capture_output=True,
        text=True,
        timeout=10,
        check=False,
        user=account,
    )
    if answer.returncode == 0:
        return "", ""
    reason = answer.stderr.strip() or f"unshare ended with status {answer.returncode}"
    for name, forbids, allows in SETTINGS:
        setting = KERNEL / name.replace(".", "/")
        if setting.is_file() and setting.read_text().strip() == forbids:
            return f"{name} is {forbids} ({reason})", f"As an administrator, type: sysctl -w {name}={allows}"
    return (
        reason,
        "Ask the administrator to allow user namespaces; for a container, its host has to allow them",
    )


def outgoing_problem() -> tuple[str, str]:
    """Return why a private network cannot reach other computers, and what to do.

    Both returned strings are empty if a private network can reach other computers.
    """
    if not shutil.which(FORWARDER):
        return f"{FORWARDER} is not installed", f"As an administrator, type: apt-get install {FORWARDER}"
    if not os.access(DEVICE, os.R_OK | os.W_OK):
        return f"{DEVICE} cannot be opened", f"As an administrator, type: chmod 666 {DEVICE}"
    servers = [line.split()[1] for line in _lines(RESOLVER) if line.startswith("nameserver ")]
    if servers and all(server.startswith("127.") for server in servers):
        problem = (
            f"{RESOLVER} contains only {servers[0]}, so the names of other computers cannot be looked up"
        )
        link = f"ln -sf /run/systemd/resolve/resolv.conf {RESOLVER}"
        return problem, f"If this computer uses systemd-resolved, type as an administrator: {link}"
    return "", ""


def _lines(file: Path) -> list[str]:
    return file.read_text(errors="replace").splitlines() if file.is_file() else []
