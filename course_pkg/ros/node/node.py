"""A notebook's kernel as a node: each of its cells may run again."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial

import rospy

from course_pkg.errors import NotJoined
from course_pkg.ros.node.handler_output import HandlerOutput
from course_pkg.ros.node.proxy import BoundedProxy
from course_pkg.ros.node.publisher import Publisher
from course_pkg.ros.node.service import Handler, Service
from course_pkg.ros.node.subscription import Callback, Subscription
from course_pkg.ros.node.type_lookup import Message, MessageKind, ServiceKind, message_class, service_class
from course_pkg.ros.node.watchdog import Watchdog
from course_pkg.ros.notebook.cells import Cells
from course_pkg.ros.process.node_process import GRACE, NodeProcess
from course_pkg.ros.protocol.master_api import MasterClient, master_uri
from course_pkg.ros.trace.collector import recorded
from course_pkg.ros.trace.recording import Recording


class Node:
    """This kernel on the graph; join() makes it. `leave` takes it off the graph."""

    def __init__(self, leave: Callable[[Node], None], cells: Cells) -> None:
        self._leave = leave
        self._cells = cells
        self._output = HandlerOutput()
        self._watchdog = Watchdog()
        self._master = MasterClient(master_uri())
        self._services: dict[str, Service] = {}
        self._subscriptions: dict[str, Subscription] = {}
        self._publishers: dict[str, Publisher] = {}
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
        """The node's address, where the master and other nodes call it."""
        return str(rospy.get_node_uri())

    @property
    def master(self) -> str:
        """The master's address."""
        return master_uri()

    def serve(self, name: str, kind: ServiceKind, handler: Handler) -> Service:
        """Serve `name` with `handler`, in the place of this kernel's earlier service of that name.

        Raises UnknownType, NotAServiceType, NotJoined, and MasterUnreachable or MasterSilent where
        rospy.Service would wait for ever.
        """
        self._require()
        service = Service(name, service_class(kind), handler, self._output)
        self._output.install()
        service.start(self._client())
        self._services[service.name] = service
        return service

    def call(
        self, name: str, kind: ServiceKind, /, *args: object, timeout: float = 5.0, **fields: object
    ) -> Message:
        """Call a service and return its response; the request by position, by field, or whole.

        Raises CallTimeout after `timeout` s, and otherwise what rospy.ServiceProxy raises.
        """
        return self._proxy(name, kind).call(*args, timeout=timeout, **fields)

    def caller(
        self, name: str, kind: ServiceKind, *, persistent: bool = False, timeout: float = 5.0
    ) -> BoundedProxy:
        """Return a new proxy of a service: it can be called, and cancelled from another thread."""
        self._require()
        return BoundedProxy(name, kind, persistent=persistent, timeout=timeout, watchdog=self._watchdog)

    def subscribe(self, topic: str, kind: MessageKind, callback: Callback | None = None) -> Subscription:
        """Subscribe to a topic, in the place of an earlier subscription; `callback` runs on rospy's thread.

        Raises MasterUnreachable or MasterSilent where rospy.Subscriber would wait for ever.
        """
        self._require()
        self._client().pid()
        full = rospy.resolve_name(topic)
        if full in self._subscriptions:
            self._subscriptions.pop(full).stop()
        with self._cells.paused():  # it ends when another takes its place, not when its cell runs again
            self._subscriptions[full] = Subscription(full, message_class(kind), callback)
        return self._subscriptions[full]

    def advertise(
        self, topic: str, kind: MessageKind, *, queue_size: int = 10, latch: bool = False
    ) -> Publisher:
        """Publish on a topic, in the place of an earlier publisher; `latch` keeps the last message.

        Raises MasterUnreachable or MasterSilent where rospy.Publisher would wait for ever.
        """
        self._require()
        self._client().pid()
        full = rospy.resolve_name(topic)
        if full in self._publishers:
            self._publishers.pop(full).stop()
        with self._cells.paused():
            self._publishers[full] = Publisher(full, message_class(kind), queue_size=queue_size, latch=latch)
        return self._publishers[full]

    def run(self, package: str, executable: str, *args: str, name: str | None = None) -> NodeProcess:
        """Run a package's node as a process, in the place of the one started as the same before.

        `name` renames the node, so that several of one program can run, as `__name:=…` and `__ns:=…` do
        among `args`. Raises UnknownExecutable.
        """
        start = partial(NodeProcess.rosrun, package, executable, *args, name=name)
        renamed = [arg for arg in map(str, args) if arg.startswith(("__name:=", "__ns:="))]
        return self._started(" ".join([name or f"{package}/{executable}", *renamed]), start)

    def launch(self, package: str, file: str, *args: str) -> NodeProcess:
        """Run a launch file with arguments such as "client:=true", in the place of the one started before."""
        return self._started(f"{package}/{file}", partial(NodeProcess.roslaunch, package, file, *args))

    def keep(self, process: NodeProcess) -> None:
        """End `process` with this node, at the latest."""
        self._processes[f"process {process.pid}"] = process

    def record(self) -> AbstractContextManager[Recording]:
        """Record what every course node on the graph does during the block of a `with`.

        The recording is filled when the block ends, which takes at most 1 s longer for nodes that are silent.
        """
        self._require()
        return recorded(self.name, self.uri, self._client())

    def leave(self) -> None:
        """End all that this node has started, and take it off the graph; join() brings it back."""
        self._leave(self)

    def renew(self) -> None:
        """Serve, subscribe and publish again after a restart of rospy; objects of plain rospy are lost."""
        if self._uri == rospy.get_node_uri():
            return
        self._uri = rospy.get_node_uri()
        for service in self._services.values():
            service.renew(self._client())
        for subscription in self._subscriptions.values():
            subscription.renew()
        for publisher in self._publishers.values():
            publisher.renew()

    def close(self, *, with_master: bool = True) -> None:
        """End all that was started here; without a master that answers, nothing is unregistered."""
        deadline = time.monotonic() + GRACE  # of all together: each was asked to end at the same time
        for process in self._processes.values():
            process.interrupt()
        while self._processes:
            self._processes.popitem()[1].stop(max(deadline - time.monotonic(), 0.1), unregister=with_master)
        while self._proxies:
            self._proxies.popitem()[1].close()
        while self._subscriptions:
            self._subscriptions.popitem()[1].stop(unregister=with_master)
        while self._publishers:
            self._publishers.popitem()[1].stop(unregister=with_master)
        while self._services:
            self._services.popitem()[1].stop(unregister=with_master)
        self._output.remove()

    def __repr__(self) -> str:
        return f"<node {self.name}>"

    def _client(self) -> MasterClient:
        """Return the client of the master that rospy talks to, which may be another than before."""
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
        key = (str(rospy.resolve_name(name)), id(cls))  # the proxy keeps the class, and so its id
        if key not in self._proxies:
            self._proxies[key] = self.caller(name, cls)
        return self._proxies[key]

    def _require(self) -> None:
        if os.getpid() != self._pid:
            raise NotJoined(
                "This process was forked from the one that is the node, and has none of the threads that a "
                "node needs. Use threads, or processes that are started afresh and join() by another name."
            )
        if rospy.core.is_shutdown():
            raise NotJoined(
                "This kernel's node has been shut down: by rospy.signal_shutdown(), by interrupting "
                "rospy.spin(), or by another node that took its name. Run the set-up cell with join() "
                "again: it begins anew."
            )
