"""A picture that a node sent is shown as it is, with words, and what is no picture is refused."""

from __future__ import annotations

import base64
import struct
import zlib
from typing import Any

import pytest
from sensor_msgs.msg import Image

from course_pkg.errors import NotAnImage
from course_pkg.panels.image.png import png
from course_pkg.panels.image.view import show_image

POINTS = [[(1, 2, 3), (4, 5, 6)], [(7, 8, 9), (10, 11, 12)], [(13, 14, 15), (16, 17, 18)]]


def picture(encoding: str, order: tuple[int, ...], padding: int = 0) -> Any:  # noqa: ANN401
    """Return the POINTS as a message, its channels in this order, its rows with some bytes at their end."""
    full = [[(*point, 255) for point in row] for row in POINTS]
    rows = [bytes(point[channel] for point in row for channel in order) + b"\xee" * padding for row in full]
    return Image(height=3, width=2, encoding=encoding, step=len(rows[0]), data=b"".join(rows))


def points(data: bytes) -> list[list[tuple[int, ...]]]:
    """Read the points of a PNG that has no filters; every checksum has to be right."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    chunks, place = {}, 8
    while place < len(data):
        (size,) = struct.unpack(">I", data[place : place + 4])
        body = data[place + 4 : place + 8 + size]
        assert struct.unpack(">I", data[place + 8 + size : place + 12 + size])[0] == zlib.crc32(body)
        chunks[body[:4]] = body[4:]
        place += 12 + size
    width, height, bits, colour, *_ = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    depth = {0: 1, 2: 3, 6: 4}[colour]
    plain = zlib.decompress(chunks[b"IDAT"])
    assert (bits, len(plain)) == (8, height * (1 + width * depth))
    rows = [plain[row * (1 + width * depth) :][1 : 1 + width * depth] for row in range(height)]
    return [[tuple(row[start : start + depth]) for start in range(0, len(row), depth)] for row in rows]


@pytest.mark.parametrize("padding", [0, 5])
@pytest.mark.parametrize(
    ("encoding", "order"),
    [
        ("rgb8", (0, 1, 2)),
        ("bgr8", (2, 1, 0)),
        ("rgba8", (0, 1, 2, 3)),
        ("bgra8", (2, 1, 0, 3)),
        ("mono8", (0,)),
    ],
)
def test_every_point_is_where_it_was(encoding: str, order: tuple[int, ...], padding: int) -> None:
    """In each encoding, and where rows are longer than their points."""
    kept = sorted(order)
    expected = [[tuple((*point, 255)[channel] for channel in kept) for point in row] for row in POINTS]
    assert points(png(picture(encoding, order, padding))) == expected


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"encoding": "16UC1"}, "The encoding '16UC1' cannot be shown. These can: mono8, rgb8"),
        ({"width": 0}, "0 x 3 points has nothing to show"),
        ({"width": 3}, "do not fit together"),
        ({"step": 5}, "do not fit together"),
        ({"data": b"short"}, "It holds 5 bytes"),
    ],
)
def test_a_broken_picture_is_refused(change: dict[str, Any], words: str) -> None:
    """Its own words about itself do not hold, and the error says which."""
    image = picture("rgb8", (0, 1, 2))
    for name, value in change.items():
        setattr(image, name, value)
    with pytest.raises(NotAnImage, match=words):
        show_image(image)


def test_something_else_is_refused() -> None:
    """The slip is to give the whole response."""
    with pytest.raises(NotAnImage, match="A dict is no sensor_msgs/Image"):
        show_image({"image": picture("rgb8", (0, 1, 2))})


def test_the_picture_speaks_in_words() -> None:
    """Who cannot see it hears the description, in HTML and in plain text; without HTML it is a PNG."""
    view = show_image(picture("rgb8", (0, 1, 2)), 'the "shop" & its door')
    data, metadata = view._repr_mimebundle_()
    assert 'alt="the &quot;shop&quot; &amp; its door" width="2" height="3"' in data["text/html"]
    assert data["text/plain"] == repr(view) == '[the "shop" & its door]'
    assert base64.b64decode(data["image/png"]) == view.data
    assert metadata["image/png"]["width"] == 2
    assert repr(show_image(picture("rgb8", (0, 1, 2)))) == "[a picture of 2 x 3 points]"
