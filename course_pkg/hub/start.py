"""`course hub`: prepares a JupyterHub for a class, and runs it until Ctrl-C."""

from __future__ import annotations

import ipaddress
import os
import signal
import socket
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from course_pkg.errors import HubError
from course_pkg.handout.homes.listing import read_students
from course_pkg.hub import limits
from course_pkg.hub.accounts import check_names, home_problems, make_accounts
from course_pkg.hub.delivery import write_repository
from course_pkg.hub.passwords import Passwords, add_to_table
from course_pkg.hub.settings import SCRATCH, VARIABLE, Settings
from course_pkg.hub.tools import DEPLOY, installed_proxy, self_signed
from course_pkg.installed import version_folder
from course_pkg.lab.jupyterlab import server_port
from course_pkg.ports import free_port
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.setup import Places, environment
from course_pkg.setup.network import network_problem
from course_pkg.state import locked

PORTS = (*range(8000, 8020), 0)  # the ports to try; 0 means any free port
ORDINARY = "nobody"  # Each system has an account with this name; the account has no special rights.
GRACE = 20.0  # The hub has to end the students' servers within this time in s.


@dataclass(frozen=True)
class Options:
    """The options of the command line."""

    users: Path
    port: int | None
    ip: str
    cert: Path | None
    key: Path | None
    teacher: str
    without_accounts: Path | None
    memory: int  # The memory is in MiB.
    processes: int
    data: Path | None = None


def serve_hub(options: Options) -> int:
    """Prepare the hub, print its address, and run it until Ctrl-C; return 0 or the hub's exit status.

    Raises HubError or HandoutError if an option is wrong, or if this machine cannot run the hub. In both
    cases, nothing has been started yet.
    """
    places = Places.of()
    base = data_folder(places, options.data)
    state = _private(base)
    students = read_students(options.users)
    everybody = [*dict.fromkeys([*students, *filter(None, [options.teacher])])]
    check_names(everybody)
    with _only_hub(state):
        homes = str(options.without_accounts.absolute()) if options.without_accounts else ""
        if not homes:
            _require_protection(places)
            for name in make_accounts(everybody):
                sys.stdout.write(f"Created the account {name}.\n")
            for problem in home_problems(everybody):
                sys.stdout.write(f"{problem}\n")
        cert, key = _certificate(options, state)
        port = server_port(options.ip, PORTS if options.port is None else [options.port])
        scheme = "https" if cert else "http"
        repository = base / "released" / "ros-course"
        write_repository(places, repository)
        settings = Settings(
            state=str(state),
            released=str(repository),
            proxy=str(installed_proxy(places)),
            url=f"{scheme}://{_in_url(options.ip)}:{port}",
            hub_port=free_port(),
            proxy_port=free_port(),
            students=tuple(everybody),
            teacher=options.teacher,
            homes=homes,
            memory=options.memory,
            processes=options.processes,
            class_port=free_port() if find_spec("course_pkg.class_view") else 0,
            cert=cert,
            key=key,
            environment=_student_environment(places, repository),
        )
        table = state / "passwords.csv"
        issued = Passwords(state / "passwords.json").issue(everybody)
        add_to_table(table, issued)
        chosen = limits.Limits(options.memory, options.processes)
        sys.stdout.write(f"{limits.describe(chosen, limits.group_of_hub(), not homes)}\n")
        problem, remedy = network_problem(None if homes else ORDINARY)
        if problem:
            sys.stdout.write(
                f"The students get no private networks ({problem}). Therefore, all users of this machine can "
                f"call, replace and stop the students' nodes. {remedy}.\n"
            )
        if homes:
            sys.stdout.write("All servers run under your account, so students can read each other's files.\n")
        sys.stdout.write(
            f"One-time passwords: {table}\nThe hub for {len(students)} students starts. Its address is\n\n "
            f"   {scheme}://{_in_url(reached_at(options.ip))}:{port}\n\nPress Ctrl-C in this terminal to end "
            "the hub and all servers.\n"
        )
        sys.stdout.flush()
        return _run(places, settings)


def renew_password(user: str, data: Path | None) -> int:
    """Print a new one-time password and return 0; a running hub accepts the password at once.

    `user` is the name of the student.
    """
    check_names([user])
    state = _private(data_folder(Places.of(), data))
    issued = Passwords(state / "passwords.json").issue([user], again=True)
    add_to_table(state / "passwords.csv", issued)
    sys.stdout.write(f"{issued[user]}\n")
    return 0


def data_folder(places: Places, given: Path | None) -> Path:
    """Return the folder of the hub's data. Students can read this folder, except its subfolder `private`.

    In a shared installation, the hub's data are next to the folders of the versions. An upgrade therefore
    does not delete them.
    """
    version = version_folder(places.checkout)
    return (given or (version.parents[1] if version else places.cache) / "hub").absolute()


def _private(data: Path) -> Path:
    """Return the folder for passwords, keys and the database, which only the hub can read."""
    folder = data / "private"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
    except OSError as error:
        raise HubError(f"{folder} cannot be used ({error.strerror}). Start the hub with sudo.") from error
    return folder


@contextmanager
def _only_hub(state: Path) -> Iterator[None]:
    """Raise HubError if another hub of this installation is running."""
    with ExitStack() as stack:
        try:
            stack.enter_context(locked(state / "running", 0))
        except TimeoutError as error:
            raise HubError(
                "Another hub of this installation is running. First end this hub with Ctrl-C in its terminal."
            ) from error
        yield


def _require_protection(places: Places) -> None:
    """Raise HubError if students cannot read the installation, or can read the solutions."""
    for folder in (places.python, places.environment, places.checkout / "course_pkg"):
        if closed := _closed(folder):
            raise HubError(
                f"The students' accounts need the files in {closed}, but cannot read them. Install the "
                "course in a folder that everybody can read, such as /opt/ros-course, and set "
                "XDG_CACHE_HOME=/opt/cache."
            )
    for name in ("solutions", "tests"):
        folder = places.checkout / name
        if folder.exists() and not _closed(folder):
            raise HubError(
                f"Students can read {folder}, but this folder has to be private. Type `chmod 700 "
                f"{folder}`, or start the hub in the folder that `course release` wrote. Then start "
                "the hub again."
            )


def _closed(path: Path) -> Path | None:
    """Return the first folder or file on the path `path` that other users cannot open.

    The result is a folder that other users cannot enter, or the file `path` that they cannot read. The result
    is None if other users can read `path`.
    """
    for each in (*reversed(path.parents), path):
        mode = each.stat().st_mode
        if not mode & (stat.S_IXOTH if stat.S_ISDIR(mode) else stat.S_IROTH):
            return each
    return None


def _certificate(options: Options, state: Path) -> tuple[str, str]:
    """Return the files of the certificate and of its key; both are "" if the hub is bound to loopback."""
    if (options.cert is None) != (options.key is None):
        raise HubError("The options --cert and --key belong together. Give both options.")
    if options.cert and options.key:
        missing = [str(path) for path in (options.cert, options.key) if not path.is_file()]
        if missing:
            raise HubError(f"There is no file {' and no file '.join(missing)}.")
        return str(options.cert.absolute()), str(options.key.absolute())
    try:
        loopback = ipaddress.ip_address(options.ip).is_loopback
    except ValueError as error:
        raise HubError(
            f"--ip {options.ip} is not an IP address. Give an address such as 127.0.0.1."
        ) from error
    if loopback:
        return "", ""
    cert, key = self_signed(state, reached_at(options.ip))
    sys.stdout.write(
        "The hub uses a self-signed certificate, so browsers show a warning. For a course, get a "
        "certificate for the machine's name, and use it with --cert and --key.\n"
    )
    return str(cert), str(key)


def reached_at(ip: str) -> str:
    """Return the address that students type for a hub that listens on `ip`.

    If `ip` means all addresses of the machine, such as 0.0.0.0, the address is the machine's name.
    """
    return socket.getfqdn() if ipaddress.ip_address(ip).is_unspecified else ip


def _in_url(ip: str) -> str:
    return f"[{ip}]" if ":" in ip else ip


def _student_environment(places: Places, repository: Path) -> dict[str, str]:
    """Return the variables of the course for the students' servers."""
    variables = environment.merged(places, {"PATH": os.defpath})
    variables.pop("ROS_LOG_DIR")
    # The kernels' sockets are in this folder. Its path is short, because a socket's path has at most 107
    # bytes on Linux. The hub's supervisor deletes this folder.
    scratch = Path(tempfile.mkdtemp(prefix="course-hub-", dir="/tmp"))
    # These are the permissions of /tmp: each student can create a folder, and only the folder's owner can
    # delete it.
    scratch.chmod(0o1777)
    return {**variables, "COURSE_RELEASED": str(repository), SCRATCH: str(scratch)}


def _run(places: Places, settings: Settings) -> int:
    config = places.checkout / DEPLOY / "jupyterhub_config.py"
    command = [str(places.python), "-m", "jupyterhub", "-f", str(config)]
    variables = {**os.environ, VARIABLE: str(settings.write())}
    variables.pop("ROS_MASTER_URI", None)
    received: list[int] = []
    kept = {
        number: signal.signal(number, lambda number, _frame: received.append(number))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    }
    log = Path(settings.state) / "hub.log"
    try:
        with log.open("ab") as output:
            hub = SupervisedProcess(
                command,
                output=output,
                env=variables,
                cwd=Path(settings.state),
                remove=Path(settings.environment[SCRATCH]),
            )
            try:
                while not received and not hub.wait(0.5):
                    pass
            finally:
                hub.end(grace=GRACE)
    finally:
        for number, handler in kept.items():
            signal.signal(number, handler)
    if received:
        return 0
    sys.stderr.write(f"The hub has ended. Its messages are in {log}.\n")
    return hub.returncode or 1
