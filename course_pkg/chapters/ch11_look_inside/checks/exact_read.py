"""11.2: reading an exact number of bytes from a socket."""

from __future__ import annotations

from course_pkg.chapters.ch11_look_inside.checks.kernel_connections import PEEKING, OtherEnd
from course_pkg.checking import ANYTHING, CheckContext, Its, matches, part
from course_pkg.checking.assertions import Hints
from course_pkg.checking.common_hints import NO_RETURN
from course_pkg.waiting import wait_until

YOUR_END = """
import socket

your_end = socket.socket(socket.AF_UNIX)
your_end.connect("\\0{name}")


def is_open():
    return your_end.fileno() >= 0
"""
WITHIN = 3.0  # WITHIN is the time limit in s for one call.
PAUSE = 0.5  # Two consecutive pieces of a message are separated by a pause of this time in s.

RECEIVED = "Return exactly `count` bytes, even if the bytes arrive in pieces."

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

    At the end, close the connection before all bytes are sent, and then before the first byte is sent.
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
    for sent in ([whole[:7]], []):
        _reports_the_end(context, sent)


TAKEN = (
    "The function read more than `count` bytes from the socket. Leave the later bytes in the "
    "socket, because they belong to the next message."
)

CLOSED = "The function closed the socket. Leave the socket open, because the caller still uses it."


def _reports_the_end(context: CheckContext, sent: list[bytes]) -> None:
    """Close the connection after the pieces in `sent`, which have fewer than 12 bytes."""
    assertion = "if the connection ends before the last byte, receive() raises ConnectionError"
    with OtherEnd(sent, closes=True) as other:
        context.prepare(YOUR_END.format(name=other.name))
        context.run("receive", Its("your_end"), 12, within=WITHIN, hints=_receive_errors()).raised(
            assertion, "ConnectionError", hints=NOT_RAISED
        )
        context.require(
            assertion,
            holds=context.run("is_open", worded="receive()").returned() is True and other.is_open(),
            expected="a socket that is still open",
            actual="a closed socket",
            hints=CLOSED,
        )


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
                "that do not come. Pass only the number of missing bytes to recv(), or call makefile() with "
                "buffering=0 and read in a loop."
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
