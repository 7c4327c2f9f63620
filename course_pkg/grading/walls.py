"""The outer wall: what bubblewrap leaves of the machine for everything that a submission sets going.

bubblewrap (https://github.com/containers/bubblewrap) builds the view of the file system. Started by root, it
hands over to an unprivileged user behind the wall; started by anybody else it needs user namespaces.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

from course_pkg.errors import WallsMissing
from course_pkg.grading.ward.confinement import ROOMS, STAGE, STAGED
from course_pkg.provision import CATKIN_FOLDERS, Places, environment

NOBODY = 65534  # uid and gid of whoever owns nothing, in place of root
READ = (
    "/usr",
    "/etc/alternatives",
    "/etc/catkin",
    "/etc/ld.so.cache",
    "/etc/ros",
    "/etc/fonts",
    "/etc/ssl/openssl.cnf",
)
LINKS = ("/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
OF_CHECKOUT = ("course_pkg", *CATKIN_FOLDERS, "package.xml", "CMakeLists.txt", "setup.py", "pyproject.toml")
MADE_UP = {
    "/etc/passwd": "root:x:0:0::/:/bin/false\nstudent:x:1000:1000::/student:/bin/bash\n",
    "/etc/group": "root:x:0:\nstudent:x:1000:\n",
    "/etc/hosts": "127.0.0.1 localhost\n",
    "/etc/nsswitch.conf": "passwd: files\ngroup: files\nhosts: files\n",
}
ROOM = 512 << 20  # bytes of what the trusted side may write
PREPARED = (  # a /proc that nothing covers, without which there is none further in; then away with all power
    "mount -t proc proc /proc && exec setpriv --reuid {0} --regid {0} --clear-groups --inh-caps=-all "
    '--bounding-set=-all --no-new-privs -- "$0" "$@"'
)


def refusal() -> str:
    """Return why there are no walls on this machine, and what to do about it; empty where there are."""
    if sys.platform != "linux" or not (found := shutil.which("bwrap")):
        return (
            "There is no bubblewrap here (on Debian and Ubuntu: apt-get install bubblewrap python3-seccomp)."
        )
    tried = subprocess.run(
        enclosed([sys.executable, "-m", "course_pkg.grading.ward.trial"]),
        env={},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    if tried.returncode == 0:
        return ""
    words = (tried.stderr.strip().splitlines() or ["no reason was given"])[-1]
    return f"{found} cannot build walls here: {words}."


def require_walls() -> None:
    """Raise WallsMissing where submissions would run with nothing around them."""
    if words := refusal():
        raise WallsMissing(
            f"{words} What students wrote would run with your rights, and could read and forge all. "
            "Grade on a machine that has walls, or, if you trust every submission, add --unsafe-no-sandbox."
        )


def enclosed(command: Sequence[str], *, readable: Sequence[Path] = ()) -> list[str]:
    """Return the command that runs `command` behind the wall; start it with an empty environment.

    The course and ROS are there for reading, without solutions and tests, and so is what `readable` names.
    """
    root = os.geteuid() == 0
    prepared = ["sh", "-c", PREPARED.format(NOBODY)] if root else []
    return [
        "bwrap",
        *("--unshare-pid", "--unshare-net", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"),
        *(_with_power() if root else ("--unshare-user", "--proc", "/proc")),
        *("--new-session", "--die-with-parent", "--clearenv", "--hostname", "classroom"),
        *("--dev", "/dev"),
        *_file_system([*_course(), *readable]),
        *_variables(),
        *("--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/"),
        "--",
        *prepared,
        *command,
    ]


def _with_power() -> Iterator[str]:
    """Yield what lets root mount /proc and then become nobody; bwrap's own /proc is covered in part."""
    yield from ("--dir", "/proc")
    for capability in ("SYS_ADMIN", "SETUID", "SETGID", "SETPCAP"):
        yield from ("--cap-add", f"CAP_{capability}")


def _file_system(shown: Sequence[Path]) -> Iterator[str]:
    for folder in ROOMS:
        yield from ("--perms", "1777", "--size", str(ROOM), "--tmpfs", folder)
    for link in filter(os.path.islink, LINKS):
        yield from ("--symlink", os.readlink(link), link)
    system = [path for path in (*READ, *LINKS) if os.path.exists(path) and not os.path.islink(path)]
    for path in dict.fromkeys([*map(Path, system), *shown]):
        yield from _shown(path, path)
    for name, text in MADE_UP.items():
        yield from _shown(_made_up(name, text), Path(name))
    yield from _staged(shown)
    for folder in ("/run", "/student"):
        yield from ("--perms", "0755", "--dir", folder)


def _staged(shown: Sequence[Path]) -> Iterator[str]:
    """Yield what lets a part that has a folder of its own for a room show again what lay in that room."""
    inside = [path for path in dict.fromkeys(shown) if any(path.is_relative_to(room) for room in ROOMS)]
    for number, path in enumerate(inside):
        place = Path(STAGE, str(number))
        yield from ("--perms", "0755", "--dir", str(place)) if path.is_dir() else _shown(path, place)
    yield from ("--setenv", STAGED, os.pathsep.join(map(str, inside)))


def _shown(source: Path, target: Path) -> Iterator[str]:
    """Yield what shows `source` at `target`, in folders that everybody may look into."""
    for parent in reversed(target.parents[:-1]):
        yield from ("--perms", "0755", "--dir", str(parent))
    yield from ("--ro-bind", str(source), str(target))


def _course() -> Iterator[Path]:
    places = Places.of()
    prefix = Path(sys.base_prefix)
    yield from (path for name in OF_CHECKOUT if (path := places.checkout / name).exists())
    yield from (places.venv, places.workspace)
    if not prefix.is_relative_to("/usr"):
        yield prefix


def _variables() -> Iterator[str]:
    """Yield the course's environment as if it had been put on by somebody who has set nothing."""
    known = environment.merged(Places.of(), {})
    known.update(HOME="/student", ROS_HOSTNAME="localhost", LANG="C.UTF-8", PYTHONDONTWRITEBYTECODE="1")
    for name, value in known.items():
        yield from ("--setenv", name, value)


def _made_up(path: str, text: str) -> Path:
    """Return a file with `text`, one for all walls of this checkout."""
    file = Places.of().cache / "walls" / Path(path).name
    if not file.exists() or file.read_text("utf-8") != text:
        file.parent.mkdir(parents=True, exist_ok=True)
        draft = file.with_name(f"{file.name}.{os.getpid()}.{threading.get_ident()}")
        draft.write_text(text, "utf-8")
        draft.replace(file)
    return file
