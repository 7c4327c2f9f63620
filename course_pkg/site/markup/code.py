"""Code as HTML with colours. The HTML has little markup, because a page contains much code."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from html import escape
from itertools import groupby

from pygments.lexer import Lexer
from pygments.lexers import get_lexer_by_name
from pygments.token import Comment, Keyword, Name, Number, Operator, String, _TokenType
from pygments.util import ClassNotFound

# These kinds of tokens get a colour; a subtype comes before its parent type. The letters are CSS classes in
# site.css.
COLOURS = (
    (Comment, "c"),
    (String.Doc, "c"),
    (String, "s"),
    (Number, "m"),
    (Keyword, "k"),
    (Operator.Word, "k"),
    (Name.Function, "f"),
    (Name.Class, "f"),
    (Name.Decorator, "f"),
    (Name.Tag, "k"),
    (Name.Attribute, "f"),
    (Name.Builtin, "b"),
    (Name.Exception, "b"),
)
MAGIC = re.compile(r"%%(?P<name>\w+)[ \t]*(?P<rest>.*)\n")
SHELLS = ("bash", "sh", "script")
FILES = {
    "CMakeLists.txt": "cmake",
    "launch": "xml",
    "py": "python",
    "sh": "bash",
    "xml": "xml",
    "yaml": "yaml",
}


class Highlighter:
    """Adds colours to cells and to fenced blocks.

    The lexer of a language is created at its first use.
    """

    def __init__(self) -> None:
        self._lexers: dict[str, Lexer] = {}

    def cell(self, source: str) -> str:
        """Return a code cell as HTML.

        The first line of the cell can be a magic with the name of another language; otherwise, the cell
        contains Python.
        """
        magic = MAGIC.match(source)
        if not magic:
            return self.block(source, "ipython3")
        first, rest = source[: magic.end()], source[magic.end() :]
        return f"<i class=k>{escape(first, quote=False)}</i>" + self.block(rest, _language(magic))

    def block(self, source: str, language: str) -> str:
        """Return the code `source` as HTML. The HTML has colours if Pygments knows `language`."""
        lexer = self._lexer(language)
        coloured = ((_colour(kind), text) for kind, text in lexer.get_tokens(source.rstrip("\n")))
        return "".join(_runs(coloured)).rstrip("\n")

    def _lexer(self, language: str) -> Lexer:
        if language not in self._lexers:
            self._lexers[language] = _lexer_of(language)
        return self._lexers[language]


def _language(magic: re.Match[str]) -> str:
    if magic["name"] == "writefile":
        file = magic["rest"].rpartition("/")[2].strip()
        return FILES.get(file) or FILES.get(file.rpartition(".")[2], "text")
    return "bash" if magic["name"] in SHELLS else "ipython3"


def _lexer_of(language: str) -> Lexer:
    try:
        return get_lexer_by_name(language, stripnl=False)
    except ClassNotFound:
        return get_lexer_by_name("text", stripnl=False)


@cache
def _colour(kind: _TokenType) -> str:
    return next((name for coloured, name in COLOURS if kind in coloured), "")


def _runs(coloured: Iterator[tuple[str, str]]) -> Iterator[str]:
    """Join adjacent tokens of the same colour into one HTML element; white space gets no element."""
    for name, run in groupby(coloured, key=lambda pair: pair[0]):
        text = escape("".join(text for _, text in run), quote=False)
        yield f"<i class={name}>{text}</i>" if name else text
