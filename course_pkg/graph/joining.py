"""How a kernel becomes a node, again and again, where rospy allows one for each process, and one start."""

from __future__ import annotations

import atexit
import os
import threading
import time
from contextlib import suppress
from functools import cache
from pkgutil import extend_path

import rosgraph.names
import rospy

import course_pkg
from course_pkg.errors import GraphError, MasterUnreachable, NodeNameTaken, NotJoined, SetupError
from course_pkg.graph.calls import settle_keepalive
from course_pkg.graph.farewell import say_farewell
from course_pkg.graph.leash import Leash
from course_pkg.graph.logs import logging_kept
from course_pkg.graph.master import PrivateMaster, find_or_start_master, master_uri
from course_pkg.graph.node import Node
from course_pkg.graph.preparation import prepare_node
from course_pkg.graph.probe import Reach, ask_all, node_probe
from course_pkg.graph.registrar import (
    node_known,
    register_all,
    registration_manager,
    unregister_all,
)
from course_pkg.graph.revival import begin_again, can_begin_again
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.stale import remove_stale

HANDOVER = 2.0  # s for a former holder of the name to end, such as a kernel that is being restarted


def join(name: str) -> Node:
    """Make this kernel the node `name`, and return it; run again, it returns the same node.

    Uses the master of ROS_MASTER_URI, or starts one that ends with this kernel. After that master was lost
    and another has taken its place, it registers again what this node had.
    """
    return _kernel(os.getpid()).join(name)


def this_node() -> Node | None:
    """Return what join() has made of this kernel, or None when it has not been called yet."""
    return _kernel(os.getpid()).node


def leave(node: Node) -> None:
    """Take this kernel's node off the graph."""
    _kernel(os.getpid()).leave(node)


@cache
def _kernel(pid: int) -> _Kernel:
    """Return this process's one membership; a forked child is not what its parent was."""
    return _Kernel(pid)


class _Kernel:
    """This process's membership: its node, the master it owns if any, and who clears up after a SIGKILL."""

    def __init__(self, pid: int) -> None:
        self._pid = pid
        self._node: Node | None = None
        self._private: PrivateMaster | None = None
        self._undertaker: Leash | None = None
        self._will: tuple[str, str, str] | None = None

    def join(self, name: str) -> Node:
        _require_main_thread()
        full = _full(name)
        _require_same(full)
        _apply_environment()
        self._settle_master()
        master = MasterClient(master_uri())
        self._settle_rospy(full, master)
        if self._node is None:
            self._node = Node()
            atexit.register(self._at_exit)
            # The end of a forked child would withdraw from the master what is its parent's.
            os.register_at_fork(after_in_child=lambda: atexit.unregister(rospy.core._ros_atexit))
        self._node.renew()
        self._hire(master)
        return self._node

    @property
    def node(self) -> Node | None:
        """This kernel's node, if it has joined."""
        return self._node

    def leave(self, node: Node) -> None:
        master = MasterClient(master_uri())
        try:
            master.pid()
        except GraphError:
            node.close(with_master=False)
        else:
            node.close()
            say_farewell()
            unregister_all(master)
        self._dismiss()

    def _settle_rospy(self, full: str, master: MasterClient) -> None:
        """Have rospy running as this node, and the master knowing it."""
        if rospy.core.is_shutdown():
            begin_again()
        if not rospy.core.is_initialized():
            _make_room(full, master)
            settle_keepalive(master)
            with logging_kept():
                rospy.init_node(full.removeprefix("/"), disable_signals=True)
        elif not node_known(master):
            _make_room(full, master)
            register_all(master)
        prepare_node()

    def _settle_master(self) -> None:
        """Have a master that answers; a private one that was lost is replaced at the same address."""
        try:
            found = find_or_start_master()
        except MasterUnreachable:
            if self._private is None or self._private.uri != master_uri():
                raise
            self._private.stop()
            found = PrivateMaster(self._private.port).start()
        if isinstance(found, PrivateMaster):
            self._private = found

    def _hire(self, master: MasterClient) -> None:
        """On a master that outlives this kernel, have the node withdrawn should the kernel be killed."""
        ours = self._private is not None and self._private.uri == master.uri
        will = None if ours else (master.uri, rospy.get_name(), rospy.get_node_uri())
        if will != self._will:
            self._dismiss()
            self._undertaker, self._will = Leash([], forget=will) if will else None, will

    def _dismiss(self) -> None:
        undertaker, self._undertaker, self._will = self._undertaker, None, None
        if undertaker is not None:
            undertaker.end()

    def _at_exit(self) -> None:
        if os.getpid() != self._pid or self._node is None:
            return
        with suppress(GraphError, OSError):
            self.leave(self._node)
        if (manager := registration_manager()) is not None:
            manager.master_uri = None  # all is withdrawn; rospy's own attempt has no limit
        if self._private is not None:
            self._private.stop()


def _require_main_thread() -> None:
    if threading.current_thread() is not threading.main_thread():
        raise NotJoined(
            "join() was called on a thread. rospy can be started on the main thread only, and an attempt "
            "anywhere else spoils this kernel for the next: call join() in a cell of its own."
        )


def _full(name: str) -> str:
    base = name.removeprefix("/")
    if not rosgraph.names.is_legal_base_name(base):
        raise NotJoined(f"{name!r} cannot be a node's name: letters, digits and _ only, and a letter first.")
    return "/" + base


def _require_same(full: str) -> None:
    if rospy.core.is_shutdown() and not can_begin_again():
        raise NotJoined(
            "This kernel's node has been shut down, and this release of rospy cannot begin again in one "
            "process: restart the kernel, and run the cells again."
        )
    if rospy.core.is_initialized() and rospy.get_name() != full:
        base = rospy.get_name().removeprefix("/")
        raise NotJoined(
            f"This kernel is the node {rospy.get_name()} already, and one process can be one node only. Use "
            f"join({base!r}), or restart the kernel to be {full}."
        )


def _apply_environment() -> None:
    """Find the workspace where nobody has sourced it: an editor's notebook, Binder."""
    if "ROS_PACKAGE_PATH" not in os.environ:
        from course_pkg.provision import environment

        if not environment.apply():
            raise SetupError(
                "The course's workspace is not built on this machine. Run `./course doctor` in a terminal: "
                "it says what is missing. Then run this cell again."
            )
        course_pkg.__path__ = extend_path(course_pkg.__path__, course_pkg.__name__)  # course_pkg.srv is there
    if not any(os.environ.get(name) for name in ("ROS_HOSTNAME", "ROS_IP")):
        os.environ["ROS_HOSTNAME"] = "localhost"


def _make_room(full: str, master: MasterClient) -> None:
    """Make sure that nobody living has the name, and that nothing of somebody dead is left under it."""
    deadline = time.monotonic() + HANDOVER
    while (uri := master.lookup_node(full)) is not None:
        probe = node_probe(uri)
        ask_all([probe], timeout=1.0)
        if probe.reach is Reach.REFUSED:
            remove_stale(master.uri, nodes=frozenset({full}))
            return
        if time.monotonic() > deadline:
            raise NodeNameTaken(_taken(full, uri, probe.reach))
        time.sleep(0.05)


def _taken(full: str, uri: str, reach: Reach) -> str:
    silent = " It does not answer: it is stopped, or hangs." if reach is Reach.SILENT else ""
    return (
        f"Another node is {full} already, at {uri}.{silent} Two kernels with one notebook? Shut the other "
        "kernel down and run this cell again, or take another name here. Joining would have shut that node "
        "down."
    )
