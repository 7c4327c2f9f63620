"""11.1 and 11.2: the bytes of a connection header, and reading an exact number of bytes from a socket."""

from __future__ import annotations

import fcntl
import secrets
import select
import socket
import struct
import termios
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from itertools import permutations
from types import TracebackType

from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.waiting import wait_until

# `type(b"")` is the class of bytes, even if the student has defined another class with the name "bytes".
TYPED_HEADER = """
import socket


def typed_header(pack_header, fields, name):
    packed = pack_header(fields)
    sent = type(packed) in (type(b""), bytearray)
    if sent:
        with socket.socket(socket.AF_UNIX) as sock:
            sock.connect("\\0" + name)
            sock.sendall(packed)
    return [packed, sent, type(packed).__name__]
"""  # The check receives bytes as a list of numbers, but only bytes can be sent through a socket.
YOUR_END = """
import socket

your_end = socket.socket(socket.AF_UNIX)
your_end.connect("\\0{name}")


def is_open():
    return your_end.fileno() >= 0
"""
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
        (
            "The function failed because a length was greater than 255. Use all 4 bytes of each length: "
            "struct.pack with '<I' writes such a number."
        ),
    ),
]
WITHIN = 3.0  # WITHIN is the time limit in s for one call.
# The check waits up to this time in s until the client has read a piece. A client that only peeks at the
# bytes does not remove them from the socket.
PEEKING = 0.4
PAUSE = 0.5  # Two consecutive pieces of a message are separated by a pause of this time in s.
CONNECTING = 5.0  # CONNECTING is the time limit in s for the kernel to connect.


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


RECEIVED = "Return exactly `count` bytes, even if the bytes arrive in pieces."


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

    The dicts contain random fields, a letter that needs two bytes, no fields, or a field longer than 255
    bytes.
    """
    word = context.random.word
    context.prepare(TYPED_HEADER)
    for what, fields in (
        ("two fields", {"service": f"/{word()}", "md5sum": word(32)}),
        ("a letter that is not in ASCII", {"session": "", "robot": f"Jürgen {word(3)}"}),
        ("no field", {}),
        ("two fields", {"type": f"my/{word()}", "message_definition": word(300)}),
    ):
        assertion = f"{what}: the function returns a TCPROS header"
        with Receiver() as receiver:
            its = Its("pack_header"), fields, receiver.name
            packed, sent, kind = context.run(
                "typed_header", *its, hints=ERRORS, worded="pack_header()"
            ).returned(list)
            received = receiver.received() if sent is True else b""
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
            holds=sent is True and packed == list(received),
            expected="bytes",
            actual=f"a {kind} that is not bytes" if kind == "bytes" else kind,
            hints=(
                "The function returned numbers, but a socket sends bytes. Convert the numbers with "
                "bytes(...)."
            ),
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
    body = b"".join((struct.pack(order, length) if lengths else b"") + data for length, data in coded)
    return (struct.pack(order, total(body)) if total else b"") + body


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


NOT_RAISED: Hints = [
    (
        matches("^TimesUp"),
        (
            "The function did not return after the other program had closed the connection. In this "
            "case, recv() returns b'': check for b'', and raise ConnectionError."
        ),
    ),
    (
        (lambda actual: isinstance(actual, list)),
        (
            "The connection ended early, and the function returned fewer than `count` bytes. Raise "
            "ConnectionError in this case."
        ),
    ),
    (
        ANYTHING,
        (
            "The function raised an error of the wrong type. If recv() returns b'', the connection has "
            "ended: raise ConnectionError."
        ),
    ),
]


@part(
    "11.2",
    points=2,
    goal=(
        "Return exactly `count` bytes from a socket, even if the bytes arrive in pieces. Raise "
        "ConnectionError if the connection ends before `count` bytes have arrived."
    ),
    needs=["receive"],
    goals={RECEIVED: 3, "Raise ConnectionError if the connection ends before `count` bytes have arrived.": 1},
)
def exact_read(context: CheckContext) -> None:
    """Send bytes to the student's function: in one piece, in several pieces, and with additional bytes.

    At the end, close the connection before all bytes are sent.
    """
    word = context.random.word
    whole, following = word(12).encode(), word(12).encode()
    _receives(context, "receive() returns bytes that arrive together", [whole], [12])
    _receives(
        context,
        "receive() joins bytes that arrive in pieces",
        [whole[:5], whole[5:6], whole[6:]],
        [12],
        PAUSE,
    )
    _receives(
        context,
        "receive() returns exactly `count` bytes, and the next call returns the rest",
        [whole],
        [4, 8],
    )
    joined = [whole[:5], whole[5:] + following]
    _receives(context, "receive() reads no bytes of the next message", joined, [12, 12])
    _receives(context, "receive() returns no bytes if `count` is 0", [whole], [0, 12])
    context.fulfilled(RECEIVED)
    with OtherEnd([whole[:7]], closes=True) as other:
        context.prepare(YOUR_END.format(name=other.name))
        context.run("receive", Its("your_end"), 12, within=WITHIN, hints=_receive_errors()).raised(
            "if the connection ends before the last byte, receive() raises ConnectionError",
            "ConnectionError",
            hints=NOT_RAISED,
        )
        context.require(
            "if the connection ends before the last byte, receive() raises ConnectionError",
            holds=context.run("is_open", worded="receive()").returned() is True and other.is_open(),
            expected="a socket that is still open",
            actual="a closed socket",
            hints=CLOSED,
        )


TAKEN = (
    "The function read more than `count` bytes from the socket. Leave the later bytes in the "
    "socket, because they belong to the next message."
)


CLOSED = "The function closed the socket. Leave the socket open, because the caller still uses it."


def _listener() -> tuple[str, socket.socket]:
    """Return the name of a new socket, and the socket, which listens for one connection.

    The name is in Linux's abstract namespace. The socket needs no file, and can be used only in this network
    namespace.
    """
    name = f"course-{secrets.token_hex(8)}"
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(f"\0{name}")
    listener.listen(1)
    listener.settimeout(CONNECTING)
    return name, listener


class Receiver:
    """Receives the bytes that the kernel sends through one connection."""

    def __init__(self) -> None:
        self.name, self._listener = _listener()
        self._data = b""
        # A thread receives the bytes, because otherwise a long answer could fill the socket and block.
        self._thread = threading.Thread(target=self._receive, daemon=True)

    def __enter__(self) -> Receiver:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._listener.close()

    def received(self) -> bytes:
        """Return all bytes of the connection, or no bytes if the kernel did not connect."""
        self._thread.join(2 * CONNECTING)
        return self._data

    def _receive(self) -> None:
        with suppress(OSError):
            sock, _ = self._listener.accept()
            with sock:
                sock.settimeout(CONNECTING)
                while chunk := sock.recv(4096):
                    self._data += chunk


class OtherEnd:
    """The server to which the student's socket connects.

    The object sends `pieces`, and keeps the connection open until the `with` block ends.

    The server sends each piece after the client has read the previous piece. Therefore, a client that reads
    only once gets only one piece. `pause` is the time in s before each piece.
    """

    def __init__(self, pieces: Sequence[bytes], *, closes: bool = False, pause: float = 0.0) -> None:
        self.name, self._listener = _listener()
        self._pieces, self._closes, self._pause = pieces, closes, pause
        self._over = threading.Event()
        self._sock: socket.socket | None = None
        self._sending = threading.Thread(target=self._send, daemon=True)

    def __enter__(self) -> OtherEnd:
        self._sending.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._sending.join()
        self._listener.close()

    def is_open(self) -> bool:
        """Return whether the client's socket is open."""
        poll = select.poll()
        if self._sock is not None:
            poll.register(self._sock, 0)
        return not any(seen & select.POLLHUP for _, seen in poll.poll(0))

    def has_more(self) -> bool:
        """Return whether the client's socket contains unread bytes."""
        with suppress(OSError):
            return bool(self._sock and _unread(self._sock))
        return False

    def _send(self) -> None:
        # If the kernel closes its socket or does not connect, socket methods raise an OSError.
        with suppress(OSError):
            sock, _ = self._listener.accept()
            with sock:
                self._sock = sock
                for piece in self._pieces:
                    self._over.wait(self._pause)
                    sock.sendall(piece)
                    wait_until(lambda: not _unread(sock), PEEKING, 0.005, self._over)
                if self._closes:
                    sock.shutdown(socket.SHUT_WR)
                self._over.wait()


def _unread(sock: socket.socket) -> int:
    """Return the number of bytes that were sent to the client, but that the client has not yet read."""
    (count,) = struct.unpack("i", fcntl.ioctl(sock, termios.TIOCOUTQ, bytes(4)))
    return int(count)


def _receives(
    context: CheckContext, what: str, pieces: list[bytes], counts: list[int], pause: float = 0.0
) -> None:
    whole, at, left = b"".join(pieces), 0, True
    with OtherEnd(pieces, pause=pause) as other:
        context.prepare(YOUR_END.format(name=other.name))
        for count in counts:
            expected = list(whole[at : at + count])
            at += count
            context.expect(
                what,
                expected=expected,
                actual=context.run(
                    "receive", Its("your_end"), count, within=WITHIN, hints=_receive_errors(count)
                ).returned(),
                hints=_not_received(count),
            )
            left = left and (at == len(whole) or bool(wait_until(other.has_more, PEEKING)))
    context.require(
        what, holds=left, expected="the later bytes in the socket", actual="an empty socket", hints=TAKEN
    )


def _not_received(count: int) -> Hints:
    """Return hints for a function that did not return exactly the next `count` bytes."""
    return [
        (None, NO_RETURN),
        (
            (lambda actual: isinstance(actual[0], list)),
            "The function returned a list of pieces. Join the pieces into one bytes object.",
        ),
        (
            (lambda actual: len(actual) < count),
            ("The function returned too few bytes. Call recv() again until `count` bytes have arrived."),
        ),
        (
            (lambda actual: len(actual) > count),
            (
                "The function returned more than `count` bytes, so the next call cannot read the extra "
                "bytes. In each recv(), ask only for the bytes that you still need."
            ),
        ),
    ]


def _receive_errors(count: int = 1) -> Hints:
    """Return hints for a call that raises an error although the connection is open."""
    return [
        (
            matches("^TimesUp"),
            (
                "An earlier call of the function received too many bytes, so the next call waits for bytes "
                "that do not come. "
                "Pass only the number of missing bytes to recv(), or call makefile() with buffering=0."
            ),
        ),
        (
            matches("Bad file descriptor|closed file"),
            CLOSED,
        ),
        (
            matches("^(TimeoutError|timeout|BlockingIOError)"),
            "The function stopped while it waited for the next piece. Call recv() without a time limit.",
        ),
        (
            matches("^(Connection|BrokenPipe)"),
            (
                "The connection is still open, and more bytes follow. Call recv() again after a "
                "short piece: only b'' means the end of the connection."
            )
            if count
            else (
                "The argument `count` was 0, but the function waited for bytes. Call recv() only "
                "while bytes are missing."
            ),
        ),
    ]
