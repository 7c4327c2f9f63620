"""Runs `course class` with a file of tokens, or as a service of a JupyterHub."""

from __future__ import annotations

import asyncio
import getpass
import hashlib
import hmac
import os
import secrets
import signal
import sqlite3
import sys
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets

from course_pkg.checking.parts import chapters as all_chapters
from course_pkg.checking.parts import parts_of, title_of
from course_pkg.class_view.identity import HubIdentity, HubService, LocalIdentity
from course_pkg.class_view.pages import LARGEST, Chapter, application
from course_pkg.class_view.service import ClassService, Settings
from course_pkg.class_view.storage import Storage
from course_pkg.class_view.tokens import FILE, Tokens, names_from, write_privately
from course_pkg.errors import ClassViewError
from course_pkg.state import locked, state_folder

SECRET = "secret"  # noqa: S105 -- the name of the file with the secret
LOCK = "service"  # The running service locks this folder inside the data folder.


def serve_class(options: SimpleNamespace) -> int:
    """Serve the page until Ctrl-C or SIGTERM; return the exit status.

    Raises ClassViewError if the service cannot start.
    """
    data = options.data or state_folder() / "class"
    hub = HubService.of(os.environ)
    names = names_from(options.roster, options.students or 0)
    try:
        with locked(data / LOCK, 0):
            secret = _secret(data)
            storage = Storage(data)
            try:
                asyncio.run(_serve(options, data, hub, secret, storage, names))
            finally:
                storage.close()
    except TimeoutError as error:
        raise ClassViewError(
            f"Another `course class` command uses {data}. End that command, or choose a different "
            "folder with the option --data."
        ) from error
    except OSError as error:
        raise ClassViewError(
            f"{data} cannot be used ({error.strerror}). Choose a different folder with the option --data."
        ) from error
    return 0


def delete_student(data: Path | None, student: str) -> int:
    """Delete the results and the token of a student; return the exit status."""
    folder = data or state_folder() / "class"
    if not folder.is_dir():
        raise ClassViewError(
            f"There is no folder {folder}. Set the folder of the class view with the option --data."
        )
    storage = Storage(folder)
    try:
        deleted = storage.delete(student)
    except sqlite3.Error as error:
        raise ClassViewError(f"{storage.path} cannot be changed ({error}).") from error
    finally:
        storage.close()
    had_token = Tokens(folder / FILE).remove(student)
    if not deleted and not had_token:
        raise ClassViewError(f"{folder} contains nothing about {student!r}.")
    sys.stdout.write(f"Deleted {deleted} results{' and the token' if had_token else ''} of {student}.\n")
    return 0


async def _serve(
    options: SimpleNamespace,
    data: Path,
    hub: HubService | None,
    secret: str,
    storage: Storage,
    names: dict[str, str],
) -> None:
    tokens = Tokens(data / FILE)
    teacher_token = hmac.new(secret.encode(), b"teacher", hashlib.sha256).hexdigest()
    if hub is None:
        tokens.complete(names)
        if not tokens.names:
            raise ClassViewError(
                "There are no students. Use the option --roster FILE for a file with their "
                "usernames, or --students N for N students."
            )
        names = dict(tokens.names)
    identity = HubIdentity(hub) if hub else LocalIdentity(tokens, teacher_token)
    teacher = options.teacher or ("the teachers of this hub" if hub else getpass.getuser())
    service = ClassService(storage, identity, Settings(teacher, options.days, names))
    prefix = hub.prefix if hub else "/"
    ip, port = _address(options)
    try:
        listening = bind_sockets(port, ip)
    except (OSError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ClassViewError(
            f"{ip}:{port} cannot be used ({reason}). Choose a different port with the option "
            "--port, or a different address with the option --ip."
        ) from error
    server = HTTPServer(application(service, prefix, secret, every_chapter()), max_body_size=2 * LARGEST)
    server.add_sockets(listening)
    if hub is None:
        host = f"[{ip}]" if ":" in ip else ip
        url = f"http://{host}:{listening[0].getsockname()[1]}"
        sys.stdout.write(_instructions(url, teacher_token, tokens, ip))
        sys.stdout.flush()
    ended = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, ended.set)
    watching = asyncio.create_task(service.watch())
    await ended.wait()
    watching.cancel()
    server.stop()


def _address(options: SimpleNamespace) -> tuple[str, int]:
    """Return the address and port of the service, from the hub or from the options."""
    if url := os.environ.get("JUPYTERHUB_SERVICE_URL", ""):
        parts = urlsplit(url)
        return parts.hostname or options.ip, parts.port or options.port
    return options.ip, options.port


def _instructions(url: str, teacher_token: str, tokens: Tokens, ip: str) -> str:
    far = (
        ""
        if ip in ("127.0.0.1", "::1", "localhost")
        else "Note: HTTP is not encrypted. Use a network that only your class can reach.\n"
    )
    return (
        f"The page for the teacher: {url}/?token={teacher_token}\nThe tokens of {len(tokens.names)} "
        f"students: {tokens.path}\nEach student types: COURSE_CLASS_URL={url} COURSE_CLASS_TOKEN=TOKEN "
        f"./course lab\n{far}Ctrl-C ends the service.\n"
    )


def _secret(data: Path) -> str:
    """Return the secret that signs cookies; a file in the folder `data` stores it between restarts."""
    path = data / SECRET
    if not path.exists():
        write_privately(path, secrets.token_hex(32))
    return path.read_text("utf-8").strip()


def every_chapter() -> list[Chapter]:
    """Return the chapters of the course with their parts."""
    return [
        Chapter(number, title_of(number), [(part.check, part.goal) for part in parts_of(number)])
        for number in all_chapters()
    ]
