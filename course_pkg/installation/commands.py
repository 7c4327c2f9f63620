"""The command-line arguments of `course install`, `course uninstall` and `course bundle`."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

from course_pkg.setup.commands import Command

if TYPE_CHECKING:
    from argparse import ArgumentParser


def _install(options: SimpleNamespace) -> int:
    from course_pkg.installation.install import install

    return install(options.prefix, options.bin)


def _prefix_argument(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--prefix",
        type=Path,
        metavar="DIR",
        help=("the installation's folder (default: /opt/ros-services-course)"),
    )


def _install_arguments(parser: ArgumentParser) -> None:
    _prefix_argument(parser)
    parser.add_argument(
        "--bin",
        type=Path,
        metavar="DIR",
        help=(
            "the folder for the command `course` (default: /usr/local/bin, or ~/.local/bin if you are not "
            "root)"
        ),
    )


def _uninstall(options: SimpleNamespace) -> int:
    from course_pkg.installation.uninstall import uninstall

    return uninstall(options.prefix, force=options.force)


def _uninstall_arguments(parser: ArgumentParser) -> None:
    _prefix_argument(parser)
    parser.add_argument(
        "--force", action="store_true", help="remove the installation even if users work with it now"
    )


def _bundle(options: SimpleNamespace) -> int:
    from course_pkg.installation.bundle import write_bundle

    return write_bundle(options.out)


def _bundle_arguments(parser: ArgumentParser) -> None:
    parser.add_argument(
        "out", metavar="OUT", type=Path, help=("the folder for the installer; it must be new or empty")
    )


COMMANDS = {
    "install": Command(
        "install the course for all users of this machine", _install, frozenset(), _install_arguments
    ),
    "uninstall": Command(
        "remove the installation that `course install` made, but keep the users' own folders",
        _uninstall,
        frozenset(),
        _uninstall_arguments,
    ),
    "bundle": Command(
        "write an installer for machines without internet", _bundle, frozenset(), _bundle_arguments
    ),
}
