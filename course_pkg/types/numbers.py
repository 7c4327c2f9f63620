"""Convert numbers to the shortest strings with the same values, and correct mistyped numbers."""

from __future__ import annotations

import math
import re
import struct

_FLOAT32 = struct.Struct("<f")
_SMALLEST_NORMAL_FLOAT32 = 2.0**-126
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_INTEGER = re.compile(r"[+-]?(0[xX][0-9a-fA-F]+|\d+)")
_NAN = re.compile(r"[+-]?\.?nan", re.IGNORECASE)
_INFINITE = re.compile(r"([+-]?)\.?inf(inity)?", re.IGNORECASE)


def float32(number: float) -> float:
    """Return the shortest number with the same float32 value, such as 6.24 for 6.240000247955322.

    Raises OverflowError if the number is too large for a float32.
    """
    if math.isnan(number):
        return math.nan
    packed = _FLOAT32.pack(number)
    exact: float = _FLOAT32.unpack(packed)[0]
    # The format omits zeros at the end. Therefore, a search that begins at 6 digits also finds shorter
    # numbers. For subnormal numbers, the search begins at one digit, because their precision is lower.
    fewest = 6 if abs(exact) >= _SMALLEST_NORMAL_FLOAT32 else 1
    for digits in range(fewest, 9):
        short = float(f"{exact:.{digits}g}")
        # A number near the largest float32 can be out of range after it was rounded to fewer digits.
        if math.isfinite(short) and _fits(short) and _FLOAT32.pack(short) == packed:
            return short
    return float(f"{exact:.9g}")


def _fits(number: float) -> bool:
    try:
        _FLOAT32.pack(number)
    except OverflowError:
        return False
    return True


def parse_float(text: str) -> float:
    """Return the number in a string; `inf` and `nan` are also numbers.

    Raises ValueError for any other string.
    """
    if _NAN.fullmatch(text):
        # Two lists with nan are equal only if both contain the same nan object. Therefore, always return this
        # object.
        return math.nan
    if infinite := _INFINITE.fullmatch(text):
        return float(f"{infinite[1]}inf")
    if "x" in text.lower():
        return float(parse_integer(text))
    if not text.isascii() or not _NUMBER.fullmatch(text):
        raise ValueError(text)
    return float(text)


def parse_integer(text: str) -> int:
    """Return the integer in a decimal or hexadecimal string (`0x…`).

    Raises ValueError for any other string.
    """
    if not text.isascii() or not _INTEGER.fullmatch(text):
        raise ValueError(text)
    return int(text, 16) if "x" in text.lower() else int(text)


def nearest_number(text: str, integer: bool) -> str | None:
    """Return the number that a mistyped string probably means, or None if the meaning is not clear."""
    guess = text.replace("\N{MINUS SIGN}", "-").replace("\N{EN DASH}", "-").replace("_", "").strip()
    if guess.count(",") == 1 and "." not in guess and not integer:
        guess = guess.replace(",", ".")
    else:
        guess = re.sub(r",(?=\d{3}\b)", "", guess)
    found = re.match(rf"({_NUMBER.pattern})\s*[^\W\d_]*$", guess, re.ASCII)
    if not found:
        return None
    if not integer:
        return found[1]
    number = float(found[1])
    return str(int(number)) if number.is_integer() and abs(number) < 2**53 else None
