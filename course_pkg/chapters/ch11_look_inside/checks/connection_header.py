"""11.1: the bytes of a connection header."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from itertools import permutations

from course_pkg.chapters.ch11_look_inside.checks.kernel_connections import Receiver
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN

# `type(b"")` is the class of bytes, even if the student has defined another class with the name "bytes".
TYPED_HEADER = """
import socket


def typed_header(pack_header, fields, name, times=1):
    packed = pack_header({key: value * times for key, value in fields.items()})
    sent = type(packed) in (type(b""), bytearray)
    if sent:
        with socket.socket(socket.AF_UNIX) as sock:
            sock.connect("\\0" + name)
            sock.sendall(packed)
    return [None if sent else packed, sent, type(packed).__name__]
"""  # Only bytes can be sent through a socket; the check gets any other result as plain data.
TIMES = 220  # A text of 300 letters is repeated TIMES times, so its length needs more than two bytes.
FOUR_BYTES = (
    "A length was too large for one or two bytes. Use all 4 bytes of each length: struct.pack with '<I' "
    "writes such a number."
)
ERRORS = [
    (
        matches("UnicodeEncodeError"),
        (
            "ASCII does not contain the letter ü, but UTF-8 does. Call encode() without an argument to "
            "use UTF-8."
        ),
    ),
    (
        matches("range|OverflowError|too big|format requires"),
        FOUR_BYTES,
    ),
]


def _wrong_header(orders: list[dict[str, str]]) -> Hints:
    return [
        (None, NO_RETURN),
        (
            b"",
            (
                "For a header without fields, the result is wrong. Return only the length of the header, "
                "which is 0, in 4 bytes."
            ),
        ),
        *(wrong for order in orders for wrong in _wrong_headers(order)),
        (
            (lambda actual: isinstance(actual, str)),
            "The function returned a str, but a socket sends bytes. Convert the str with encode().",
        ),
        (
            ANYTHING,
            (
                "Some bytes are wrong. Return the length of the header, and then the length and the text "
                "of each field: name=value."
            ),
        ),
    ]


@part(
    "11.1",
    points=2,
    goal=(
        "Return a connection header as bytes: the length of the header, and then the length and the "
        "text of each field."
    ),
    needs=["pack_header"],
)
def packed_header(context: CheckContext) -> None:
    """For several dicts of fields, compare the bytes from the student's function with the right headers.

    The dicts contain random fields, a letter that needs two bytes, no fields, a field longer than 255 bytes,
    or a field longer than 65535 bytes.
    """
    word = context.random.word
    context.prepare(TYPED_HEADER)
    for what, fields in (
        ("two fields", {"service": f"/{word()}", "md5sum": word(32)}),
        ("a letter that is not in ASCII", {"session": "", "Tür": f"Jürgen {word(3)}"}),
        ("no field", {}),
        ("two fields", {"type": f"my/{word()}", "message_definition": word(300)}),
    ):
        assertion = f"{what}: the function returns a TCPROS header"
        with Receiver() as receiver:
            its = Its("pack_header"), fields, receiver.name
            packed, sent, kind = context.run(
                "typed_header", *its, hints=ERRORS, worded="pack_header()"
            ).returned(list)
            packed = list(receiver.received()) if sent is True else packed
        # TCPROS allows any order of the fields.
        orders = [dict(order) for order in permutations(fields.items())]
        expected = [list(_packed(order)) for order in orders]
        context.expect(
            assertion,
            expected=packed if packed in expected else expected[0],
            actual=packed,
            hints=_wrong_header(orders),
        )
        context.require(
            assertion,
            holds=sent is True,
            expected="bytes",
            actual=f"a {kind} that is not bytes" if kind == "bytes" else kind,
            hints=(
                "The function returned numbers, but a socket sends bytes. Convert the numbers with "
                "bytes(...)."
            ),
        )
    _packs_a_long_field(context, word(300))


def _packs_a_long_field(context: CheckContext, text: str) -> None:
    """Assert that the function packs long fields; the report does not show the many bytes."""
    fields = {"type": f"my/{text[:6]}", "message_definition": text}
    with Receiver() as receiver:
        its = Its("pack_header"), fields, receiver.name, TIMES
        context.run("typed_header", *its, hints=ERRORS, worded="pack_header()").returned(list)
        received = receiver.received()
    orders = permutations((name, value * TIMES) for name, value in fields.items())
    expected = [_packed(dict(order)) for order in orders]
    context.require(
        "two fields: the function returns a TCPROS header",
        holds=received in expected,
        expected=f"the {len(expected[0])} bytes of a header with a long field",
        actual=f"{len(received)} bytes, but not the right bytes",
        hints=FOUR_BYTES,
    )


def _packed(
    fields: Mapping[str, str],
    *,
    order: str = "<I",
    total: Callable[[bytes], int] | None = len,
    count: Callable[[str], int] = lambda text: len(text.encode()),
    joint: str = "=",
    lengths: bool = True,
    code: str = "utf-8",
) -> bytes:
    """Return the bytes of a header; with the default arguments, the header is right."""
    texts = [f"{name}{joint}{value}" for name, value in fields.items()]
    coded = [(count(text), text.encode(code)) for text in texts]
    body = b"".join((_length(order, length) if lengths else b"") + data for length, data in coded)
    return (_length(order, total(body)) if total else b"") + body


def _length(order: str, length: int) -> bytes:
    """Return the bytes of a length; if the format `order` is too short, return only the lower bytes."""
    return struct.pack(order, length % 256 ** struct.calcsize(order))


def _wrong_headers(fields: Mapping[str, str]) -> list[tuple[list[int], str]]:
    wrong = [
        (
            _packed(fields, order=">I"),
            "The lengths are big-endian. Use struct.pack with '<I' for little-endian numbers.",
        ),
        (
            _packed(fields, total=None),
            (
                "The length of the whole header is missing. Write this length in 4 bytes before the "
                "first field."
            ),
        ),
        (
            _packed(fields, total=lambda body: len(body) + 4),
            (
                "The first length is too large by 4. Count only the bytes after the length, and not "
                "the 4 bytes of the length itself."
            ),
        ),
        (
            _packed(fields, total=lambda body: len(body) - 4 * len(fields)),
            (
                "The first length is too small. Count all bytes after this length: also count the 4 bytes of "
                "length before each field."
            ),
        ),
        (
            _packed(fields, total=lambda _: len(fields)),
            ("Your header begins with the number of its fields. Begin with the number of bytes that follow."),
        ),
        (
            _packed(fields, count=len),
            (
                "A length is a number of bytes, and the letter ü has two bytes in UTF-8. Encode the "
                "text before you call len()."
            ),
        ),
        (
            _packed(fields, joint=": "),
            "The text between the name and the value is wrong. Write only an equals sign, without spaces.",
        ),
        (
            _packed(fields, lengths=False),
            ("The length of a field is missing. Write the length of each field in 4 bytes before the field."),
        ),
        (
            _packed(fields, order="<H"),
            (
                "A length has the wrong number of bytes. Write each length in 4 bytes with struct.pack and "
                "'<I'."
            ),
        ),
        (
            _packed({name: value for name, value in fields.items() if value}),
            "Your function left out a field, because its value is empty. Write its name and the equals "
            "sign, too.",
        ),
        (
            _packed(fields, code="latin-1", count=len),
            (
                "The text is encoded in Latin-1. Call encode() without an argument to use UTF-8, in "
                "which ü has two bytes."
            ),
        ),
    ]
    return [(list(packed), hint) for packed, hint in wrong]
