"""The outer sandbox decides which files of the machine a submission and its processes can see.

bubblewrap (https://github.com/containers/bubblewrap) limits the visible files. If root starts the sandbox,
the command runs as an unprivileged user. For all other users, the machine must allow unprivileged user
namespaces.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

from course_pkg.errors import SandboxUnavailable
from course_pkg.sandbox.linux.confinement import MEMORY_FOLDERS, SHADOW, SHADOWED
from course_pkg.setup import PACKAGE_PARTS, Places, environment

# If root starts the sandbox, the command runs with this uid and gid. The user with this uid owns no files.
NOBODY = 65534
READABLE = (
    "/usr",
    "/etc/alternatives",
    "/etc/catkin",
    "/etc/ld.so.cache",
    "/etc/ros",
    "/etc/fonts",
    "/etc/ssl/openssl.cnf",
)
LINKS = ("/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
FROM_CHECKOUT = (*PACKAGE_PARTS, "pyproject.toml")
INVENTED = {
    "/etc/passwd": "root:x:0:0::/:/bin/false\nstudent:x:1000:1000::/student:/bin/bash\n",
    "/etc/group": "root:x:0:\nstudent:x:1000:\n",
    "/etc/hosts": "127.0.0.1 localhost\n",
    "/etc/nsswitch.conf": "passwd: files\ngroup: files\nhosts: files\n",
}
WRITABLE = 512 << 20  # The trusted processes can write at most this number of bytes.
# The kernel lets an inner sandbox mount its own /proc only if no mount covers a folder in the outer sandbox's
# /proc. This command therefore mounts a new /proc, and then drops all privileges.
AS_ROOT = (
    "mount -t proc proc /proc && exec setpriv --reuid {0} --regid {0} --clear-groups --inh-caps=-all "
    '--bounding-set=-all --no-new-privs -- "$0" "$@"'
)


def refusal() -> str:
    """Return why this machine cannot create a sandbox, and what the user can do; return "" if it can."""
    if sys.platform != "linux" or not (found := shutil.which("bwrap")):
        return (
            "bubblewrap is not installed (on Debian and Ubuntu: apt-get install bubblewrap python3-seccomp)."
        )
    tried = subprocess.run(
        sandbox_command([sys.executable, "-m", "course_pkg.sandbox.self_test"]),
        env={},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    if tried.returncode == 0:
        return ""
    reason = (tried.stderr.strip().splitlines() or ["the reason is unknown"])[-1]
    return f"{found} cannot create a sandbox on this machine: {reason}."


def require_sandbox() -> None:
    """Raise SandboxUnavailable if this machine cannot create a sandbox."""
    if reason := refusal():
        raise SandboxUnavailable(
            f"{reason} Without a sandbox, students' code runs with your permissions, so it can read "
            "your files and change grades. Grade on another machine, or add --unsafe-no-sandbox if "
            "you trust every submission."
        )


def sandbox_command(command: Sequence[str], *, readable: Sequence[Path] = ()) -> list[str]:
    """Return the command that runs the command `command` in a sandbox.

    Start the returned command with an empty environment. Inside the sandbox, only the course (without
    solutions and tests), ROS, and the paths in `readable` are visible. All of them are read-only.
    """
    root = os.geteuid() == 0
    prepared = ["sh", "-c", AS_ROOT.format(NOBODY)] if root else []
    return [
        "bwrap",
        *("--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"),
        *(_root_capabilities() if root else ("--unshare-user", "--proc", "/proc")),
        *("--new-session", "--die-with-parent", "--clearenv", "--hostname", "classroom"),
        *("--dev", "/dev"),
        *_file_system([*_course(), *readable]),
        *(option for pair in clean_environment().items() for option in ("--setenv", *pair)),
        *("--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/"),
        "--",
        *prepared,
        *command,
    ]


def _root_capabilities() -> Iterator[str]:
    """Yield the options that allow root to mount /proc and then to become the user nobody.

    If bwrap mounted the new /proc, bwrap would also mount other folders over parts of /proc. The kernel would
    then not allow the inner sandboxes to mount their own /proc.
    """
    yield from ("--dir", "/proc")
    for capability in ("SYS_ADMIN", "SETUID", "SETGID", "SETPCAP"):
        yield from ("--cap-add", f"CAP_{capability}")


def _file_system(shown: Sequence[Path]) -> Iterator[str]:
    for folder in MEMORY_FOLDERS:
        yield from ("--perms", "1777", "--size", str(WRITABLE), "--tmpfs", folder)
    for link in filter(os.path.islink, LINKS):
        yield from ("--symlink", os.readlink(link), link)
    system = [path for path in (*READABLE, *LINKS) if os.path.exists(path) and not os.path.islink(path)]
    for path in dict.fromkeys([*map(Path, system), *shown]):
        yield from _shown(path, path)
    for name, text in INVENTED.items():
        yield from _shown(_invented(name, text), Path(name))
    yield from _shadows(shown)
    for folder in ("/run", "/student"):
        yield from ("--perms", "0755", "--dir", folder)


def _shadows(shown: Sequence[Path]) -> Iterator[str]:
    """Yield options that make the visible paths in /tmp and /dev/shm also visible in the folder `SHADOW`.

    Each part mounts new folders at /tmp and /dev/shm, and then mounts the paths from `SHADOW` in these new
    folders.
    """
    inside = [path for path in dict.fromkeys(shown) if any(map(path.is_relative_to, MEMORY_FOLDERS))]
    for number, path in enumerate(inside):
        place = Path(SHADOW, str(number))
        yield from ("--perms", "0755", "--dir", str(place)) if path.is_dir() else _shown(path, place)
    yield from ("--setenv", SHADOWED, os.pathsep.join(map(str, inside)))


def _shown(source: Path, target: Path) -> Iterator[str]:
    """Yield the options that mount `source` at `target`; every user can read the folders above the target."""
    for parent in reversed(target.parents[:-1]):
        yield from ("--perms", "0755", "--dir", str(parent))
    yield from ("--ro-bind", str(source), str(target))


def _course() -> Iterator[Path]:
    places = Places.of()
    prefix = Path(sys.base_prefix)
    yield from (path for name in FROM_CHECKOUT if (path := places.checkout / name).exists())
    yield from (places.venv, places.workspace)
    if not prefix.is_relative_to("/usr"):
        yield prefix


def clean_environment() -> dict[str, str]:
    """Return the course's environment, without variables of the user who grades.

    If glibc used more than one memory arena, it would reserve about 64 MiB of address space for each thread.
    With such reservations, a student's code could start only about ten threads within the limit MEMORY.
    """
    known = environment.merged(Places.of(), {})
    known.update(HOME="/student", ROS_HOSTNAME="localhost", LANG="C.UTF-8", PYTHONDONTWRITEBYTECODE="1")
    return {**known, "MALLOC_ARENA_MAX": "1"}


def _invented(path: str, text: str) -> Path:
    """Return a file that contains the text; all sandboxes of this checkout use the file."""
    file = Places.of().own_data / "sandbox" / Path(path).name
    if not file.exists() or file.read_text("utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        draft = file.with_name(f"{file.name}.{os.getpid()}.{threading.get_ident()}")
        draft.write_text(text, "utf-8")
        draft.replace(file)
    return file
