"""Turn a Jupyter kernel into a ROS node.

A cell may call join() many times, although rospy can start only once in a process.
"""

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
from course_pkg.ros.node.node import Node
from course_pkg.ros.node.preparation import prepare_node
from course_pkg.ros.node.proxy import settle_keepalive
from course_pkg.ros.node.restart import allow_init_node, begin_again, can_begin_again, logging_kept
from course_pkg.ros.notebook.cells import Cells
from course_pkg.ros.notebook.creations import close_all, note_creations
from course_pkg.ros.notebook.figures import set_up_figures
from course_pkg.ros.notebook.shell import NotebookShell, current_shell
from course_pkg.ros.process.roscore import Roscore, find_or_start_master
from course_pkg.ros.process.supervised import SupervisedProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.protocol.probe import Reach, ask_all, node_probe
from course_pkg.ros.protocol.registrations import remove_stale, withdraw_node
from course_pkg.ros.protocol.rospy_registrations import node_known, register_all, registration_manager
from course_pkg.ros.trace.handover import hand_over
from course_pkg.workspace import OwnPackages, own_workspace

# join() waits up to this time in s for the end of another node with the same name. For example, this is the
# node of a restarting kernel.
NAME_TIMEOUT = 2.0


def join(name: str) -> Node:
    """Make this kernel the node `name`, and return the node; a second call returns the same node.

    join() uses the master at ROS_MASTER_URI. If this variable is not set, join() starts a private master that
    ends with this kernel. After a restart of the master, join() registers this node's services and topics
    again.
    """
    return _kernel(os.getpid()).join(name)


def this_node() -> Node | None:
    """Return the node of this kernel, or None before the first join()."""
    return _kernel(os.getpid()).node


def cells() -> Cells:
    """Return the object that records the runs of this kernel's cells."""
    return _kernel(os.getpid()).cells


def leave(node: Node) -> None:
    """Remove this kernel's node from the graph."""
    _kernel(os.getpid()).leave(node)


@cache
def _kernel(pid: int) -> _Kernel:
    """Return the only _Kernel of this process.

    A forked child process gets a new _Kernel.
    """
    return _Kernel(pid)


class _Kernel:
    """This process's node, its private master, and the process that unregisters the node after a SIGKILL."""

    def __init__(self, pid: int) -> None:
        self._pid = pid
        self.cells = Cells(close_all)
        self._shell: NotebookShell | None = None
        self._node: Node | None = None
        self._packages: OwnPackages | None = None
        self._private: Roscore | None = None
        self._cleaner: SupervisedProcess | None = None
        # The cleaner process uses these data to unregister the node: the master's URI, the node's name and
        # URI.
        self._registered: tuple[str, str, str] | None = None

    def join(self, name: str) -> Node:
        _require_main_thread()
        self._follow_cells()
        full = _full(name)
        _require_same_name(full)
        with self.cells.paused():
            return self._joined(full)

    def _follow_cells(self) -> None:
        """Observe the runs of the notebook's cells, if this process is the kernel of a notebook."""
        shell = current_shell()
        if shell is not None and self._shell is None:
            self._shell = NotebookShell(shell, self.cells)

    def _joined(self, full: str) -> Node:
        _apply_environment()
        if self._packages is None:
            self._packages = OwnPackages(own_workspace())
            self._packages.follow_cells(current_shell())
        set_up_figures()
        self._ensure_master()
        master = MasterClient(master_uri())
        self._ensure_rospy(full, master)
        note_creations(self.cells)
        if self._shell is not None:
            self._shell.errors.follow_threads()
        if self._node is None:
            self._node = Node(leave, self.cells)
            if self._shell is not None:
                self._shell.add_programs(self._node.keep)
            atexit.register(self._at_exit)
            # A forked child process must not unregister its parent's services and topics when it ends.
            os.register_at_fork(after_in_child=lambda: atexit.unregister(rospy.core._ros_atexit))
        self._node.renew()
        self._start_cleaner(master)
        return self._node

    @property
    def node(self) -> Node | None:
        """This kernel's node, or None before the first join()."""
        return self._node

    def leave(self, node: Node) -> None:
        master = MasterClient(master_uri())
        try:
            master.pid()
        except GraphError:
            node.close(with_master=False)
        else:
            node.close()
            hand_over()
            withdraw_node(master, node.name, node.uri)
        self._end_cleaner()

    def _ensure_rospy(self, full: str, master: MasterClient) -> None:
        """Start rospy with this node name if necessary. Register the node if the master does not know it."""
        if rospy.core.is_shutdown():
            begin_again()
        if not rospy.core.is_initialized():
            _free_name(full, master)
            settle_keepalive(master)
            with logging_kept():
                rospy.init_node(full.removeprefix("/"), disable_signals=True)
            allow_init_node()
        elif not node_known(master):
            _free_name(full, master)
            register_all(master)
        prepare_node()

    def _ensure_master(self) -> None:
        """Find or start a master that answers.

        If this kernel's private master has ended, restart it at the same address.
        """
        try:
            found = find_or_start_master()
        except MasterUnreachable:
            if self._private is None or self._private.uri != master_uri():
                raise
            self._private.stop()
            found = Roscore(self._private.port).start()
        if isinstance(found, Roscore):
            self._private = found

    def _start_cleaner(self, master: MasterClient) -> None:
        """Start a process that unregisters the node if this kernel is killed.

        If the master is private, no cleaner process is necessary, because the master ends with the kernel.
        """
        ours = self._private is not None and self._private.uri == master.uri
        registered = None if ours else (master.uri, rospy.get_name(), rospy.get_node_uri())
        if registered != self._registered:
            self._end_cleaner()
            self._cleaner = SupervisedProcess([], withdraw=registered) if registered else None
            self._registered = registered

    def _end_cleaner(self) -> None:
        cleaner, self._cleaner, self._registered = self._cleaner, None, None
        if cleaner is not None:
            cleaner.end()

    def _at_exit(self) -> None:
        if os.getpid() != self._pid or self._node is None:
            return
        with suppress(GraphError, OSError):
            self.leave(self._node)
        if (manager := registration_manager()) is not None:
            # The node is already unregistered. Without this line, rospy would unregister the node again,
            # without a time limit.
            manager.master_uri = None
        if self._private is not None:
            self._private.stop()


def _require_main_thread() -> None:
    if threading.current_thread() is not threading.main_thread():
        raise NotJoined(
            "join() was called on another thread, but rospy can start only on the main thread. Call join() "
            "in a separate cell."
        )


def _full(name: str) -> str:
    base = name.removeprefix("/")
    if not rosgraph.names.is_legal_base_name(base):
        raise NotJoined(
            f"{name!r} cannot be a node's name. Use only letters, digits and _, and begin with a letter."
        )
    return "/" + base


def _require_same_name(full: str) -> None:
    if rospy.core.is_shutdown() and not can_begin_again():
        raise NotJoined(
            "This kernel's node has been shut down, and this release of rospy cannot start a second time in "
            "one process. Restart the kernel, and run the cells again."
        )
    if rospy.core.is_initialized() and rospy.get_name() != full:
        base = rospy.get_name().removeprefix("/")
        raise NotJoined(
            f"This kernel is already the node {rospy.get_name()}, and one process can be only "
            f"one node. Call join({base!r}), or restart the kernel to use the name {full}."
        )


def _apply_environment() -> None:
    """Set the workspace's environment variables if the workspace's setup file was not sourced.

    An editor or Binder, for example, does not source this file.
    """
    if "ROS_PACKAGE_PATH" not in os.environ:
        from course_pkg.setup import environment

        if not environment.apply():
            raise SetupError(
                "The course's workspace is not built on this machine. Run `./course doctor` in "
                "a terminal, and install the missing programs. Then run this cell again."
            )
        # With the extended `__path__`, Python finds the generated package course_pkg.srv.
        course_pkg.__path__ = extend_path(course_pkg.__path__, course_pkg.__name__)
    if not any(os.environ.get(name) for name in ("ROS_HOSTNAME", "ROS_IP")):
        os.environ["ROS_HOSTNAME"] = "localhost"


def _free_name(full: str, master: MasterClient) -> None:
    """Wait until no other node uses this name.

    If the other node has ended, remove its registrations. Raises NodeNameTaken if the other node still has
    the name after NAME_TIMEOUT seconds.
    """
    deadline = time.monotonic() + NAME_TIMEOUT
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
    silent = ", and does not answer" if reach is Reach.SILENT else ""
    return (
        f"Another node already has the name {full}, at {uri}{silent}. If this node is a second "
        "kernel with the same notebook, shut that kernel down. Otherwise, use a different name "
        "here."
    )
