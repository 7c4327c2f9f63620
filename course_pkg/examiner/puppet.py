"""A node that is only on the master's books, for a student who reads them; alive, or killed."""

from __future__ import annotations

from course_pkg.examiner.node import Node
from course_pkg.examiner.scripted import closed_port


class Puppet:
    """Stands as a publisher of `topic` at the master while the block lasts, under any name.

    One that is `alive` answers a ping, since it has the address of the check's own node. The other is as
    a kill leaves it: nobody is at its address. Neither ever says anything.
    """

    def __init__(self, node: Node, name: str, topic: str, kind: str, *, alive: bool) -> None:
        self.name = name
        self._node, self._topic, self._kind = node, topic, kind
        self._uri = node.uri if alive else f"http://localhost:{closed_port()}/"

    def __enter__(self) -> Puppet:
        self._node.master.register_publisher(self.name, self._topic, self._kind, self._uri)
        return self

    def __exit__(self, *_: object) -> None:
        self._node.master.unregister_publisher(self.name, self._topic, self._uri)
