"""09.1 and 09.2: a connection header in bytes, and exactly so many bytes from a socket."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from itertools import permutations

from course_pkg.examiner import Exam, Its, part, says
from course_pkg.examiner.ledger import Hints

A_KIND = """
def kind(pack_header, fields):
    return type(pack_header(fields)).__name__
"""
# A piece is sent when the one before has been taken: who waits a while and reads once gets one piece.
A_SOCKET = """
import fcntl
import socket
import struct
import termios
import threading
import time

PIECES, CLOSES = {pieces!r}, {closes!r}
your_end, other_end = socket.socketpair()


def not_taken():
    return struct.unpack("i", fcntl.ioctl(other_end, termios.TIOCOUTQ, bytes(4)))[0]


def speak():
    for piece in PIECES:
        other_end.sendall(piece)
        patient = time.monotonic() + 0.4  # with who only looks whether all is there
        while not_taken() and time.monotonic() < patient:
            time.sleep(0.005)
    if CLOSES:
        other_end.close()


threading.Thread(target=speak, daemon=True).start()
"""
UNPACKED = {
    says("UnicodeEncodeError"): "The text has to be UTF-8, which knows every letter: encode() makes it."
}
WITHIN = 3.0  # s for one call
NO_RETURN = "Nothing was returned: a function without a return line gives None."


@part(
    "09.1",
    points=2,
    goal="Return a connection header as bytes: its length, and each field with its length in front.",
    needs=["pack_header"],
)
def pack_a_header(exam: Exam) -> None:
    """Fields drawn anew; then a letter that takes two bytes; then no field at all."""
    word = exam.draw.word
    exam.prepare(A_KIND)
    for what, fields in (
        ("two fields", {"service": f"/{word()}", "md5sum": word(32)}),
        ("a letter outside of ASCII", {"callerid": f"/{word(4)}", "robot": f"Jürgen {word(3)}"}),
        ("no field", {}),
    ):
        rule = f"{what}: the bytes are those of TCPROS"
        packed = exam.run("pack_header", fields, hints=UNPACKED).value
        orders = [dict(order) for order in permutations(fields.items())]  # TCPROS asks for none
        due = [list(_packed(order)) for order in orders]
        exam.expect(
            rule,
            expected=packed if packed in due else due[0],
            seen=packed,
            hints=[
                (None, NO_RETURN),
                (b"", "No field makes a header, too: a length of 0, and nothing behind it."),
                *(slip for order in orders for slip in _slips(order)),
                (
                    (lambda seen: isinstance(seen, str)),
                    "That is text. A socket carries bytes: encode() makes them.",
                ),
                (
                    says(""),
                    "Compare it with the first bytes of the header above: length, then length and "
                    "name=value.",
                ),
            ],
        )
        kind = exam.run("kind", Its("pack_header"), fields, worded="pack_header()").value
        exam.hold(
            rule,
            kind in ("bytes", "bytearray"),
            expected="bytes",
            seen=kind,
            hints="The numbers are right. A socket carries bytes: bytes(...) makes them.",
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
    """Return the header, or one with a slip."""
    texts = [f"{name}{joint}{value}" for name, value in fields.items()]
    coded = [(count(text), text.encode(code)) for text in texts]
    body = b"".join((struct.pack(order, length) if lengths else b"") + data for length, data in coded)
    return (struct.pack(order, total(body)) if total else b"") + body


def _slips(fields: Mapping[str, str]) -> list[tuple[object, str]]:
    slips = {
        "The numbers are big-endian. Least byte first: struct.pack with '<I'.": _packed(fields, order=">I"),
        "The length of the whole header is missing: 4 bytes in front of the first field.": _packed(
            fields, total=None
        ),
        "The first length counts itself, too. It is the number of bytes that follow it.": _packed(
            fields, total=lambda body: len(body) + 4
        ),
        "The first number is how many fields there are. It has to be how many bytes follow.": _packed(
            fields, total=lambda _: len(fields)
        ),
        "A length counts bytes, and ü is two of them: encode first, and take the length then.": _packed(
            fields, count=len
        ),
        "Between name and value stands an equals sign, and nothing else.": _packed(fields, joint=": "),
        "Each field needs its own length in front of it, 4 bytes.": _packed(fields, lengths=False),
        "A length is a number of 4 bytes: struct.pack with '<I'.": _packed(fields, order="<H"),
        "The text has to be UTF-8, in which ü is two bytes: encode() without a word makes it.": _packed(
            fields, code="latin-1", count=len
        ),
    }
    return [(list(wrong), hint) for hint, wrong in slips.items()]


@part(
    "09.2",
    points=2,
    goal="Return exactly so many bytes from a socket, however they come; raise ConnectionError if it ends.",
    needs=["receive"],
)
def read_exactly(exam: Exam) -> None:
    """All at once; in pieces; more than is due; and an end in the middle."""
    word = exam.draw.word
    whole = word(12).encode()
    _receives(exam, "bytes that come at once", [whole], [12])
    _receives(exam, "bytes that come in pieces", [whole[:5], whole[5:6], whole[6:]], [12])
    _receives(exam, "no more than are due, and the rest the next time", [whole], [4, 8])
    _receives(exam, "no bytes when none are due", [whole], [0, 12])
    exam.prepare(A_SOCKET.format(pieces=[whole[:7]], closes=True))
    exam.run("receive", Its("your_end"), 12, within=WITHIN, hints=_slipped()).raised(
        "an end before the last byte is a ConnectionError",
        "ConnectionError",
        hints={
            says(
                "^TimesUp"
            ): "recv gives b'' for ever once the other end has closed: look for it, and raise.",
            (lambda seen: isinstance(seen, list)): (
                "It returned fewer bytes than were due. Nobody could tell that from an answer: raise."
            ),
            says(""): "recv gives b'' when the other end has closed. Raise ConnectionError then.",
        },
    )


def _receives(exam: Exam, what: str, pieces: list[bytes], counts: list[int]) -> None:
    exam.prepare(A_SOCKET.format(pieces=pieces, closes=False))
    whole, at = b"".join(pieces), 0
    for count in counts:
        due = list(whole[at : at + count])
        at += count
        exam.expect(
            what,
            expected=due,
            seen=exam.run("receive", Its("your_end"), count, within=WITHIN, hints=_slipped(count)).value,
            hints=[
                (None, NO_RETURN),
                ((lambda seen: isinstance(seen, str)), "That is text. Return the bytes as they came."),
                (
                    (lambda seen: isinstance(seen[0], list)),
                    "Those are the pieces. Return the bytes as they came, in one bytes object.",
                ),
                (
                    (lambda seen, most=count: len(seen) < most),
                    "recv returned what was there. Go on until all have come.",
                ),
                (
                    (lambda seen, most=count: len(seen) > most),
                    "These are more than were due, and the next call lacks them.",
                ),
                (says(""), "Return the bytes as they came, in one bytes object."),
            ],
        )


def _slipped(count: int = 1) -> Hints:
    """Return hints for a call that ends in an error while the other end is open."""
    return {
        says("^TimesUp"): (
            "It waits for more than was due. Ask recv for as many bytes as are still missing, not more. (A "
            "file of makefile reads ahead, too, unless buffering=0.)"
        ),
        says("Bad file descriptor|closed file"): (
            "The socket is closed. Leave it open: whoever called goes on with it."
        ),
        says("^(Connection|BrokenPipe)"): (
            "The other end is open, and sends what is due. recv returned what was there. Go on until all "
            "have come; only b'' is the end."
        )
        if count
        else "None were due, so none are missing: ask recv only while some are.",
    }
