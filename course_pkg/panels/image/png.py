"""A sensor_msgs/Image as PNG, with nothing but the standard library.

https://www.w3.org/TR/png/, chapters 5 and 11; encodings as sensor_msgs/image_encodings.h names them.
"""

from __future__ import annotations

import struct
import zlib
from typing import Any

from course_pkg.errors import NotAnImage

GREY, COLOUR, COLOUR_ALPHA = 0, 2, 6  # PNG's colour types
ENCODINGS = {  # PNG's colour type, and the place of each of its channels in a point of the message
    "mono8": (GREY, (0,)),
    "rgb8": (COLOUR, (0, 1, 2)),
    "bgr8": (COLOUR, (2, 1, 0)),
    "rgba8": (COLOUR_ALPHA, (0, 1, 2, 3)),
    "bgra8": (COLOUR_ALPHA, (2, 1, 0, 3)),
}
MOST = 50_000_000  # bytes


def png(image: Any) -> bytes:  # noqa: ANN401 -- a class that genpy generates
    """Return `image`, a sensor_msgs/Image, as a PNG file. Raises NotAnImage."""
    colour, order = _layout(image)
    depth, data = len(order), bytes(image.data)
    rows = (data[start : start + image.width * depth] for start in range(0, len(data), image.step or 1))
    plain = b"".join(b"\0" + _ordered(row, order) for row in rows)
    head = struct.pack(">IIBBBBB", image.width, image.height, 8, colour, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(plain, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, body) for kind, body in chunks)


def _layout(image: Any) -> tuple[int, tuple[int, ...]]:  # noqa: ANN401
    """Return the colour type and the order of channels, once what the message says of itself holds."""
    try:
        encoding, width, height = image.encoding, image.width, image.height
        step, size = image.step, len(image.data)
    except (AttributeError, TypeError) as error:
        raise NotAnImage(
            f"A {type(image).__name__} is no sensor_msgs/Image. If a response has one in a field, give that."
        ) from error
    if encoding not in ENCODINGS:
        known = ", ".join(ENCODINGS)
        raise NotAnImage(f"The encoding {encoding!r} cannot be shown. These can: {known}.")
    colour, order = ENCODINGS[encoding]
    if not width or not height:
        raise NotAnImage(f"A picture of {width} x {height} points has nothing to show.")
    if step < width * len(order) or size != step * height or size > MOST:
        raise NotAnImage(
            f"The picture says that it has {height} rows of {step} bytes, each {width} points in {encoding}. "
            f"It holds {size} bytes, and these do not fit together."
        )
    return colour, order


def _ordered(row: bytes, order: tuple[int, ...]) -> bytes:
    if order == tuple(range(len(order))):
        return row
    ordered = bytearray(len(row))
    for place, source in enumerate(order):
        ordered[place :: len(order)] = row[source :: len(order)]
    return bytes(ordered)


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
