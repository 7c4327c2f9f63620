"""A notebook's kernel as a node; a cell that calls the node's methods may run again."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial

import rospy

from course_pkg.errors import NotJoined
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.ros.node.subscription import Callback, Subscription
from course_pkg.ros.node.type_lookup import Message, MessageKind, ServiceKind, message_class, service_class
from course_pkg.ros.node.watchdog import Watchdog
from course_pkg.ros.notebook.cells import Cells
from course_pkg.ros.process.node_process import GRACE, NodeProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.trace.collector import recorded
from course_pkg.ros.trace.recording import Recording


class Node:
    """This kernel as a node of the graph, created by join()."""

    def __init__(self, leave: Callable[[Node], None], cells: Cells) -> None:
        self._leave = leave
        self._cells = cells
        self._watchdog = Watchdog()
        self._master = MasterClient(master_uri())
        self._subscriptions: dict[str, Subscription] = {}
        self._processes: dict[str, NodeProcess] = {}
        self._proxies: dict[tuple[str, int], BoundedProxy] = {}
        self._uri = rospy.get_node_uri()
        self._pid = os.getpid()

    @property
    def name(self) -> str:
        """The node's full name, such as "/chapter_05"."""
        return str(rospy.get_name())

    @property
    def uri(self) -> str:
        """The node's address, to which the master and other nodes send XML-RPC requests."""
        return str(rospy.get_node_uri())

    @property
    def master(self) -> str:
        """The master's address."""
        return master_uri()

    def call(
        self, name: str, kind: ServiceKind, /, *args: object, timeout: float = 5.0, **fields: object
    ) -> Message:
        """Call a service and return its response.

        Pass the request's fields by position or by name, or pass one request object.

        Raises CallTimeout after `timeout` s, and the same errors as rospy.ServiceProxy.
        """
        return self._proxy(name, kind).call(*args, timeout=timeout, **fields)

    def subscribe(self, topic: str, kind: MessageKind, callback: Callback | None = None) -> Subscription:
        """Subscribe to a topic, and end this kernel's earlier subscription to the same topic.

        `callback` runs on a thread of rospy. Raises MasterUnreachable or MasterSilent when the master does
        not answer.
        """
        self._require()
        self._client().pid()
        full = rospy.resolve_name(topic)
        if full in self._subscriptions:
            self._subscriptions.pop(full).stop()
        # The subscription ends at the next subscribe() to the same topic, not when the cell runs again.
        with self._cells.paused():
            self._subscriptions[full] = Subscription(full, message_class(kind), callback)
        return self._subscriptions[full]

    def run(self, package: str, executable: str, *args: str, name: str | None = None) -> NodeProcess:
        """Run a program of a package as a process, and stop this node's earlier process with the same name.

        `name` is the name of the new node; several processes of one program need different names. The
        arguments `__name:=…` and `__ns:=…` also set the node's name and namespace. Raises UnknownExecutable
        if the package has no such program.
        """
        start = partial(NodeProcess.rosrun, package, executable, *args, name=name)
        renamed = [arg for arg in map(str, args) if arg.startswith(("__name:=", "__ns:="))]
        return self._started(" ".join([name or f"{package}/{executable}", *renamed]), start)

    def keep(self, process: NodeProcess) -> None:
        """End the process `process` when this node ends."""
        self._processes[f"process {process.pid}"] = process

    def record(self) -> AbstractContextManager[Recording]:
        """Record the calls, messages and callbacks of all nodes of the course during a `with` block.

        The recording is empty until the `with` block ends. The collection of the records takes up to 1 s if a
        node does not answer.
        """
        self._require()
        return recorded(self.name, self.uri, self._client())

    def leave(self) -> None:
        """End everything that this node has started, and remove the node from the graph."""
        self._leave(self)

    def renew(self) -> None:
        """Create the subscriptions again after a restart of rospy.

        This method does not create objects again if a cell created them directly with rospy.
        """
        if self._uri == rospy.get_node_uri():
            return
        self._uri = rospy.get_node_uri()
        for subscription in self._subscriptions.values():
            subscription.renew()

    def close(self, *, with_master: bool = True) -> None:
        """End everything that this node has started; if `with_master` is true, unregister the node."""
        # All processes receive SIGINT at the same time, so all of them have the same deadline.
        deadline = time.monotonic() + GRACE
        for process in self._processes.values():
            process.interrupt()
        while self._processes:
            self._processes.popitem()[1].stop(max(deadline - time.monotonic(), 0.1), unregister=with_master)
        while self._proxies:
            self._proxies.popitem()[1].close()
        while self._subscriptions:
            self._subscriptions.popitem()[1].stop(unregister=with_master)

    def __repr__(self) -> str:
        return f"<node {self.name}>"

    def _client(self) -> MasterClient:
        """Return a MasterClient for the master that rospy uses now."""
        if self._master.uri != master_uri():
            self._master = MasterClient(master_uri())
        return self._master

    def _started(self, label: str, start: Callable[[], NodeProcess]) -> NodeProcess:
        self._require()
        if label in self._processes:
            self._processes.pop(label).stop()
        self._processes[label] = start()
        return self._processes[label]

    def _proxy(self, name: str, kind: ServiceKind) -> BoundedProxy:
        cls = service_class(kind)
        # The id() of a class is unique while the class exists. The stored proxy refers to the class, so the
        # class exists at least as long as the proxy. The stored proxy has a reference to the class, so the
        # class exists as long as the proxy.
        key = (str(rospy.resolve_name(name)), id(cls))
        if key not in self._proxies:
            self._require()
            self._proxies[key] = BoundedProxy(name, cls, watchdog=self._watchdog)
        return self._proxies[key]

    def _require(self) -> None:
        if os.getpid() != self._pid:
            raise NotJoined(
                "This process was forked from the node's process, but a fork does not copy the "
                "threads that a node needs. Use threads, or start a new process and call "
                "join() there with a different name."
            )
        if rospy.core.is_shutdown():
            raise NotJoined(
                "This kernel's node has been shut down: by rospy.signal_shutdown(), by an "
                "interrupt of rospy.spin(), or by another node with the same name. Run the "
                "set-up cell with join() again."
            )
