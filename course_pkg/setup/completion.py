"""The tab completion of `course` in bash: the subcommands, their options, and the names of files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser

SCRIPT = """\
# Completion of `course` for bash, printed by `course completion`.
_course() {
    local current=${COMP_WORDS[COMP_CWORD]} words=
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "@COMMANDS@" -- "$current"))
        return
    fi
    case ${COMP_WORDS[1]} in
@CASES@
    esac
    if [ "${COMP_WORDS[1]}" = run ] && [ "$COMP_CWORD" -eq 2 ]; then
        COMPREPLY=($(compgen -c -- "$current"))
    elif [ "${current:0:1}" = - ]; then
        COMPREPLY=($(compgen -W "$words" -- "$current"))
    fi
}
complete -o default -F _course course
"""


def bash_completion(parsers: Mapping[str, ArgumentParser]) -> str:
    """Return the script for bash; `parsers` has the parser of each subcommand."""
    cases = (f'        {name}) words="{" ".join(_options(each))}" ;;' for name, each in parsers.items())
    return SCRIPT.replace("@COMMANDS@", " ".join(parsers)).replace("@CASES@", "\n".join(cases))


def _options(parser: ArgumentParser) -> Iterator[str]:
    for action in parser._actions:
        yield from (option for option in action.option_strings if option.startswith("--"))
