"""Linux system calls for a sandbox, called from Python: namespaces(7), mount(2), capabilities(7).

Each function changes the calling process. This process must have only one thread. If the kernel refuses the
call, the function raises OSError with the name of the system call. The comments name the kernel headers that
define the constants.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import resource
import signal
import socket
import struct
from pathlib import Path

MOUNT = 0x00020000  # This constant is CLONE_NEWNS in sched.h.
CGROUP = 0x02000000
HOSTNAME = 0x04000000  # This constant is CLONE_NEWUTS in sched.h.
IPC = 0x08000000
USER = 0x10000000
PROCESS = 0x20000000  # This constant is CLONE_NEWPID in sched.h.
NETWORK = 0x40000000

# These constants are from sys/mount.h.
MS_RDONLY, MS_NOSUID, MS_NODEV, MS_NOEXEC, MS_REMOUNT, MS_BIND = 1, 2, 4, 8, 32, 4096
MS_REC, MS_PRIVATE = 16384, 1 << 18
PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_CAPBSET_DROP = 1, 4, 24  # These constants are from linux/prctl.h.
PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 36, 38
CAPABILITIES = 64  # No current kernel has more capabilities.
# These constants are from asm/unistd.h and linux/capability.h.
CAPSET, CAPABILITY_VERSION_3 = {"x86_64": 126, "aarch64": 91}, 0x20080522
# These constants are from linux/sockios.h and linux/if.h.
SIOCGIFFLAGS, SIOCSIFFLAGS, IFF_UP, IFF_RUNNING = 0x8913, 0x8914, 1, 64

_libc = ctypes.CDLL(None, use_errno=True)


def unshare(kinds: int) -> None:
    """Create and enter namespaces of these `kinds`.

    A new PROCESS namespace contains only processes that are forked later.
    """
    _done(_libc.unshare(ctypes.c_int(kinds)), "unshare")


def enter(descriptor: int, kind: int) -> None:
    """Enter the existing namespace of the open file `descriptor`."""
    _done(_libc.setns(ctypes.c_int(descriptor), ctypes.c_int(kind)), "setns")


def become(uid: int, gid: int, *, outside: tuple[int, int]) -> None:
    """Change to the user id `uid` and the group id `gid` in a new user namespace.

    `outside` contains the user id and the group id in the parent namespace.
    """
    Path("/proc/self/setgroups").write_text("deny")
    Path("/proc/self/gid_map").write_text(f"{gid} {outside[1]} 1")
    Path("/proc/self/uid_map").write_text(f"{uid} {outside[0]} 1")


def become_root() -> None:
    """Become root only inside a new user namespace and a new mount namespace."""
    outside = os.getuid(), os.getgid()
    unshare(USER | MOUNT)
    become(0, 0, outside=outside)
    keep_mounts_private()


def keep_mounts_private() -> None:
    """Make each later mount visible only in the namespace that mounts it."""
    _mount("none", "/", "", MS_REC | MS_PRIVATE, "")


def mount_memory(target: str, *, size: int = 0, files: int = 0, read_only: bool = False) -> None:
    """Mount an empty folder in memory at the path `target`.

    `size` is the limit in bytes, and `files` is the limit for the number of files; 0 means the default.

    Empty files use memory, too, so the number of files needs a limit.
    """
    limits = [f"size={size}"] * bool(size) + [f"nr_inodes={files}"] * bool(files) + ["mode=0777"]
    _mount("tmpfs", target, "tmpfs", MS_NOSUID | MS_NODEV | (MS_RDONLY if read_only else 0), ",".join(limits))


def hide(path: str) -> None:
    """Hide a folder or a file by mounting an empty folder or file over it."""
    if os.path.isdir(path):
        mount_memory(path, read_only=True)
    else:
        bind("/dev/null", path)


def mount_processes() -> None:
    """Mount a new /proc with only the processes of this namespace."""
    _mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, "")


def bind(source: str, target: str) -> None:
    """Make the folder `source`, with all mounts inside it, also visible at the path `target`."""
    _mount(source, target, "", MS_BIND | MS_REC, "")


def make_read_only(target: str) -> None:
    """Make the mount at `target` read-only in this namespace."""
    _mount("none", target, "", MS_BIND | MS_REMOUNT | MS_RDONLY | MS_NOSUID | MS_NODEV, "")


def start_loopback() -> None:
    """Start the interface 127.0.0.1 of a new network namespace, which has no other interface."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        asked = struct.pack("16sh14x", b"lo", 0)
        (flags,) = struct.unpack_from("h", fcntl.ioctl(sock, SIOCGIFFLAGS, asked), 16)
        fcntl.ioctl(sock, SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", flags | IFF_UP | IFF_RUNNING))


def die_with_parent() -> None:
    """Make the kernel kill this process when its parent ends.

    A later change of the user or of the capabilities cancels this setting.
    """
    _done(_libc.prctl(PR_SET_PDEATHSIG, int(signal.SIGKILL), 0, 0, 0), "prctl")


def adopt_orphans() -> None:
    """Become the parent of each descendant that loses its parent."""
    _done(_libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0), "prctl")


def be_unreadable() -> None:
    """Prevent other processes of this user from reading this process.

    Without this setting, another process of this user could read it with ptrace, /proc/PID/mem and
    /proc/PID/fd.
    """
    _done(_libc.prctl(PR_SET_DUMPABLE, 0, 0, 0, 0), "prctl")


def be_readable() -> None:
    """Allow other processes of this user to read this process in /proc again."""
    _done(_libc.prctl(PR_SET_DUMPABLE, 1, 0, 0, 0), "prctl")


def give_up_privileges() -> None:
    """Drop all capabilities of this process, and of the programs that this process executes."""
    for number in range(CAPABILITIES):
        # The call fails if this kernel does not have the capability.
        _libc.prctl(PR_CAPBSET_DROP, number, 0, 0, 0)
    header = (ctypes.c_uint32 * 2)(CAPABILITY_VERSION_3, 0)
    nothing = (ctypes.c_uint32 * 6)()
    _done(_libc.syscall(CAPSET[os.uname().machine], header, nothing), "capset")
    _done(_libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), "prctl")


def limit(**soft_and_hard: int) -> None:
    """Set limits for this process and its children; for example, NPROC=64 sets RLIMIT_NPROC."""
    for name, value in soft_and_hard.items():
        which = getattr(resource, f"RLIMIT_{name}")
        _, hard = resource.getrlimit(which)
        value = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(which, (value, value))


def _mount(source: str, target: str, kind: str, flags: int, options: str) -> None:
    strings = (text.encode() for text in (source, target, kind))
    _done(_libc.mount(*strings, ctypes.c_ulong(flags), options.encode()), f"mount {target}")


def _done(status: int, call: str) -> None:
    if status != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{call}: {os.strerror(number)}")
