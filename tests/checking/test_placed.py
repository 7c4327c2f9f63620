"""Tests of proxies, through which the kernel uses an object in the check runner."""

from __future__ import annotations

import json
import os
import signal
import socket
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest

from course_pkg.checking.kernel.object_proxy import ObjectProxies
from course_pkg.checking.placed import remote
from course_pkg.checking.placed.host import CALLS, CONNECTIONS, LIMIT, PlacedObjects
from course_pkg.checking.plain_values import Value
from course_pkg.waiting import wait_until

SOON = 10.0  # On a busy machine, the reaction to an event may take up to this time in s.


class Stuck(Exception):
    """An error class that does not exist in the kernel."""


class Drawer:
    """An object of a check; the kernel uses this object through a proxy."""

    def __init__(self) -> None:
        self.things = 0
        self.threads: set[int] = set()
        self.hidden = 1
        self.together = threading.Barrier(3)
        self.opened = threading.Event()
        self.closed = threading.Event()

    @remote
    def add(self, count: int, *, twice: bool = False) -> int:
        """Add a number to the sum, and return the sum. If `twice` is true, add the number two times."""
        self.threads.add(threading.get_ident())
        self.things += count * (1 + twice)
        return self.things

    @remote
    def meet(self) -> int:
        """Wait until three threads have called this method."""
        return self.together.wait(SOON)

    @remote
    def wait(self) -> None:
        """Wait until the check ends."""
        self.opened.set()
        self.closed.wait(SOON)

    @remote
    def stick(self, kind: str) -> None:
        """Raise an error."""
        raise {"own": Stuck, "known": KeyError}[kind]("the drawer is stuck")

    @remote
    def itself(self) -> Drawer:
        """Return an object with remote methods."""
        return self

    @property
    @remote
    def count(self) -> int:
        """A number that the kernel can change."""
        return self.things

    @count.setter
    @remote
    def count(self, count: int) -> None:
        self.things = count

    @property
    @remote
    def number(self) -> int:
        """A number that the kernel cannot change."""
        return 7

    def close(self) -> None:
        """End all waiting calls."""
        self.closed.set()


@pytest.fixture
def placed() -> Iterator[PlacedObjects]:
    """Run the server that receives the proxies' calls."""
    with PlacedObjects() as placed:
        yield placed


@pytest.fixture
def drawer() -> Drawer:
    """Return an object of the check that the kernel can use through a proxy."""
    return Drawer()


def proxy(placed: PlacedObjects, item: object) -> Value:
    """Place an object in the server, and return a proxy for the object."""
    where = placed.place(item)
    return ObjectProxies(int(str(where["port"])), str(where["key"])).proxy(dict(where["item"]))  # type: ignore[arg-type]


def connect(placed: PlacedObjects, *, key: str = "") -> socket.socket:
    """Connect to the server of the proxies, and send the secret key."""
    where = placed.place(Drawer())
    sock = socket.create_connection(("127.0.0.1", int(str(where["port"]))), timeout=SOON)
    sock.sendall(json.dumps({"key": key or where["key"]}).encode() + b"\n")
    return sock


def ended(sock: socket.socket) -> bool:
    """Return whether the check runner closes the connection without a reply."""
    try:
        return sock.recv(1000) == b""
    except ConnectionError:
        return True


def test_methods_and_attributes_are_those_of_the_real_object(placed: PlacedObjects, drawer: Drawer) -> None:
    """Through a proxy, the kernel can call methods and can read and write attributes of the real object."""
    other = proxy(placed, drawer)
    assert other.add(2) == 2
    assert other.add(count=1, twice=True) == 4
    other.count = 9
    assert (other.count, drawer.things, other.number) == (9, 9, 7)
    assert type(other).__name__ == "Drawer"


def test_only_remote_attributes_exist(placed: PlacedObjects, drawer: Drawer) -> None:
    """The kernel cannot use an attribute without @remote."""
    other = proxy(placed, drawer)
    with pytest.raises(AttributeError, match="'Drawer' object has no attribute 'hidden'"):
        _ = other.hidden
    with pytest.raises(AttributeError):
        other.number = 8
    other.note = "of the student's own"
    assert not hasattr(drawer, "note")
    for line in (
        {"do": "get", "name": "hidden"},
        {"do": "call", "name": "close"},
        {"do": "set", "name": "number"},
    ):
        with connect(placed) as sock:
            sock.sendall(json.dumps({"object": 0, "args": [1], **line}).encode() + b"\n")
            assert ended(sock)
    assert not drawer.closed.is_set()


def test_a_changed_class_changes_nothing_in_the_real_object(placed: PlacedObjects, drawer: Drawer) -> None:
    """If the student replaces a method of a proxy, the real object does not change."""
    other = proxy(placed, drawer)
    type(other).add = lambda _self, _count: 1000
    assert other.add(1) == 1000
    assert drawer.things == 0


def test_an_error_comes_with_its_class_and_text(placed: PlacedObjects, drawer: Drawer) -> None:
    """If a method of the real object raises a built-in error, the kernel gets an error of the same class.

    For an error that is not built in, the kernel creates a class with the same name.
    """
    other = proxy(placed, drawer)
    with pytest.raises(KeyError, match="the drawer is stuck"):
        other.stick("known")
    with pytest.raises(Exception, match="the drawer is stuck") as first:
        other.stick("own")
    assert type(first.value).__name__ == "Stuck"
    with pytest.raises(first.type):
        other.stick("own")
    with pytest.raises(TypeError, match=r"add\(\) missing 1 required positional argument"):
        other.add()


def test_an_object_that_is_returned_is_a_proxy(placed: PlacedObjects, drawer: Drawer) -> None:
    """If a remote method returns an object, the kernel gets a proxy."""
    other = proxy(placed, drawer)
    assert other.itself() is other


def test_each_thread_has_its_own_thread_in_the_check_runner(placed: PlacedObjects, drawer: Drawer) -> None:
    """Calls from different threads of the kernel run in different threads of the check runner."""
    other = proxy(placed, drawer)
    with ThreadPoolExecutor(3) as pool:
        assert sorted(pool.map(lambda _: other.meet(), range(3))) == [0, 1, 2]
        before = len(placed._open)
        list(pool.map(other.add, [1] * 20))
    assert before == 3
    assert len(drawer.threads) <= 3
    assert wait_until(lambda: not placed._open, SOON)


@pytest.mark.parametrize(
    "line",
    [
        b"no json\n",
        b"[1]\n",
        b"[" * 5000 + b"\n",
        b"{}\n",
        b'{"object": true, "do": "get", "name": "count"}\n',
        b'{"object": -1, "do": "get", "name": "count"}\n',
        b'{"object": 0, "do": "call", "name": "add", "args": 1}\n',
        b'{"object": 0, "do": "call", "name": ["add"]}\n',
        b'{"object": 0, "do": "call", "name": "__init__"}\n',
        b"x" * (LIMIT + 2),
    ],
)
def test_a_malformed_line_ends_its_connection_only(
    placed: PlacedObjects, drawer: Drawer, line: bytes
) -> None:
    """An invalid line from a client closes only the connection of this client."""
    other = proxy(placed, drawer)
    with connect(placed) as sock:
        sock.sendall(line)
        assert ended(sock)
    assert other.add(1) == 1


def test_another_key_is_refused(placed: PlacedObjects) -> None:
    """Without the secret key, a program cannot use any object."""
    for key in ("another", "\ud800"):
        with connect(placed, key=key) as sock:
            assert ended(sock)


def test_connections_and_calls_are_limited(placed: PlacedObjects, drawer: Drawer) -> None:
    """The check runner limits the numbers of connections and of waiting calls."""
    other = proxy(placed, drawer)
    socks = [connect(placed) for _ in range(CONNECTIONS)]
    assert wait_until(lambda: len(placed._open) == CONNECTIONS, SOON)
    with connect(placed) as sock:
        assert ended(sock)
    for sock in socks:
        sock.close()
    assert wait_until(lambda: not placed._open, SOON)
    assert other.add(1) == 1
    placed._calls = CALLS
    with pytest.raises(ConnectionError):
        other.add(1)


def test_a_call_that_waits_ends_with_the_check(drawer: Drawer) -> None:
    """When the check ends, a waiting call and all later calls raise an error."""
    before = threading.active_count()
    with ThreadPoolExecutor(1) as pool:
        with PlacedObjects() as placed:
            other = proxy(placed, drawer)
            waiting = pool.submit(other.wait)
            assert drawer.opened.wait(SOON)
        assert waiting.exception(SOON) is None or isinstance(waiting.exception(SOON), ConnectionError)
        with pytest.raises(ConnectionError, match="belongs to a check that has ended"):
            other.add(1)
    assert wait_until(lambda: threading.active_count() == before, SOON)


def test_a_killed_kernel_leaves_no_thread(placed: PlacedObjects, drawer: Drawer) -> None:
    """When the kernel is killed, the check runner's threads for this kernel end."""
    where = placed.place(drawer)
    program = (
        "from course_pkg.checking.kernel.object_proxy import ObjectProxies\n"
        f"ObjectProxies({where['port']}, {where['key']!r}).proxy({where['item']!r}).wait()\n"
    )
    process = os.posix_spawn("/usr/bin/env", ["env", "python3", "-c", program], os.environ)
    assert drawer.opened.wait(SOON)
    os.kill(process, signal.SIGKILL)
    os.waitpid(process, 0)
    drawer.close()
    assert wait_until(lambda: not placed._open, SOON)


def test_an_interrupted_call_does_not_spoil_the_next_one(placed: PlacedObjects, drawer: Drawer) -> None:
    """After a call was interrupted, the next call gets its own reply."""
    other = proxy(placed, drawer)

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGUSR1, interrupt)
    presser = threading.Thread(
        target=lambda: (
            drawer.opened.wait(SOON),
            signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGUSR1),
        )
    )
    presser.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            other.wait()
    finally:
        presser.join()
        signal.signal(signal.SIGUSR1, before)
    drawer.close()
    assert other.add(5) == 5
