"""Run the commands of `course`.

Each package declares its commands in its module `commands.py`. This module imports only the standard library
and the modules `commands.py`. Therefore, any Python interpreter can run this module before the set-up of the
course. A command imports other modules when it runs.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING, NoReturn

from course_pkg.authoring import commands as authoring
from course_pkg.class_view import commands as class_view
from course_pkg.errors import CourseError
from course_pkg.grading import commands as grading
from course_pkg.handout import commands as handout
from course_pkg.hub import commands as hub
from course_pkg.installation import commands as installation
from course_pkg.lab import commands as lab
from course_pkg.overview import commands as overview
from course_pkg.setup import commands as setup
from course_pkg.setup.commands import UNSAFE, Command
from course_pkg.site import commands as site

if TYPE_CHECKING:
    from argparse import ArgumentParser

INSIDE = "COURSE_INSIDE"  # This variable is set if the environment's Python interpreter runs this module.
COMMANDS: dict[str, Command] = {
    **lab.COMMANDS,
    **overview.COMMANDS,
    **authoring.COMMANDS,
    **grading.COMMANDS,
    **handout.COMMANDS,
    **class_view.COMMANDS,
    **hub.COMMANDS,
    **installation.COMMANDS,
    **site.COMMANDS,
    **setup.COMMANDS,
}


def main(argv: Sequence[str] | None = None) -> NoReturn:
    """Set up the environment for a command, run the command, and exit with its status."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    try:
        sys.exit(_dispatch(arguments))
    except CourseError as error:
        sys.exit(f"course: {error}")
    except KeyboardInterrupt:
        sys.exit(130)


def parse(arguments: Sequence[str]) -> SimpleNamespace:
    """Return the parsed `arguments`; for wrong arguments, print the usage and exit with status 2."""
    name = arguments[0] if arguments else ""
    if name in COMMANDS and COMMANDS[name].rest and arguments[1:2] not in (["-h"], ["--help"]):
        rest = list(arguments[1:])
        if not rest and not COMMANDS[name].rest.startswith("["):
            _parsers()[0].parse_args([name, "--help"])
        return SimpleNamespace(command=name, rest=rest)
    return _parsers()[0].parse_args(arguments, SimpleNamespace())


def _parsers() -> tuple[ArgumentParser, Mapping[str, ArgumentParser]]:
    """Return the parser of `course`, and the parser of each subcommand."""
    # Import argparse only here: the import takes 10 ms, and the command `run` does not need it.
    from argparse import ArgumentParser

    parser = ArgumentParser(
        prog="course",
        description="A course on ROS 1 services.",
        epilog="`course COMMAND --help` shows the options of a command.",
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, command in COMMANDS.items():
        usage = f"course {name} {command.rest}" if command.rest else None
        description = f"{command.summary[0].upper()}{command.summary[1:]}."
        sub = commands.add_parser(name, help=command.summary, description=description, usage=usage)
        if command.add_arguments:
            command.add_arguments(sub)
    return parser, commands.choices


def _print_completion(_options: SimpleNamespace) -> int:
    from course_pkg.setup.completion import bash_completion

    sys.stdout.write(bash_completion(_parsers()[1]))
    return 0


def _dispatch(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    command = COMMANDS[options.command]
    if "solutions" in command.needs:
        from course_pkg.setup.edition import require_solutions
        from course_pkg.setup.places import Places

        require_solutions(Places.of().checkout, options.command)
    if command.needs:
        _enter_environment(command, arguments)
    return command.run(options)


def _enter_environment(command: Command, arguments: Sequence[str]) -> None:
    """Create the missing parts of the environment, and set the environment's variables.

    If the command imports libraries, replace this process by the Python interpreter of the virtual
    environment.
    """
    from course_pkg.setup import Places, ensure, environment

    places = Places.of()
    if os.environ.get(INSIDE) == str(places.python):
        return
    sandbox = "grade" in command.needs and UNSAFE not in arguments
    ensure(places, grade=sandbox, hub="hub" in command.needs, test="test" in command.needs)
    environment.apply(places)
    if "libraries" in command.needs:
        os.environ[INSIDE] = str(places.python)
        os.execv(places.python, [str(places.python), "-m", "course_pkg.cli", *arguments])  # noqa: S606


COMMANDS["completion"] = Command("print the completion for bash", _print_completion, frozenset())

if __name__ == "__main__":
    main()
