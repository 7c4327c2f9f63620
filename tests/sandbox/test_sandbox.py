"""Code in the sandbox cannot use forbidden files and system calls."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import pytest

import course_pkg
from course_pkg.checking.parts import find
from course_pkg.sandbox.job import PartJob
from course_pkg.sandbox.linux import bubblewrap
from course_pkg.sandbox.supervisor import too_much_memory_below
from course_pkg.sandbox.worker_client import SandboxWorker
from tests.checking.answers.example_answers import every_answer

pytestmark = pytest.mark.usefixtures("sandbox")
CHECKOUT = Path(course_pkg.__file__).resolve().parent.parent
READABLE = [
    CHECKOUT / "solutions",
    CHECKOUT / "tests",
    CHECKOUT / "notebooks",
    CHECKOUT / ".git",
    CHECKOUT / "course_pkg" / "chapters" / "ch05_write_a_server" / "checks",
    CHECKOUT / "course_pkg" / "chapters" / "ch05_write_a_server" / "answers.py",
    Path("/etc/shadow"),
    Path("/var"),
    Path("/proc/1/environ"),
    Path("/proc/1/root"),
    Path("/proc/kcore"),
]
WRITE = ["/", "/usr", "/etc", "/dev", "/proc/sys/kernel", "/run", str(CHECKOUT / "course_pkg")]
CALLS = {  # A refused call returns -1, and any other call returns 0 or a positive number.
    "ptrace": "libc.ptrace(16, os.getppid(), 0, 0)",
    "unshare users": "libc.unshare(0x10000000)",
    "unshare network": "libc.unshare(0x40000000)",
    "mount": "libc.mount(b'none', b'/tmp', b'tmpfs', 0, None)",
    "umount": "libc.umount2(b'/student', 2)",
    "setuid": "libc.setuid(0)",
    "setgid": "libc.setgid(0)",
    "chroot": "libc.chroot(b'/tmp')",
    "mknod": "libc.mknod(b'/student/memory', 0o020666, (1 << 8) | 1)",
    "bpf": "libc.syscall(321, 0, 0, 0)",
    "keyctl": "libc.syscall(250, 0, -3, 0)",
    "perf_event_open": "libc.syscall(298, 0, 0, -1, -1, 0)",
    "io_uring": "libc.syscall(425, 1, 0)",
    "a new user namespace by clone": "libc.syscall(56, 0x10000000 | 17, 0, 0, 0, 0)",
    "a new user namespace by clone3": "libc.syscall(435, b'\\0' * 88, 88)",
    "setns": "libc.setns(os.open('/proc/self/ns/net', 0), 0)",
    "another process's memory": "libc.syscall(310, 1, 0, 0, 0, 0, 0)",
    "input into another terminal": "libc.ioctl(0, 0x5412, b'x')",
    "memory that no limit counts": "libc.memfd_create(b'hidden', 0)",
    "memory that stays after its process has ended": "libc.shmget(0, 4096, 0o1600)",
    "reboot": "libc.reboot(0x89ABCDEF)",
    "the clock": "libc.settimeofday(b'\\0' * 16, None)",
}
# The program starts ten child processes, and waits until stdin is closed. `before` is code that runs before
# the fork, and `after` is code that runs in each child process.
FORKED = """
import os, sys
{before}
for _ in range(10):
    if not os.fork():
        {after}
        os.write(1, b".")
        os.read(0, 1)
        os._exit(0)
os.read(0, 1)
"""


@pytest.fixture(scope="module")
def worker() -> Iterator[SandboxWorker]:
    """Run one sandbox worker, which all tests of this module use."""
    with SandboxWorker() as started:
        yield started


def told(worker: SandboxWorker, source: str) -> str:
    """Run a source as the answer of a submission, and return the error message of the cell."""
    job = PartJob("05.1", "", (textwrap.dedent(source),), "", 1, 1.0, 5.0, 10.0)
    said = [words["error"] for words in worker.run(job).messages if words["cell"].startswith("answer")]
    assert said, "the cell raised no error"
    return str(said[0])


def test_files_of_the_instructor_cannot_be_read(worker: SandboxWorker) -> None:
    """A submission cannot read solutions, checks, tests or files of the machine."""
    paths = [str(path) for path in READABLE]
    words = told(
        worker,
        f"""
        import os
        seen = []
        for path in {paths!r}:
            try:
                inside = os.listdir(path) if os.path.isdir(path) else open(path, "rb").read(1)
                seen += [path] if inside else []
            except OSError:
                pass
        raise RuntimeError(f"seen: {{seen}}")
        """,
    )
    assert words == "RuntimeError: seen: []"


def test_the_programs_of_the_course_are_hidden(worker: SandboxWorker) -> None:
    """A submission cannot import a program of the course, except for the programs that the part runs."""
    source = """
import importlib.util
found = []
for name in ("course_pkg.nodes.server", "course_pkg.nodes.simulator", "course_pkg.turtlesim.driving"):
    found.append(importlib.util.find_spec(name) is not None)
raise RuntimeError(found)
"""
    seen = {}
    for check in ("01.1", "05.1"):
        job = PartJob(check, "", (source,), "", 1, 1.0, 5.0, 10.0, hidden=find(check).hidden)
        seen[check] = [words["error"] for words in worker.run(job).messages if words["cell"] == "answer 1"]
    assert seen == {
        "01.1": ["RuntimeError: [True, False, False]"],
        "05.1": ["RuntimeError: [False, False, False]"],
    }


def test_no_check_is_in_memory(worker: SandboxWorker) -> None:
    """The memory of a student's process contains no check and no hint."""
    hint = next(answer.hint for answer in every_answer() if answer.check == "05.1" and not answer.right)
    words = told(
        worker,
        f"""
        import gc, sys
        modules = [name for name in sys.modules if ".checks" in name]
        half = {hint[: len(hint) // 2]!r}
        dicts = [value for value in gc.get_objects() if isinstance(value, dict)]
        texts = [value for each in dicts for value in list(each.values())
                 if type(value) is str and half in value and len(value) > len(half) + 5]
        raise RuntimeError(f"{{modules}} {{[text for text in texts if 'gc.get_objects' not in text]}}")
        """,
    )
    assert words == "RuntimeError: [] []"


def test_the_seed_of_the_check_is_not_in_memory(worker: SandboxWorker) -> None:
    """The memory of a student's process does not contain the seed of the check."""
    job = PartJob(
        "05.1",
        "",
        (
            """
import gc
from course_pkg.sandbox.job import PartJob
raise RuntimeError([each.seed for each in gc.get_objects() if isinstance(each, PartJob)])
""",
        ),
        "",
        987654321,
        1.0,
        5.0,
        10.0,
    )
    assert "987654321" not in str(worker.run(job).messages)


def test_only_the_parts_own_folders_are_writable(worker: SandboxWorker) -> None:
    """A submission cannot write files to the folders of the system or of the course."""
    words = told(
        worker,
        f"""
        import os
        written = []
        for folder in {WRITE!r}:
            try:
                open(os.path.join(folder, "planted"), "w").close()
                written.append(folder)
            except OSError:
                pass
        raise RuntimeError(f"{{written}}, {{os.access('/student', os.W_OK), os.access('/tmp', os.W_OK)}}")
        """,
    )
    assert words == "RuntimeError: [], (True, True)"


def test_only_a_private_network_exists(worker: SandboxWorker) -> None:
    """A submission cannot connect to servers on this machine or on other machines."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
        words = told(
            worker,
            f"""
            import socket
            reached = []
            for address in (("127.0.0.1", {port}), ("192.0.2.1", 80), ("::1", {port})):
                try:
                    socket.create_connection(address, timeout=1).close()
                    reached.append(address)
                except OSError:
                    pass
            raise RuntimeError(f"{{reached}} {{[name for _, name in socket.if_nameindex()]}}")
            """,
        )
    assert words == "RuntimeError: [] ['lo']"


ONE_CALL = """
from course_pkg.checking import CheckContext, part

@part("05.1.1", points=1, goal="Answer one call.", deadline=100.0)
def one_call(context: CheckContext) -> None:
    context.service("/getGeometry", "course_pkg/geometry", timeout=90.0)(length=1.0, width=1.0, height=1.0)
"""


def test_too_much_memory_during_the_check_is_the_reason(sandbox: None, tmp_path: Path) -> None:
    """If an answer uses too much memory during its check, the error in the result is about the memory.

    The error is not about a lost master.
    """
    source = """
        import os, time
        def handle_geometry(request):
            for _ in range(6):
                if os.fork() == 0:
                    kept = bytearray(b"x") * (150 << 20)
                    time.sleep(600)
            time.sleep(600)
        geometry_service = rospy.Service("/getGeometry", geometry, handle_geometry)
        """
    (tmp_path / "private_05.py").write_text(ONE_CALL)
    tmp_path.chmod(0o755)
    [before] = {answer.before for answer in every_answer() if answer.check == "05.1"}
    with SandboxWorker(private=str(tmp_path)) as worker:
        result = worker.run(PartJob("05.1.1", before, (textwrap.dedent(source),), "", 1, 100.0))
    assert (result.record, result.ending) == (None, "the answer used more memory than allowed")


def test_the_memory_that_forked_processes_share_counts_once() -> None:
    """Memory that processes share counts once, and memory that is not shared counts for each process."""
    shared = "kept = bytearray(b'x') * (40 << 20)"
    for before, after, more in ((shared, "pass", False), ("pass", shared, True)):
        command = [sys.executable, "-c", FORKED.format(before=before, after=after)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout
            assert process.stdout.read(10) == "." * 10
            assert too_much_memory_below(process.pid, 250 << 20) is more
            process.communicate("")


@pytest.mark.parametrize("call", CALLS)
def test_a_dangerous_system_call_is_refused(worker: SandboxWorker, call: str) -> None:
    """The Linux kernel refuses a dangerous system call."""
    if os.uname().machine != "x86_64" and "syscall" in CALLS[call]:
        pytest.skip("the numbers of these system calls are valid only on x86-64")
    words = told(
        worker,
        f"""
        import ctypes, os
        libc = ctypes.CDLL(None, use_errno=True)
        status = {CALLS[call]}
        if status == 0 and {call!r}.startswith("a new user"):
            os._exit(0)
        raise RuntimeError("refused" if status == -1 else f"BREACH: {{status}}")
        """,
    )
    assert words == "RuntimeError: refused"


def test_it_has_no_privileges_and_sees_only_its_own_processes(worker: SandboxWorker) -> None:
    """The student's process has no capabilities and sees only its own processes."""
    words = told(
        worker,
        """
        import os
        status = dict(line.split(":", 1) for line in open("/proc/self/status").read().splitlines())
        names = ("CapEff", "CapPrm", "CapBnd", "CapAmb", "NoNewPrivs", "Seccomp")
        pids = [name for name in os.listdir("/proc") if name.isdigit()]
        seen = [int(status[name], 16) for name in names]
        raise RuntimeError(seen + [len(pids) <= 2, os.getuid(), os.uname().nodename])
        """,
    )
    assert words == "RuntimeError: [0, 0, 0, 0, 1, 2, True, 1000, 'classroom']"


def test_an_answer_can_start_many_threads(worker: SandboxWorker) -> None:
    """An answer can start 50 threads that only wait."""
    words = told(
        worker,
        """
        import threading
        over = threading.Event()
        threads = [threading.Thread(target=over.wait, args=[9.0], daemon=True) for _ in range(50)]
        for thread in threads:
            thread.start()
        over.set()
        raise RuntimeError(f"{len(threads)} threads")
        """,
    )
    assert words == "RuntimeError: 50 threads"


def test_the_previous_answer_is_not_in_memory(worker: SandboxWorker) -> None:
    """The memory of a student's process does not contain the previous answer."""
    text = "\n".join(f"x{number} = 'QUAG' 'GA_{number:06}_OF_ONE'" for number in range(400))
    assert told(worker, text.replace("' '", "") + "\nraise RuntimeError('left')") == "RuntimeError: left"
    words = told(
        worker,
        """
        import re
        found = set()
        with open("/proc/self/mem", "rb", 0) as memory:
            for line in open("/proc/self/maps").read().splitlines():
                start, end = (int(part, 16) for part in line.split()[0].split("-"))
                if "r" not in line.split()[1] or "[v" in line:
                    continue
                try:
                    memory.seek(start)
                    found |= set(re.findall(b"QUAG" + b"GA_[0-9]{6}_OF", memory.read(end - start)))
                except (OSError, OverflowError, MemoryError):
                    continue
        raise RuntimeError(len(found))
        """,
    )
    assert words == "RuntimeError: 0"


def test_nothing_of_the_previous_part_remains(worker: SandboxWorker) -> None:
    """The files, processes and variables that one part creates do not exist in the next part."""
    leave = """
    import os
    open("/student/note", "w").close(); open("/tmp/note", "w").close(); open("/dev/shm/note", "w").close()
    if os.fork() == 0:
        os.setsid()
        import time; time.sleep(100)
    kept = 1
    raise RuntimeError("left")
    """
    look = """
    import os
    left = [path for path in ("/student/note", "/tmp/note", "/dev/shm/note") if os.path.exists(path)]
    pids = [name for name in os.listdir("/proc") if name.isdigit()]
    raise RuntimeError([left, len(pids) <= 2, "kept" in globals()])
    """
    assert told(worker, leave) == "RuntimeError: left"
    assert told(worker, look) == "RuntimeError: [[], True, False]"


def test_a_kernel_cannot_report_a_false_build(worker: SandboxWorker) -> None:
    """An answer cannot forge a successful build in the kernel, because another process runs the build."""
    wrong = next(answer for answer in every_answer() if answer.check == "04.3" and not answer.right)
    forged = """
from course_pkg.checking.commands.workbench import CommandFolders
CommandFolders.run = lambda *_, **__: {"status": 0, "out": "", "err": "", "took": 0.1}
"""
    job = PartJob(
        wrong.check, wrong.before + forged, (wrong.source,), wrong.after, 1, find(wrong.check).deadline
    )
    outcome = worker.run(job)
    assert outcome.record is not None
    assert outcome.record["verdict"] == "not yet"
    assert outcome.record["points"] == 0


def test_without_bubblewrap_grading_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without bubblewrap, require_sandbox() raises an error that contains advice."""
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(
        bubblewrap.SandboxUnavailable, match=r"apt-get install bubblewrap.*--unsafe-no-sandbox"
    ):
        bubblewrap.require_sandbox()
