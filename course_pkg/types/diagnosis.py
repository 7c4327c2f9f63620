"""Find the first mistake in the text of a definition; return its line and a correction.

genmsg stops at the first line that it cannot read, and its error message often does not show this line. This
module therefore checks each line for common mistakes first.
"""

from __future__ import annotations

import ast
import difflib
import keyword
import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field

from course_pkg.errors import BrokenDefinition
from course_pkg.types.definition import Line, Word, lines
from course_pkg.types.fields import integer_range
from course_pkg.types.search_path import DefinitionKind, closest, list_message_types

_BUILTIN = (
    *(f"{sign}int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "u")),
    *("float32", "float64", "bool", "string", "time", "duration", "char", "byte"),
)
_FROM_ELSEWHERE = {
    "int": "int32",
    "integer": "int32",
    "long": "int64",
    "short": "int16",
    "unsigned": "uint32",
    "uint": "uint32",
    "size_t": "uint64",
    "float": "float32",
    "double": "float64",
    "number": "float64",
    "str": "string",
    "text": "string",
    "boolean": "bool",
    "bytes": "uint8[]",
    "list": "float64[]",
}
_TYPE = re.compile(r"([A-Za-z]\w*(?:/[A-Za-z]\w*)?)((?:\[\d*\])?)", re.ASCII)
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
# Every class that genpy generates has these methods, so no field can have such a name.
_METHODS = frozenset({"serialize", "deserialize", "serialize_numpy", "deserialize_numpy"})


def validate(
    text: str, source: str, package: str, kind: DefinitionKind, exists: Callable[[str], bool], strict: bool
) -> None:
    """Raise BrokenDefinition for the first mistake in a .srv or .msg text.

    `exists` returns whether there is a message type with the given full name. If `strict` is true, mistakes
    that genmsg accepts are also refused.
    """
    _Diagnosis(source, package, kind, exists, strict).read(text)


@dataclass
class _Diagnosis:
    source: str
    package: str
    kind: DefinitionKind
    exists: Callable[[str], bool]
    strict: bool
    separators: int = 0
    names: dict[str, int] = field(default_factory=dict)

    def read(self, text: str) -> None:
        last = Line(1, "")
        for last in lines(text):
            if last.is_separator or re.fullmatch(
                r"[-\N{EN DASH}\N{EM DASH}_=\s]*[-\N{EN DASH}\N{EM DASH}_=]\s*", last.code
            ):
                self._separator(last)
            elif last.is_constant:
                self._constant(last)
            elif last.code.strip():
                self._field(last)
        if self.kind == "srv" and self.strict and not self.separators:
            raise self._broken(
                last, 1, "no line separates the request from the response", "add a line of three dashes, ---"
            )

    def _separator(self, line: Line) -> None:
        column = len(line.text) - len(line.text.lstrip()) + 1
        if self.kind == "msg":
            raise self._broken(
                line,
                column,
                "a message cannot have a --- line",
                "remove this line, or define a service instead",
            )
        if not line.is_separator:
            advice = "write --- at the beginning of the line, without spaces"
            raise self._broken(line, column, "this is not a line of three dashes", advice)
        if self.strict and line.code.strip() != "---":
            raise self._broken(
                line, 4, "there is something after the three dashes", "write --- alone on its line"
            )
        if self.strict and self.separators:
            raise self._broken(
                line, 1, "a second --- line", "remove it: a service has two parts, request and response"
            )
        self.separators += 1
        self.names = {}

    def _field(self, line: Line) -> None:
        words = line.words()
        if words[0].text.startswith(("//", "/*", "*", ";")):
            problem = f"{words[0].text!r} does not begin a comment here"
            raise self._broken(line, words[0].column, problem, "write # instead")
        if len(words) != 2:
            raise self._wrong_count(line, words)
        type_word, name = words
        self._type(line, type_word, name)
        self._name(line, name)

    def _wrong_count(self, line: Line, words: list[Word]) -> BrokenDefinition:
        first = words[0]
        if "\t" in first.text:
            column = first.column + first.text.index("\t")
            return self._broken(
                line,
                column,
                "there is a tab between type and name",
                "write a space, as ROS requires",
            )
        if len(words) == 1:
            end = first.column + len(first.text)
            return self._broken(
                line, end, f"a name is missing after {first.text}", f"write {first.text} and a name"
            )
        advice = "write one field in each line, its type and its name"
        if words[1].text.startswith("["):
            advice = f"write {first.text}{words[1].text} {words[2].text}"
        elif first.text in ("unsigned", "long", "signed"):
            whole = " ".join(word.text for word in words[:-1])
            sign = "u" if first.text == "unsigned" else ""
            size = "64" if "long" in whole else "32"
            advice = f"write {sign}int{size} {words[-1].text}"
        elif len(words) == 3 and words[2].text[:1] in "+-.0123456789":
            default, constant = words[2].text, words[1].text.upper()
            advice = (
                f"write {first.text} {words[1].text}, which is 0 by default, or {first.text} "
                f"{constant}={default}"
            )
        elif words[1].text.endswith(",") or "," in words[2].text:
            advice = "write one field in each line, without commas"
        elif all(_NAME.fullmatch(word.text) for word in words[1:]):
            advice = f"write {first.text} {'_'.join(word.text for word in words[1:])}, or # before a comment"
        return self._broken(line, words[2].column, "there is more than a type and a name", advice)

    def _type(self, line: Line, word: Word, name: Word) -> None:
        found = _TYPE.fullmatch(word.text)
        if not found:
            raise self._broken(
                line, word.column, f"{word.text!r} cannot be a type", self._type_advice(word.text, name.text)
            )
        base = found[1]
        # genmsg replaces Header with std_msgs/Header, but not in an array.
        if base in _BUILTIN or word.text == "Header":
            return
        full = base if "/" in base else f"{self.package}/{base}"
        if not self.exists(full):
            raise self._broken(
                line, word.column, f"unknown type {base!r}", self._known_advice(base, found[2], name.text)
            )

    def _type_advice(self, text: str, name: str) -> str:
        if text.count("[") > 1:
            return "write one pair of brackets; for an array of arrays, use a message that contains an array"
        if text.endswith(":"):
            return f"write the type first, then the name, without a colon: {name} {text[:-1]}"
        if "[" in text and "]" in text:
            return "write the length in brackets as a number, as in float32[3], or leave the brackets empty"
        return "write a type such as float32, string, or geometry_msgs/Point"

    def _known_advice(self, base: str, brackets: str, name: str) -> str:
        if name in _BUILTIN:
            return f"write the type first: {name} {base}"
        if known := _FROM_ELSEWHERE.get(base.lower()):
            return f"write {known}{brackets if not known.endswith(']') else ''}"
        lower = base.lower()
        if near := difflib.get_close_matches(lower, _BUILTIN, n=1, cutoff=0.7):
            return f"write {near[0]}{brackets}"
        if close := closest(base, list_message_types()):
            return f"write {' or '.join(each + brackets for each in close)}"
        package = base.partition("/")[0] if "/" in base else self.package
        return f"write a built-in type, or build and source the package {package} that should define it"

    def _name(self, line: Line, word: Word) -> None:
        name = word.text
        if not _NAME.fullmatch(name):
            raise self._broken(line, word.column, f"{name!r} cannot be a name", self._name_advice(line, name))
        if name in _METHODS:
            raise self._broken(
                line, word.column, f"{name} is a method of every message", f"write {name}_it, for example"
            )
        if self.strict and (name in keyword.kwlist or name == "self"):
            problem = f"{name} is a keyword of Python, so the field would have the name {name}_ in Python"
            raise self._broken(line, word.column, problem, "write another name")
        if name in self.names:
            problem = f"{name} is already declared in line {self.names[name]}"
            raise self._broken(
                line, word.column, problem, ("write another name, or remove one of the two lines")
            )
        self.names[name] = line.number

    def _name_advice(self, line: Line, name: str) -> str:
        base = re.match(r"[A-Za-z]\w*", name, re.ASCII)
        if base and (array := re.fullmatch(r"(\[\d*\]);?", name[base.end() :])):
            return f"write the brackets after the type: {line.words()[0].text}{array[1]} {base[0]}"
        if base and name[base.end() :] in (";", ",", ":", "."):
            return f"write {base[0]}, with nothing after it"
        if base and "-" in name:
            return (
                f"write {name.replace('-', '_')}"
                if _NAME.fullmatch(name.replace("-", "_"))
                else "use letters only"
            )
        return "begin with a letter from a to z; then use letters, digits and _"

    def _constant(self, line: Line) -> None:
        start, _, value = line.text.partition("=")
        left = Line(line.number, start).words()
        if len(left) != 2:
            column = left[-1].column if left else 1
            problem = "a constant needs a type and a name before ="
            raise self._broken(line, column, problem, "write it as in this example: int32 LIMIT=10")
        type_word, name = left
        if type_word.text not in _BUILTIN or type_word.text in ("time", "duration"):
            problem = f"a constant cannot be of type {type_word.text!r}"
            raise self._broken(line, type_word.column, problem, self._constant_advice(type_word.text))
        self._name(line, name)
        if type_word.text == "string":
            self._string(line, value)
        else:
            self._number(line, type_word.text, value.split("#")[0])

    def _constant_advice(self, type_name: str) -> str:
        near = difflib.get_close_matches(type_name.lower(), _BUILTIN, n=1, cutoff=0.7)
        known = _FROM_ELSEWHERE.get(type_name.lower()) or (
            near[0] if near and near[0] not in ("time", "duration") else ""
        )
        return (
            f"write {known}" if known and "[" not in known else "write a built-in number type, bool or string"
        )

    def _string(self, line: Line, value: str) -> None:
        if line.text[:1].isspace():
            raise self._broken(
                line, 1, "a string constant cannot be indented", "begin the constant in the first column"
            )
        if self.strict and "\\" in value:
            column = line.text.index("\\") + 1
            raise self._broken(
                line,
                column,
                "Python would read the backslash as the start of an escape sequence",
                "write the string without a backslash",
            )

    def _number(self, line: Line, type_name: str, value: str) -> None:
        text = value.strip()
        column = line.text.index("=") + 2 + len(value) - len(value.lstrip())
        if not text:
            raise self._broken(line, column, "the value is missing", "write the value after =")
        limits = integer_range(type_name)
        if problem := _unreadable(type_name, text):
            raise self._broken(line, column, f"{text!r} is not {problem[0]}", f"write {problem[1]}")
        if limits and not limits[0] <= int(text) <= limits[1]:
            advice = f"write a number from {limits[0]} to {limits[1]}, or use a type with a larger range"
            raise self._broken(line, column, f"{text} is out of range for {type_name}", advice)

    def _broken(self, line: Line, column: int, problem: str, remedy: str) -> BrokenDefinition:
        return BrokenDefinition(self.source, line.number, column, line.text, problem, remedy)


def _unreadable(type_name: str, text: str) -> tuple[str, str] | None:
    """Return the kind of value that a constant needs, and a correction; return None for a valid value."""
    reader: Callable[[str], object]
    if type_name == "bool":
        reader, wanted, advice = ast.literal_eval, "a bool", "True or False"
    elif type_name.startswith("float"):
        reader, wanted, advice = _finite, "a finite number", "it as in 1.5"
    else:
        reader, wanted, advice = int, "an integer", "it as in 10, in decimal digits"
    try:
        reader(text)
    except (ValueError, SyntaxError):
        return wanted, advice
    return None


def _finite(text: str) -> float:
    # genpy copies inf and nan into its Python code, which does not define these names.
    if not math.isfinite(float(text)):
        raise ValueError(text)
    return float(text)
