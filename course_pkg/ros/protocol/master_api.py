"""A client of the master's API, with time limits: http://wiki.ros.org/ROS/Master_API."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from course_pkg.errors import GraphError, MasterSilent, MasterUnreachable, NotAMaster
from course_pkg.ros.protocol.xmlrpc import NO_ANSWER, RpcValue, XmlRpcClient, items

Addresses = dict[str, str]  # The dict maps the name of each node or service to its address.
REMAP = "__master:="  # Source: http://wiki.ros.org/Remapping%20Arguments
# The mapping assigns nodes to each topic or service: the publishers, the subscribers, or the server.
Registered = Mapping[str, tuple[str, ...]]


def master_uri() -> str:
    """Return the address at which rospy expects the master: from __master:=, or else from ROS_MASTER_URI."""
    named = [argument.removeprefix(REMAP) for argument in sys.argv if argument.startswith(REMAP)]
    return next(iter(named), "") or os.environ.get("ROS_MASTER_URI") or "http://localhost:11311"


@dataclass(frozen=True)
class SystemState:
    """The master's lists: the publishers and subscribers of each topic, and the servers of each service."""

    publishers: Registered
    subscribers: Registered
    services: Registered

    @property
    def nodes(self) -> tuple[str, ...]:
        """The names of all nodes with at least one registration, sorted."""
        kinds = (self.publishers, self.subscribers, self.services)
        return tuple(sorted({node for kind in kinds for nodes in kind.values() for node in nodes}))


class MasterClient(XmlRpcClient):
    """Calls the master at the address `uri`; each call takes at most `timeout` s.

    Several threads may use one client.

    Every method may raise MasterUnreachable, MasterSilent and NotAMaster, and GraphError if the master
    refuses the call. The constructor raises MalformedMasterUri if `uri` is invalid.
    """

    def __init__(self, uri: str, timeout: float = 2.0, caller: str = "/course") -> None:
        super().__init__(uri, timeout)
        self.caller = caller

    def ask(self, method: str, *args: RpcValue, timeout: float | None = None) -> RpcValue:
        """Call a method of the master and return its response value; the time limit is `timeout` s."""
        try:
            return super().ask(method, *args, timeout=timeout)
        except TimeoutError as error:
            raise MasterSilent(
                f"The program at {self.uri} accepts connections, but did not answer within "
                f"{self.limit(timeout):g} s. If this program is the master, resume its process "
                "(kill -CONT), or restart the master."
            ) from error
        except OSError as error:
            raise MasterUnreachable(
                f"No ROS master at {self.uri} ({error.strerror or error}). Run the set-up cell with join() "
                f"again, start a shared master with `roscore -p {self.address[1]}`, or correct "
                "ROS_MASTER_URI."
            ) from error
        except NO_ANSWER as error:
            raise NotAMaster(
                f"The program at {self.uri} is not a ROS master ({type(error).__name__}: {error}). Correct "
                "ROS_MASTER_URI, or unset it to get your own master."
            ) from error

    def pid(self, timeout: float | None = None) -> int:
        """Return the master's process id. This is the fastest way to test whether the master answers."""
        return int(str(self._value("getPid", timeout=timeout)))

    def lookup_service(self, name: str, timeout: float | None = None) -> str | None:
        """Return the rosrpc:// address of the service with this full name, or None if no node offers it."""
        return self._found("lookupService", name, timeout=timeout)

    def lookup_node(self, name: str, timeout: float | None = None) -> str | None:
        """Return the http:// address of a node, or None if the master does not know the node."""
        return self._found("lookupNode", name, timeout=timeout)

    def lookup_all(self, nodes: Iterable[str], services: Iterable[str]) -> tuple[Addresses, Addresses]:
        """Return the addresses of nodes and of services, with one request; unknown names are omitted."""
        asked = [("lookupNode", name) for name in nodes] + [("lookupService", name) for name in services]
        answers = self.multicall([(method, self.caller, name) for method, name in asked])
        found: dict[str, Addresses] = {"lookupNode": {}, "lookupService": {}}
        for (method, name), uri in zip(asked, answers, strict=True):
            if uri is not None:
                found[method][name] = str(uri)
        return found["lookupNode"], found["lookupService"]

    def multicall(self, calls: Sequence[tuple[str, ...]]) -> list[RpcValue]:
        """Make several calls in one request; return the value of each call, or None for a refused call.

        Each call is (method, name of the calling node, arguments …).
        """
        if not calls:
            return []
        together: RpcValue = [{"methodName": method, "params": [*args]} for method, *args in calls]
        answers = items(self.ask("system.multicall", together))
        return [_value_of(items(each)[0]) if isinstance(each, list) else None for each in answers]

    def system_state(self) -> SystemState:
        """Return all registrations."""
        return SystemState(*map(_registered, items(self._value("getSystemState"))))

    def topic_types(self) -> dict[str, str]:
        """Return the types of all topics; topics for which no node has registered a type are omitted."""
        return {topic: str(kind) for topic, kind in map(_pair, items(self._value("getTopicTypes")))}

    def get_param(self, name: str, default: RpcValue = None) -> RpcValue:
        """Return the value of a parameter; return `default` if the parameter is not set."""
        code, _, value = items(self.ask("getParam", self.caller, name))
        return value if code == 1 else default

    def set_param(self, name: str, value: str, timeout: float | None = None) -> bool:
        """Set a parameter; return whether the master accepted it."""
        return items(self.ask("setParam", self.caller, name, value, timeout=timeout))[0] == 1

    def delete_param(self, name: str, timeout: float | None = None) -> bool:
        """Delete a parameter; return whether the parameter existed."""
        return items(self.ask("deleteParam", self.caller, name, timeout=timeout))[0] == 1

    def register_service(self, node: str, name: str, uri: str, node_uri: str) -> None:
        """Register a node as the server of the service `name`, at the address `uri`.

        The registration replaces any other server of this service.
        """
        self._value("registerService", name, uri, node_uri, caller=node)

    def register_publisher(self, node: str, topic: str, kind: str, node_uri: str) -> None:
        """Register a node as a publisher of the topic."""
        self._value("registerPublisher", topic, kind, node_uri, caller=node)

    def register_subscriber(self, node: str, topic: str, kind: str, node_uri: str) -> list[str]:
        """Register a node as a subscriber of the topic; return the addresses of the topic's publishers."""
        publishers = items(self._value("registerSubscriber", topic, kind, node_uri, caller=node))
        return [str(uri) for uri in publishers]

    def unregister_service(self, node: str, name: str, uri: str) -> bool:
        """Unregister a service with this address; return whether the master had this registration."""
        return bool(self._value("unregisterService", name, uri, caller=node))

    def unregister_publisher(self, node: str, topic: str, node_uri: str) -> bool:
        """Unregister a publisher of this node; return whether the master had this registration."""
        return bool(self._value("unregisterPublisher", topic, node_uri, caller=node))

    def _found(self, method: str, name: str, timeout: float | None) -> str | None:
        code, _, value = items(self.ask(method, self.caller, name, timeout=timeout))
        return str(value) if code == 1 else None

    def _value(self, method: str, *args: str, caller: str = "", timeout: float | None = None) -> RpcValue:
        code, message, value = items(self.ask(method, caller or self.caller, *args, timeout=timeout))
        if code != 1:
            raise GraphError(f"The master at {self.uri} refused {method}{args}: {message!s}")
        return value


def _registered(kind: RpcValue) -> Registered:
    return {name: tuple(sorted(map(str, items(nodes)))) for name, nodes in sorted(map(_pair, items(kind)))}


def _pair(value: RpcValue) -> tuple[str, RpcValue]:
    name, other = items(value)
    return str(name), other


def _value_of(answer: RpcValue) -> RpcValue:
    code, _, value = items(answer)
    return value if code == 1 else None
