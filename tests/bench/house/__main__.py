"""Measures the code and the content of the chapters, and compares each number with its limit.

usage: ./course run python -m tests.bench.house SUBCOMMAND

- `size`, `imports`, `types`, `functions` and `hints` measure the code; `code` runs these five subcommands.
- `objects`, `names`, `parts`, `errors` and `prose` count objects, names, graded parts, lines of errors and
  words in the notebooks of `solutions/`; `content` runs these five subcommands.

`course test` installs import-linter, which `imports` needs. `size` counts lines after `ruff format`.
"""

from __future__ import annotations

from tests.bench.commands import run_command
from tests.bench.house import content, structure

if __name__ == "__main__":
    run_command(
        {
            "size": structure.size_main,
            "imports": structure.imports_main,
            "types": structure.types_main,
            "functions": structure.functions_main,
            "hints": structure.hints_main,
            "code": structure.all_main,
            "objects": content.objects_main,
            "names": content.names_main,
            "parts": content.parts_main,
            "errors": content.errors_main,
            "prose": content.prose_main,
            "content": content.all_main,
        }
    )
