"""Tests of a private master on a free port of 127.0.0.1."""

from __future__ import annotations

import os
import signal
import socket
import threading
from pathlib import Path

import pytest

from course_pkg.errors import MalformedMasterUri, MasterSilent, MasterUnreachable, NotAMaster, PortBusy
from course_pkg.ros import MasterClient, PrivateMaster, find_or_start_master
from tests.support import eventually, stopped


def test_it_answers_and_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The master responds inside the `with` block, and has exited after the block.

    The master's log file is in the folder ROS_LOG_DIR.
    """
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    with PrivateMaster() as master:
        client = MasterClient(master.uri)
        assert client.pid() == master.pid
    assert not master.running
    with pytest.raises(MasterUnreachable, match=master.uri):
        client.pid()
    assert [path.name for path in tmp_path.iterdir()] == [f"master-{master.port}.log"]


def test_no_trace_without_a_log_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without ROS_LOG_DIR, the master's log files are removed after its exit."""
    monkeypatch.delenv("ROS_LOG_DIR")
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    with PrivateMaster():
        assert list(tmp_path.iterdir())
    assert not list(tmp_path.iterdir())


def test_busy_port() -> None:
    """If the port is in use, start() raises PortBusy with the port number."""
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(PortBusy, match=str(port)):
            PrivateMaster(port).start()


def test_port_of_a_killed_master_is_free(master: PrivateMaster) -> None:
    """A new master can use the port of a killed master immediately."""
    with PrivateMaster() as former:
        MasterClient(former.uri).system_state()
        os.kill(former.pid, signal.SIGKILL)
        eventually(lambda: not former.running)
        with PrivateMaster(former.port) as latter:
            assert MasterClient(latter.uri).pid() == latter.pid


def test_the_master_of_ros_master_uri_is_used(master: PrivateMaster) -> None:
    """If ROS_MASTER_URI is set, find_or_start_master() returns the master at this address."""
    assert find_or_start_master().uri == master.uri


def test_stopped_master_is_silent(master: PrivateMaster) -> None:
    """A request to a master that is suspended with SIGSTOP raises MasterSilent.

    After SIGCONT, the master responds again.
    """
    client = MasterClient(master.uri, timeout=0.3)
    client.pid()
    with stopped(master.pid), pytest.raises(MasterSilent, match=r"within 0.3 s"):
        client.pid()
    assert client.pid() == master.pid


def test_slow_bytes_do_not_extend_the_timeout() -> None:
    """A server that sends one byte at a time does not extend the timeout."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        over = threading.Event()

        def drip() -> None:
            sock, _ = listener.accept()
            with sock:
                while not over.wait(0.05):
                    sock.sendall(b"H")

        thread = threading.Thread(target=drip)
        thread.start()
        with pytest.raises((MasterSilent, NotAMaster)):
            MasterClient(f"http://localhost:{listener.getsockname()[1]}", timeout=0.4).pid()
        over.set()
        thread.join()


@pytest.mark.parametrize(
    "uri", ["", "localhost:11311", "https://localhost:1", "http://:1", "http://localhost:99999"]
)
def test_malformed_uri(uri: str) -> None:
    """A malformed address raises MalformedMasterUri."""
    with pytest.raises(MalformedMasterUri, match="http://HOST:PORT"):
        MasterClient(uri)


def test_unknown_host() -> None:
    """An unknown host raises MasterUnreachable."""
    with pytest.raises(MasterUnreachable, match="no-such-host"):
        MasterClient("http://no-such-host.invalid:11311").pid()


def test_a_master_that_was_started_again(master: PrivateMaster) -> None:
    """A client can call a master that was restarted at the same address."""
    with PrivateMaster() as former:
        client = MasterClient(former.uri)
        client.pid()
    with PrivateMaster(former.port) as latter:
        assert client.pid() == latter.pid


def test_registrations(master: PrivateMaster) -> None:
    """A client can look up a registration, but needs the registered address to remove the registration."""
    client = MasterClient(master.uri)
    client.register_service("/node", "/service", "rosrpc://localhost:5", "http://localhost:4/")
    client.register_publisher("/node", "/topic", "std_msgs/UInt32", "http://localhost:4/")
    assert client.lookup_service("/service") == "rosrpc://localhost:5"
    assert client.lookup_node("/node") == "http://localhost:4/"
    assert client.lookup_all(["/node", "/nobody"], ["/service", "/nothing"]) == (
        {"/node": "http://localhost:4/"},
        {"/service": "rosrpc://localhost:5"},
    )
    state = client.system_state()
    assert (state.services, state.publishers) == ({"/service": ("/node",)}, {"/topic": ("/node",)})
    assert client.topic_types()["/topic"] == "std_msgs/UInt32"
    assert not client.unregister_service("/node", "/service", "rosrpc://localhost:6")
    assert client.unregister_service("/node", "/service", "rosrpc://localhost:5")
    assert client.unregister_publisher("/node", "/topic", "http://localhost:4/")
    assert client.system_state().nodes == ()
