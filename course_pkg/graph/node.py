"""A notebook's kernel as a node, all of whose doings may be run again."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import partial
from typing import Any

import rospy

from course_pkg.errors import NotJoined
from course_pkg.graph.calls import BoundedProxy
from course_pkg.graph.gathering import recorded
from course_pkg.graph.heard import Heard
from course_pkg.graph.master import master_uri
from course_pkg.graph.output import HandlerOutput
from course_pkg.graph.processes import GRACE, NodeProcess
from course_pkg.graph.recording import Recording
from course_pkg.graph.rpc import MasterClient
from course_pkg.graph.served import Handler, Served
from course_pkg.graph.spoken import Spoken
from course_pkg.graph.types import message_class, service_class
from course_pkg.graph.watchdog import Watchdog


class Node:
    """This kernel on the graph; join() makes it."""

    def __init__(self) -> None:
        self._output = HandlerOutput()
        self._watchdog = Watchdog()
        self._master = MasterClient(master_uri())
        self._served: dict[str, Served] = {}
        self._heard: dict[str, Heard] = {}
        self._spoken: dict[str, Spoken] = {}
        self._processes: dict[str, NodeProcess] = {}
        self._proxies: dict[tuple[str, Any], BoundedProxy] = {}
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

    def serve(self, name: str, kind: Any, handler: Handler) -> Served:  # noqa: ANN401
        """Serve `name` with `handler`, in the place of whatever this kernel served by that name before.

        Raises MasterUnreachable or MasterSilent where rospy.Service would wait for ever.
        """
        self._require()
        served = Served(name, service_class(kind), handler, self._output)
        self._output.install()
        served.start(self._client())
        self._served[served.name] = served
        return served

    def call(self, name: str, kind: Any, /, *args: Any, timeout: float = 5.0, **fields: Any) -> Any:  # noqa: ANN401
        """Call a service and return its response; the request by position, by field, or whole.

        Raises CallTimeout after `timeout` s, and otherwise what rospy.ServiceProxy raises.
        """
        return self._proxy(name, kind).call(*args, timeout=timeout, **fields)

    def caller(self, name: str, kind: Any, *, persistent: bool = False, timeout: float = 5.0) -> BoundedProxy:  # noqa: ANN401
        """Return a proxy of its own for a service: callable, and to be cancelled from another thread."""
        self._require()
        return BoundedProxy(name, kind, persistent=persistent, timeout=timeout, watchdog=self._watchdog)

    def subscribe(self, topic: str, kind: Any, callback: Callable[[Any], object] | None = None) -> Heard:  # noqa: ANN401
        """Listen to a topic, in the place of an earlier subscription; `callback` runs on rospy's thread."""
        self._require()
        self._client().pid()  # rospy.Subscriber would wait for ever
        full = rospy.resolve_name(topic)
        if full in self._heard:
            self._heard.pop(full).stop()
        self._heard[full] = Heard(full, message_class(kind), callback)
        return self._heard[full]

    def advertise(self, topic: str, kind: Any, *, queue_size: int = 10, latch: bool = False) -> Spoken:  # noqa: ANN401
        """Publish on a topic, in the place of an earlier publisher; `latch` keeps the last message.

        Raises MasterUnreachable or MasterSilent where rospy.Publisher would wait for ever.
        """
        self._require()
        self._client().pid()
        full = rospy.resolve_name(topic)
        if full in self._spoken:
            self._spoken.pop(full).stop()
        self._spoken[full] = Spoken(full, message_class(kind), queue_size=queue_size, latch=latch)
        return self._spoken[full]

    def run(self, package: str, executable: str, *args: str, name: str | None = None) -> NodeProcess:
        """Run a package's node as a process, in the place of the one started as the same before.

        `name` renames the node, so that several of one program can run, as `__name:=…` and `__ns:=…` do
        among `args`. Raises UnknownExecutable.
        """
        start = partial(NodeProcess.rosrun, package, executable, *args, name=name)
        renamed = [word for word in map(str, args) if word.startswith(("__name:=", "__ns:="))]
        return self._started(" ".join([name or f"{package}/{executable}", *renamed]), start)

    def launch(self, package: str, file: str, *args: str) -> NodeProcess:
        """Run a launch file with arguments such as "client:=true", in the place of the one started before."""
        return self._started(f"{package}/{file}", partial(NodeProcess.roslaunch, package, file, *args))

    def record(self) -> AbstractContextManager[Recording]:
        """Record what every course node on the graph does during the block of a `with`.

        The recording is filled when the block ends, which takes at most 1 s longer for nodes that are silent.
        """
        self._require()
        return recorded(self.name, self.uri, self._client())

    def leave(self) -> None:
        """End what this node has begun, and take it off the graph; join() brings it back."""
        from course_pkg.graph.joining import leave

        leave(self)

    def renew(self) -> None:
        """Serve and subscribe again, if rospy has begun anew; what was asked of rospy itself is lost."""
        if self._uri == rospy.get_node_uri():
            return
        self._uri = rospy.get_node_uri()
        for served in self._served.values():
            served.renew(self._client())
        for heard in self._heard.values():
            heard.renew()
        for spoken in self._spoken.values():
            spoken.renew()

    def close(self, *, with_master: bool = True) -> None:
        """End all that was begun here; without a master that answers, nothing is withdrawn from it."""
        deadline = time.monotonic() + GRACE  # of all together: each was asked to end at the same time
        for process in self._processes.values():
            process.interrupt()
        while self._processes:
            self._processes.popitem()[1].stop(max(deadline - time.monotonic(), 0.1), withdraw=with_master)
        while self._proxies:
            self._proxies.popitem()[1].close()
        while self._heard:
            self._heard.popitem()[1].stop(withdraw=with_master)
        while self._spoken:
            self._spoken.popitem()[1].stop(withdraw=with_master)
        while self._served:
            self._served.popitem()[1].stop(withdraw=with_master)
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

    def _proxy(self, name: str, kind: Any) -> BoundedProxy:  # noqa: ANN401
        cls = service_class(kind)
        key = (rospy.resolve_name(name), cls)
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
