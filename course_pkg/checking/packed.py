"""Pack the source of checks for the students' edition.

The source of a check contains answers, such as expected values and files of a package. `check()` needs this
source on the student's computer. Packing hides the answers: students do not find them by accident or with a
search. Students can still unpack the source deliberately.
"""

from __future__ import annotations

import base64
import textwrap
import zlib

WIDTH = 100  # A line of the packed source has at most this number of characters.
MODULE = '''"""Packed by `course release`, because the source of a check contains answers."""

from course_pkg.checking.packed import load

load(
    globals(),
    """
{}
""",
)
'''


def pack(source: str) -> str:
    """Return packed source; a module with the packed source does the same as the original module."""
    packed = base64.b85encode(zlib.compress(source.encode(), 9)).decode()
    return MODULE.format("\n".join(textwrap.wrap(packed, WIDTH, break_on_hyphens=False)))


def unpack(packed: str) -> str:
    """Return the source that was passed to pack()."""
    return zlib.decompress(base64.b85decode("".join(packed.split()))).decode()


def load(module: dict[str, object], packed: str) -> None:
    """Run packed source as the code of a module; `module` is the dict of the module's global names."""
    code = compile(unpack(packed), str(module["__file__"]), "exec", dont_inherit=True)
    exec(code, module)  # noqa: S102 -- it is the module's own source
