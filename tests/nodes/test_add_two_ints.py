"""The adder, its client, and the client of another definition."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from course_pkg.graph import NodeProcess
from course_pkg.interfaces import service_type
from course_pkg.nodes.add_two_ints_server import LARGEST
from tests.nodes.terminals import program, terminal
from tests.support import eventually

pytestmark = pytest.mark.usefixtures("master")


@pytest.fixture
def server() -> Iterator[NodeProcess]:
    """`rosrun course_pkg add_two_ints_server`, answering."""
    with NodeProcess(["rosrun", "course_pkg", "add_two_ints_server"]) as process:
        process.wait_for_service("/add_two_ints")
        yield process


@pytest.mark.usefixtures("server")
@pytest.mark.parametrize(
    ("numbers", "printed"),
    [
        (["20", "22"], "20 + 22 = 42\n"),
        (["-20", "-22"], "-20 + -22 = -42\n"),
        ([str(LARGEST), "-1"], f"{LARGEST} + -1 = {LARGEST - 1}\n"),
    ],
)
def test_client_prints_the_sum(numbers: list[str], printed: str) -> None:
    """The client prints the sum and nothing else, for numbers below zero and for the largest, too."""
    done = program("add_two_ints_client", *numbers)
    assert (done.returncode, done.stdout, done.stderr) == (0, printed, "")


@pytest.mark.usefixtures("server")
@pytest.mark.parametrize(("a", "b"), [(LARGEST, 1), (-LARGEST - 1, -1)])
def test_sum_that_no_int64_holds(a: int, b: int) -> None:
    """A sum that cannot be sent is refused in words, and is no fault of the server."""
    done = program("add_two_ints_client", str(a), str(b))
    assert done.returncode == 1
    assert f"cannot process request: {a + b} is more than an int64 can hold" in done.stderr


@pytest.mark.parametrize("words", [[], ["1"], ["1", "2", "3"], ["1", "2.5"], ["1", str(LARGEST + 1)]])
def test_client_with_a_wrong_line(words: list[str]) -> None:
    """What are not two numbers that an int64 holds is the usage text and exit status 2, without a server."""
    done = program("add_two_ints_client", *words)
    assert done.returncode == 2
    assert done.stderr.startswith("usage: add_two_ints_client A B")


def test_client_of_another_definition_is_refused(server: NodeProcess) -> None:
    """Client and server compare MD5 sums, and the client gets both of them, and no sum."""
    done = program("add_two_floats_client", "20", "22")
    ours = service_type("course_pkg/AddTwoInts").md5
    assert (done.returncode, done.stdout) == (1, "")
    refusal = "remote error reported: request from [/add_two_floats_client]: md5sums do not match: ["
    assert refusal in done.stderr
    assert f"vs. [{ours}]" in done.stderr
    assert "Traceback" not in done.stderr
    eventually(lambda: "md5sums do not match" in server.output())
    assert terminal("rosservice", "call", "/add_two_ints", "1", "2").stdout == "sum: 3\n"


def test_client_of_another_definition_with_a_wrong_line() -> None:
    """Its usage is its own, and comes without a server."""
    done = program("add_two_floats_client", "one", "2")
    assert done.returncode == 2
    assert done.stderr.startswith("usage: add_two_floats_client A B")
