"""Makes random service types, and random values for these types."""

from __future__ import annotations

import math
import random
import struct

from course_pkg.types import Field, Kind, MessageType

BUILTIN = (
    *(f"{sign}int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "u")),
    *("float32", "float64", "bool", "string", "time", "duration", "char", "byte"),
)
MESSAGES = (
    "Header",
    "std_msgs/Header",
    "std_msgs/Empty",
    "std_msgs/String",
    "std_msgs/ColorRGBA",
    "std_msgs/ByteMultiArray",
    "std_msgs/UInt8MultiArray",
    "geometry_msgs/Point",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/Polygon",
    "geometry_msgs/PoseWithCovariance",
)
# These strings have a special meaning in YAML or in a shell.
AWKWARD = (
    *("", " ", "yes", "No", "on", "null", "~", "1.0", "-1", "0x10", "1e5", "1_000", "12:30:45", "2020-01-02"),
    *(
        "- a",
        "-v",
        "--",
        "a: b",
        "a #b",
        "#b",
        "{a: 1}",
        "[1]",
        "*a",
        "&a",
        "!x",
        "%d",
        "@x",
        "`x`",
        "|",
        ">",
    ),
    *(
        "'",
        '"',
        "it's",
        'say "x"',
        "\\",
        "\\n",
        "a\nb",
        "\n",
        "\t",
        "a\tb",
        "$HOME",
        "$(x)",
        "a;b",
        "a!b",
        "!!",
    ),
    *("ä", "日本", "🐢", "\x00", "\x7f", "\x85", "\u2028", "\ufeff", "a:=b", "__name:=x", ":=", "2020-13-45"),
    *(
        "---",
        "...",
        "=",
        "<<",
        ".inf",
        ".nan",
        ",",
        "a, b",
        "]",
        "?",
        "? a",
        ":",
        "a:",
        ": a",
        "trailing ",
        " leading",
    ),
)
FLOATS = (
    0.0,
    -0.0,
    1.0,
    -1.0,
    1.5,
    1e20,
    -1e-20,
    1e-45,
    16777217.0,
    3.4028234663852886e38,
    math.inf,
    -math.inf,
    math.nan,
)


def half(chance: random.Random, fields: int | None = None) -> str:
    """Return the text of a random request or response definition."""
    count = chance.randrange(6) if fields is None else fields
    return "".join(f"{type_name(chance)} f{index}\n" for index in range(count))


def service(chance: random.Random) -> str:
    """Return the definition of a random service type."""
    return f"{half(chance)}---\n{half(chance)}"


def type_name(chance: random.Random) -> str:
    """Return the name of a random field type, which may be an array."""
    name = chance.choice(BUILTIN if chance.random() < 0.75 else MESSAGES)
    # `Header` means std_msgs/Header, but an array of `Header` is not valid.
    return (
        name if name == "Header" else name + chance.choice(("", "", "", "[]", f"[{chance.randrange(1, 5)}]"))
    )


def values(chance: random.Random, message: MessageType) -> dict[str, object]:
    """Return random values for all fields of a message."""
    return {field.name: value(chance, field) for field in message.fields}


def value(chance: random.Random, field: Field) -> object:
    """Return a random value for a field."""
    if field.kind is Kind.ARRAY:
        assert field.item is not None
        count = chance.randrange(4) if field.length is None else field.length
        return [value(chance, field.item) for _ in range(count)]
    if field.fields or field.kind is Kind.MESSAGE:
        return {part.name: value(chance, part) for part in field.fields}
    if field.kind is Kind.INTEGER:
        assert isinstance(field.low, int)
        assert isinstance(field.high, int)
        return chance.choice((field.low, field.high, 0, chance.randint(field.low, field.high)))
    if field.kind is Kind.FLOAT:
        return number(chance, field.type)
    return chance.random() < 0.5 if field.kind is Kind.BOOL else text(chance)


def number(chance: random.Random, type_name: str) -> float:
    """Return a random float."""
    width, code = (4, "<f") if type_name == "float32" else (8, "<d")
    any_bits = struct.unpack(code, chance.randbytes(width))[0]
    typed = round(chance.uniform(-1000, 1000), chance.randrange(5))
    return chance.choice((any_bits, typed, chance.choice(FLOATS)))


def text(chance: random.Random) -> str:
    """Return a string with special characters of YAML or of a shell."""
    if chance.random() < 0.7:
        return chance.choice(AWKWARD)
    return "".join(chance.choices(AWKWARD, k=3))
