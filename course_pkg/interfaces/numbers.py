"""Numbers as text: the shortest that gives the same number back, and what is wrong with a text."""

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
    """Return the shortest number that is the same float32: 6.24 for 6.240000247955322.

    Raises OverflowError where a float32 cannot hold it.
    """
    if math.isnan(number):
        return math.nan
    packed = _FLOAT32.pack(number)
    exact: float = _FLOAT32.unpack(packed)[0]
    # Any text of up to 6 digits survives float32, so that fewer need no trying, except below
    # the normal range, where a single digit can be enough.
    fewest = 6 if abs(exact) >= _SMALLEST_NORMAL_FLOAT32 else 1
    for digits in range(fewest, 9):
        short = float(f"{exact:.{digits}g}")
        # Near the end of the range the shorter number can lie beyond it.
        if math.isfinite(short) and _fits(short) and _FLOAT32.pack(short) == packed:
            return short
    return float(f"{exact:.9g}")


def _fits(number: float) -> bool:
    try:
        _FLOAT32.pack(number)
    except OverflowError:
        return False
    return True


def float_text(number: float) -> str:
    """Return the shortest text of a number: `1.2`, `1e+20`, `inf`, `-inf`, `nan`."""
    return repr(number)


def read_float(text: str) -> float:
    """Return the number that a text stands for; `inf` and `nan` are numbers. Raises ValueError."""
    if _NAN.fullmatch(text):
        # One and the same object, so that a list or dict which holds it equals itself.
        return math.nan
    if infinite := _INFINITE.fullmatch(text):
        return float(f"{infinite[1]}inf")
    if "x" in text.lower():
        return float(read_integer(text))
    if not text.isascii() or not _NUMBER.fullmatch(text):
        raise ValueError(text)
    return float(text)


def read_integer(text: str) -> int:
    """Return the integer that a text stands for, decimal or `0x…`. Raises ValueError."""
    if not text.isascii() or not _INTEGER.fullmatch(text):
        raise ValueError(text)
    return int(text, 16) if "x" in text.lower() else int(text)


def nearest_number(text: str, integer: bool) -> str | None:
    """Return the number that a mistyped one was probably meant to be, None if that is anyone's guess."""
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
