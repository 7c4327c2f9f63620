"""The command `course hub` and its options."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _hub(options: SimpleNamespace) -> int:
    from course_pkg.hub.start import Options, renew_password, serve_hub

    given = {name: value for name, value in vars(options).items() if name not in ("command", "new_password")}
    if options.new_password:
        return renew_password(options.new_password, options.data)
    return serve_hub(Options(**given))


def _hub_arguments(parser: ArgumentParser) -> None:
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument(
        "--users",
        type=Path,
        metavar="FILE",
        help="the students: one user name in each line, or a CSV file with a column `username`",
    )
    which.add_argument(
        "--new-password",
        metavar="USER",
        help="print a new one-time password for USER, but do not start a hub",
    )
    parser.add_argument(
        "--port", type=int, help="the port on which the hub listens (default: 8000, or the next free port)"
    )
    parser.add_argument(
        "--ip", default="127.0.0.1", help=("the address on which the hub listens (default: 127.0.0.1)")
    )
    parser.add_argument("--cert", type=Path, metavar="FILE", help="the TLS certificate, in PEM format")
    parser.add_argument("--key", type=Path, metavar="FILE", help="the private key of the certificate")
    parser.add_argument("--teacher", default="", metavar="USER", help="a user who administers the hub")
    parser.add_argument(
        "--without-accounts",
        type=Path,
        metavar="DIR",
        help=(
            "use this option only to try the hub: all servers run under your account, and the home folders "
            "are in DIR"
        ),
    )
    parser.add_argument(
        "--memory",
        type=int,
        default=1024,
        metavar="MIB",
        help=("the memory limit for each student, in MiB (default: 1024)"),
    )
    parser.add_argument(
        "--processes",
        type=int,
        default=500,
        metavar="N",
        help="the largest number of processes and threads for each student (default: 500)",
    )
    parser.add_argument(
        "--data", type=Path, metavar="DIR", help="the folder for the hub's passwords, database and log"
    )


COMMANDS = {
    "hub": Command(
        "start a JupyterHub for a class on this machine",
        _hub,
        frozenset({"course", "libraries", "hub"}),
        _hub_arguments,
    ),
}
